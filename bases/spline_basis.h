// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>
#include <batten/bases/spline_ends.h>
#include <batten/domains/interval.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace batten {

/// The splines of degree d on an interval with simple breakpoints, in the clamped B-spline basis (end knots repeated d
/// + 1 times).
///
/// It spans the same space as the uniform B-splines restricted to the interval, but stays well conditioned at the ends,
/// and its first and last coefficients are the end values. Functions are numbered 0 .. cells + d - 1; functions c .. c
/// + d are the ones that do not vanish in cell c. Positions t are in cells of the finest level of the interval.
class SplineBasis {
public:
  static constexpr int max_degree = 5;
  /// Values (or derivatives) of the degree + 1 functions that live in one cell.
  struct Local {
    int first = 0;
    std::array<double, max_degree + 1> values{};
  };

  /// Throws InvalidInput unless 0 <= degree <= max_degree, conditions on derivatives have degree >= 2 and leave a
  /// function, and periodic ones are at both ends of at least 2 degree + 1 equal cells.
  SplineBasis(const Interval& interval, int degree, const EndConditions& ends = {});

  const Interval& interval() const { return interval_; }
  int degree() const { return degree_; }
  const EndConditions& ends() const { return ends_; }
  /// True if the conditions at the ends take function i away.
  bool is_removed(int i) const {
    return i < EndConditions::removed_at(ends_.lower) || size() - 1 - i < EndConditions::removed_at(ends_.upper) ||
           i >= size() - images();
  }
  /// How many functions are left.
  int kept() const;
  bool is_periodic() const { return ends_.is_periodic(); }
  /// True unless a condition holds the value at an end at 0.
  bool holds_constants() const {
    const auto is_held = [](EndCondition c) { return c == EndCondition::Zero || c == EndCondition::Clamped; };
    return !is_held(ends_.lower) && !is_held(ends_.upper);
  }
  /// Of a periodic basis: the last functions, which are images of the first.
  int images() const { return is_periodic() ? degree_ : 0; }
  /// The function whose image i is, or i itself.
  int original(int i) const { return i < size() - images() ? i : i - interval_.cells(); }
  int size() const { return interval_.cells() + degree_; }

  /// Derivative of the given order (0: the value) of the functions of the cell that holds t, with respect to t.
  Local at(double t, int order = 0) const;

  /// ∫ N_i^(r) N_j^(r) dt, symmetric, size() x size(): derived in rationals and converted once.
  BandedRows inner_products(int r) const { return inner_products(r, r); }
  /// ∫ N_i^(r) N_j^(s) dt, rows i.
  BandedRows inner_products(int r, int s) const;
  /// ∫ N_i dt. Of a basis without conditions, whose functions sum to 1.
  std::vector<double> integrals() const;
  /// R with N_j = Σ_i R_ij N̂_i, N̂ the basis of `finer`: finer.size() x size(). Its interior rows are the B-spline
  /// subdivision rules.
  BandedRows refinement(const SplineBasis& finer) const;
  /// N_j^(r) at the breakpoints, where it jumps (r = degree) the mean of the limits: (cells + 1) x size().
  BandedRows samples(int r) const;
  /// Coefficients of the derivative with respect to t, in the basis of degree - 1: (size() - 1) x size().
  BandedRows differences() const;
  /// T^T, size() x size(): T holds the coefficients of the functions in the basis unconstrained().
  BandedRows subspace_restriction() const;
  /// Greville abscissae of the functions of unconstrained(), as coordinates: the coefficients of t [Greville 1967].
  std::vector<double> greville() const;
  /// The basis of the next coarser level.
  SplineBasis coarser() const { return on(interval_.coarser(), ends_); }
  /// All splines of this degree: no conditions at the ends.
  SplineBasis unconstrained() const { return on(interval_, {}); }
  /// The same degree on another interval. What was derived in rationals is shared where the cells are alike.
  SplineBasis on(const Interval& interval, const EndConditions& ends) const;
  /// Turns coefficients of this basis into those of unconstrained() in place; consecutive ones are `stride` apart.
  void to_unconstrained(double* coefficients, std::ptrdiff_t stride) const;

private:
  struct Derived;

  /// True if the functions are B-splines themselves, not sums that meet conditions.
  bool is_plain() const { return ends_.are_free() || is_periodic(); }
  int piece_of(int cell) const;
  int unit() const;
  void constrain(Local& local) const;
  void apply_periodic_end(double* coefficients, std::ptrdiff_t stride) const;

  Interval interval_;
  int degree_;
  EndConditions ends_;
  int stored_pieces_;  // cells of a short interval with the same ends; its cell `degree` stands for all inner ones
  std::vector<double> pieces_;        // [stored cell][order of derivative][power of u][function]
  std::shared_ptr<Derived> derived_;  // what is derived in rationals once for all bases of the same cells
};

}  // namespace batten
