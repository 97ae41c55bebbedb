// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace batten {

/// A natural cubic spline: the curve of least ∫ |p''(t)|² dt among those that take its values at its knots, a number or
/// a point of any dimension for each t. Closed ones are periodic instead of straight beyond their ends.
///
/// It is held by the coefficients p of the variational scheme [Warren & Weimer 2001, sec. 6.2.4], here for any knots:
/// p_i is the value of the blossom at three consecutive knots (t_(i-1), t_i, t_(i+1)), where knots beyond an end mirror
/// those before it; end coefficients are end values. Refinement is local: rows {1}, {1/2, 1/2}, {1/8, 3/4, 1/8} on
/// equal cells.
class NaturalCubic {
public:
  /// n + 1 increasing knots; one row of coefficients for each, one less when closed, as the first and the last knot are
  /// the same place. Throws InvalidInput when the numbers of rows and knots do not fit, closed curves have less than 3
  /// cells, knots do not increase (naming the first two that do not), or a number is not finite.
  NaturalCubic(std::vector<double> knots, Eigen::MatrixXd coefficients, bool closed = false);
  /// The same of what `require` is known to accept, without looking at it again.
  static NaturalCubic of_checked(std::vector<double> knots, Eigen::MatrixXd coefficients, bool closed);
  /// Throws what the constructor would, without a copy.
  static void require(const std::vector<double>& knots, const Eigen::MatrixXd& coefficients, bool closed);
  /// The part of it that looks at no number.
  static void require_sizes(const std::vector<double>& knots, const Eigen::MatrixXd& coefficients, bool closed);
  /// The spline with these values at the knots and these second derivatives there, which have to fit to each other.
  static NaturalCubic from_values(std::vector<double> knots, const Eigen::MatrixXd& values,
                                  const Eigen::MatrixXd& second_derivatives, bool closed = false);

  const std::vector<double>& knots() const { return knots_; }
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  bool is_closed() const { return closed_; }
  int cells() const { return static_cast<int>(knots_.size()) - 1; }
  Eigen::Index dimension() const { return coefficients_.cols(); }

  /// N p: values at the knots, one row for each coefficient.
  Eigen::MatrixXd values() const;
  /// p'' at the knots.
  Eigen::MatrixXd second_derivatives() const;
  /// E p: the jumps of p''' at the knots, the forces that bend the strip. ∫ p'' q'' = Σ_i (E p)_i q(t_i) for all q
  /// [ibid., th. 6.4].
  Eigen::MatrixXd forces() const;
  /// ∫ |p''|² dt, from differences of the coefficients: keeps its relative accuracy.
  double energy() const;

  /// S p: the same curve with a new knot in the middle of each cell. The forces at old knots stay, at new ones they are
  /// 0.
  NaturalCubic refined() const;
  /// Bézier points, three for each cell and the last one: (3 cells + 1) rows.
  Eigen::MatrixXd bezier() const;
  /// The derivative of this order at t, 0 for the value; a straight line beyond the ends of an open curve.
  Eigen::VectorXd derivative(double t, int order = 0) const;

private:
  NaturalCubic() = default;
  /// Of the coefficients before and after one, in what the curve or its second derivative is at its knot.
  struct Weights {
    double before, after;
  };
  Weights value_weights(int knot) const;
  Weights bend_weights(int knot) const;
  bool is_end(int knot) const { return !closed_ && (knot == 0 || knot == cells()); }
  Eigen::RowVectorXd value_at(int knot) const;
  Eigen::RowVectorXd bend_at(int knot) const;
  double width(int cell) const;      // of cells -2 .. cells() + 1, continued beyond the ends
  Eigen::Index row(int knot) const;  // of a knot, wrapped when closed
  Eigen::Index rows() const { return coefficients_.rows(); }

  std::vector<double> knots_;
  Eigen::MatrixXd coefficients_;
  bool closed_ = false;
};

}  // namespace batten
