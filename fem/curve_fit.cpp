// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/banded_system.h>
#include <batten/fem/curve_fit.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace batten {
namespace {

/// The equations (R + λ Q^T W^-1 Q) γ = Q^T b of the second derivatives γ at the knots, Q^T the second divided
/// differences, R the products of hat functions; p = b - λ W^-1 Q γ [Green & Silverman 1994, sec. 2.3].
///
/// Unknowns are the inner knots, of closed curves all of them.
class Reinsch {
public:
  Reinsch(const std::vector<double>& knots, std::span<const double> weights, double lambda, bool closed)
      : knots_(knots), weights_(weights), lambda_(lambda), closed_(closed) {}

  int points() const { return static_cast<int>(knots_.size()) - (closed_ ? 1 : 0); }
  int unknowns() const { return closed_ ? points() : points() - 2; }

  BandRow row(int unknown) const {
    const int i = knot_of(unknown);
    const double b = width(i - 1), c = width(i), d = width(i + 1);
    BandRow r{(b + c) / 3, c / 6, 0};
    if (lambda_ == 0) return r;
    const double left = softness(i - 1), here = softness(i), right = softness(i + 1), middle = 1 / b + 1 / c;
    r.diagonal += left / (b * b) + here * middle * middle + right / (c * c);
    r.first -= here * middle / c + right / c * (1 / c + 1 / d);
    r.second = right / (c * d);
    return r;
  }

  /// Q^T f - R γ: by differences first.
  RowMatrix residual(const RowMatrix& f, const RowMatrix* gamma) const {
    RowMatrix r(unknowns(), f.cols());
    for (int u = 0; u < unknowns(); ++u) {
      const int i = knot_of(u);
      const double b = width(i - 1), c = width(i);
      r.row(u) = (f.row(point(i + 1)) - f.row(point(i))) / c - (f.row(point(i)) - f.row(point(i - 1))) / b;
      if (!gamma) continue;
      r.row(u) -= (b + c) / 3 * gamma->row(u);
      if (const int v = unknown_of(i - 1); v >= 0) r.row(u) -= b / 6 * gamma->row(v);
      if (const int v = unknown_of(i + 1); v >= 0) r.row(u) -= c / 6 * gamma->row(v);
    }
    return r;
  }

  /// b - λ W^-1 Q γ
  RowMatrix values(const RowMatrix& b, const RowMatrix& gamma) const {
    if (lambda_ == 0) return b;
    RowMatrix f = b;
    for (int k = 0; k < points(); ++k) {
      const int before = unknown_of(k - 1), here = unknown_of(k), after = unknown_of(k + 1);
      const double s = softness(k);
      if (before >= 0) f.row(k) -= s / width(k - 1) * gamma.row(before);
      if (here >= 0) f.row(k) += s * (1 / width(k - 1) + 1 / width(k)) * gamma.row(here);
      if (after >= 0) f.row(k) -= s / width(k) * gamma.row(after);
    }
    return f;
  }

  int knot_of(int unknown) const { return closed_ ? unknown : unknown + 1; }
  /// -1 where there is none.
  int unknown_of(int knot) const {
    if (closed_) return point(knot);
    return knot >= 1 && knot <= points() - 2 ? knot - 1 : -1;
  }

private:
  int point(int knot) const { return closed_ ? (knot + points()) % points() : knot; }
  double width(int cell) const {
    const int cells = static_cast<int>(knots_.size()) - 1;
    cell = closed_ ? (cell + cells) % cells : std::clamp(cell, 0, cells - 1);
    return knots_[static_cast<std::size_t>(cell) + 1] - knots_[static_cast<std::size_t>(cell)];
  }
  /// λ / w
  double softness(int knot) const {
    return weights_.empty() ? lambda_ : lambda_ / weights_[static_cast<std::size_t>(point(knot))];
  }

  const std::vector<double>& knots_;
  std::span<const double> weights_;
  double lambda_;
  bool closed_;
};

/// The factored matrix of these equations; of a closed curve the last two unknowns are a border.
class CurveSolver {
public:
  explicit CurveSolver(const Reinsch& equations) : size_(equations.unknowns()) {
    border_ = size_ > small && equations.unknown_of(0) == 0 ? 2 : 0;
    if (size_ <= small) {
      dense_.compute(dense_matrix(equations));
      return;
    }
    const int inner = size_ - border_;
    band_.emplace(inner, [&](int i) {
      BandRow r = equations.row(i);
      if (i + 1 >= inner) r.first = 0;
      if (i + 2 >= inner) r.second = 0;
      return r;
    });
    if (border_ > 0) factor_border(equations);
  }

