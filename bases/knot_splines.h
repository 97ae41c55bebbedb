// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/breakpoints.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace batten {

/// The splines of degree d <= 3 with simple knots at the breakpoints of an interval, uniform or not.
///
/// Functions are numbered 0 .. cells + d - 1; functions c .. c + d are the ones that do not vanish in cell c. All
/// lengths are positions of Breakpoints. Numbers of a cell depend on the distances of the knots around it alone, so
/// that cells with the same neighbourhood have the same bits.
class KnotSplines {
public:
  static constexpr int max_degree = 3;
  /// Clamped: end knots repeated d + 1 times; well conditioned, end coefficients are end values.
  /// Extended: the knots continue beyond the ends with the spacing of the outermost cells; on a uniform interval these
  /// are the uniform B-splines restricted to it [Warren & Weimer 2001, sec. 6.2.2].
  enum class Ends { Clamped, Extended };
  using Local = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_degree + 1, 1>;
  using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_degree + 1, max_degree + 1>;

  /// Throws InvalidInput unless 0 <= degree <= 3.
  KnotSplines(Breakpoints breakpoints, int degree, Ends ends = Ends::Clamped);

  const Breakpoints& breakpoints() const { return breakpoints_; }
  int degree() const { return degree_; }
  int cells() const { return breakpoints_.cells(); }
  int size() const { return cells() + degree_; }

  /// Derivative of the given order (0: the value), with respect to position, of functions cell .. cell + degree at
  /// distance u from the left end of the cell; outside of the cell that of its polynomial pieces.
  Local at(int cell, double u, int order = 0) const;
  /// ∫ N_a^(r) N_b^(r) dt over a cell, for its degree + 1 functions. Gauss's rule, exact up to rounding.
  LocalMatrix cell_products(int cell, int r) const;
  /// ∫ s^a N dt over a cell, s = 2 t / length - 1 in [-1, 1].
  Local cell_moments(int cell, int a) const;

  /// Greville positions, the averages of degree consecutive knots: coefficients of t. Degree 0: the cells' middles.
  std::vector<double> greville() const;
  /// Coefficients of s^a, 0 <= a <= degree, s as above.
  Eigen::VectorXd monomial(int a) const;
  /// R with N_j = Σ_i R_ij N̂_i, N̂ the basis of `finer`, whose breakpoints' coarser() these are: each entry is a blossom
  /// value [de Boor 1978]. finer.size() x size().
  Eigen::SparseMatrix<double> refinement(const KnotSplines& finer) const;
  /// The basis of the next coarser level.
  KnotSplines coarser() const { return {breakpoints_.coarser(), degree_, ends_}; }
  /// The cell that holds position t, the first or last one beyond the ends.
  int cell_of(double t) const;

private:
  double distance(int from, int to) const;
  Local blossom(int cell, std::span<const double> arguments) const;
  Local derivative(int cell, int degree, double u, int order) const;

  Breakpoints breakpoints_;
  int degree_;
  Ends ends_;
};

}  // namespace batten