  /// Solutions in place of right-hand sides.
  void solve(RowMatrix& x) const {
    if (size_ == 0) return;
    if (!band_) {
      x = dense_.solve(x).eval();
      return;
    }
    if (border_ == 0) return band_->solve(x);
    RowMatrix inner = x.topRows(size_ - border_);
    band_->solve(inner);
    const RowMatrix outer = schur_.inverse() * (x.bottomRows(border_) - coupling_.transpose() * inner);
    x.topRows(size_ - border_) = inner - response_ * outer;
    x.bottomRows(border_) = outer;
  }

private:
  static constexpr int small = 8;

  Eigen::MatrixXd dense_matrix(const Reinsch& equations) const {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size_, size_);
    const bool closed = equations.unknown_of(0) == 0;
    for (int i = 0; i < size_; ++i) {
      const BandRow r = equations.row(i);
      a(i, i) += r.diagonal;
      for (const auto& [step, value] : {std::pair{1, r.first}, {2, r.second}}) {
        if (!closed && i + step >= size_) continue;
        const int j = (i + step) % size_;
        a(i, j) += value;
        a(j, i) += value;
      }
    }
    return a;
  }

  void factor_border(const Reinsch& equations) {
    const int inner = size_ - 2;
    const BandRow a = equations.row(inner - 2), b = equations.row(inner - 1), c = equations.row(inner),
                  d = equations.row(inner + 1);
    coupling_ = RowMatrix::Zero(inner, 2);
    coupling_(inner - 2, 0) = a.second;
    coupling_.row(inner - 1) << b.first, b.second;
    coupling_(0, 0) = c.second;
    coupling_(0, 1) = d.first;
    coupling_(1, 1) = d.second;
    response_ = coupling_;
    band_->solve(response_);
    schur_ << c.diagonal, c.first, c.first, d.diagonal;
    schur_ -= coupling_.transpose() * response_;
  }

  int size_, border_ = 0;
  Eigen::LDLT<Eigen::MatrixXd> dense_;
  std::optional<BandedFactor> band_;
  RowMatrix coupling_, response_;
  Eigen::Matrix2d schur_;
};

void require_points(const std::vector<double>& knots, const Eigen::MatrixXd& points, bool closed) {
  NaturalCubic(knots, points, closed);  // refuses what does not fit
}

/// γ for given values, one row for each point.
Eigen::MatrixXd at_knots(const Reinsch& equations, const RowMatrix& gamma, Eigen::Index points) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(points, gamma.cols());
  for (int u = 0; u < equations.unknowns(); ++u) all.row(equations.knot_of(u)) = gamma.row(u);
  return all;
}

/// The second derivatives, corrected until rounding alone is left: the residual is formed by differences first, so that
/// it is right where the equations are ill conditioned.
RowMatrix solve_accurately(const Reinsch& equations, const CurveSolver& solver, const RowMatrix& points) {
  constexpr int most = 20;
  constexpr double enough = 1e-12, least_progress = 0.3;
  RowMatrix gamma = equations.residual(points, nullptr);
  solver.solve(gamma);
  double before = gamma.norm();
  for (int k = 0; k < most; ++k) {
    RowMatrix correction = equations.residual(equations.values(points, gamma), &gamma);
    solver.solve(correction);
    const double size = correction.norm();
    if (size <= enough * gamma.norm()) return gamma;
    if (!(size <= least_progress * before)) break;
    gamma += correction;
    before = size;
  }
  const double left = before / std::max(gamma.norm(), 1e-300);
  if (left < 1e-6) return gamma;
  throw SolverError("smoothing_curve: the points are too dense for so large a smoothing, the relative error would be " +
                    std::to_string(left) + "; use fewer points or smooth less");
}

}  // namespace

NaturalCubic interpolating_curve(std::vector<double> knots, const Eigen::MatrixXd& points, bool closed) {
  require_points(knots, points, closed);
  const Reinsch equations(knots, {}, 0, closed);
  RowMatrix gamma = equations.residual(points, nullptr);
  CurveSolver(equations).solve(gamma);
  const Eigen::MatrixXd bends = at_knots(equations, gamma, points.rows());
  return NaturalCubic::from_values(std::move(knots), points, bends, closed);
}

NaturalCubic smoothing_curve(std::vector<double> knots, const Eigen::MatrixXd& points, std::span<const double> weights,
                             double lambda, bool closed) {
  if (!(lambda >= 0) || !std::isfinite(lambda))
    throw InvalidInput("smoothing_curve: lambda must be finite and not negative, found " + std::to_string(lambda));
  require_points(knots, points, closed);
  if (!weights.empty() && static_cast<Eigen::Index>(weights.size()) != points.rows())
    throw InvalidInput("smoothing_curve: one weight for each of " + std::to_string(points.rows()) +
                       " points is needed, found " + std::to_string(weights.size()));
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!(weights[i] > 0) || !std::isfinite(weights[i]))
      throw InvalidInput("smoothing_curve: weights must be positive, found " + std::to_string(weights[i]) +
                         " at place " + std::to_string(i));
  if (lambda == 0) return interpolating_curve(std::move(knots), points, closed);
  const Reinsch equations(knots, weights, lambda, closed);
  const RowMatrix gamma = solve_accurately(equations, CurveSolver(equations), points);
  const Eigen::MatrixXd values = equations.values(points, gamma), bends = at_knots(equations, gamma, points.rows());
  return NaturalCubic::from_values(std::move(knots), values, bends, closed);
}

NaturalCubic curve_within(std::vector<double> knots, const Eigen::MatrixXd& points, std::span<const double> tolerances,
                          bool closed) {
  constexpr int most = 5000;
  constexpr double gap = 1e-3, none = 1e-9, inside = 1 - 2e-4, least_weight = 1e-8;
  if (static_cast<Eigen::Index>(tolerances.size()) != points.rows())
    throw InvalidInput("curve_within: one tolerance for each of " + std::to_string(points.rows()) +
                       " points is needed, found " + std::to_string(tolerances.size()));
  for (std::size_t i = 0; i < tolerances.size(); ++i)
    if (!(tolerances[i] > 0) || !std::isfinite(tolerances[i]))
      throw InvalidInput("curve_within: tolerances must be positive, found " + std::to_string(tolerances[i]) +
                         " at place " + std::to_string(i));
  NaturalCubic curve = interpolating_curve(knots, points, closed);
  const double no_energy = none * curve.energy();  // a straight line will do
  // Force i is weight i times misfit i: the weight that the force needs where the misfit is the tolerance.
  std::vector<double> weights(tolerances.size());
  for (int k = 0; k < most; ++k) {
    const Eigen::VectorXd forces = curve.forces().rowwise().norm();
    const double largest = std::max(forces.maxCoeff(), 1e-300);
    for (std::size_t i = 0; i < weights.size(); ++i)
      weights[i] = std::max(forces[static_cast<Eigen::Index>(i)], least_weight * largest) / (inside * tolerances[i]);
    curve = smoothing_curve(knots, points, weights, 1, closed);
    const Eigen::VectorXd misfits = (curve.values() - points).rowwise().norm();
    bool is_kept = true;
    double room = 0;  // the energy is at most this much above the least one, by duality
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double misfit = misfits[static_cast<Eigen::Index>(i)];
      is_kept = is_kept && misfit <= tolerances[i];
      room += weights[i] * (tolerances[i] * tolerances[i] - misfit * misfit);
    }
    if (is_kept && room <= std::max(gap * curve.energy(), no_energy)) return curve;
  }
  throw SolverError("curve_within: not all points are within their tolerances after " + std::to_string(most) +
                    " changes of the weights");
}

std::vector<double> curve_parameters(const Eigen::MatrixXd& points, double exponent, bool closed) {
  std::vector<double> parameters = {0};
  const Eigen::Index n = points.rows();
  for (Eigen::Index i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const double length = (points.row((i + 1) % n) - points.row(i)).norm();
    const double step = exponent == 0 ? 1 : std::pow(length, exponent);
    if (!(step > 0))
      throw InvalidInput("curve_parameters: consecutive points must differ, found points " + std::to_string(i) +
                         " and " + std::to_string((i + 1) % n) + " at the same place");
    parameters.push_back(parameters.back() + step);
  }
  return parameters;
}

}  // namespace batten
