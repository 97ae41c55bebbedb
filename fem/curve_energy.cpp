// SPDX-License-Identifier: MIT
#include <batten/fem/curve_energy.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace batten {

CurveEnergy::CurveEnergy(Strip strip, std::vector<double> values)
    : strip_(std::move(strip)),
      dimension_(static_cast<std::size_t>(strip_.dimension)),
      f_(std::move(values)),
      gamma_(f_.size()),
      df_(f_.size()),
      dgamma_(f_.size()),
      band_(f_.size(), dimension_ * (strip_.closed ? 2 : 1)) {
  for (std::size_t i = 0; i < knots(); ++i)
    if (is_fixed(i))
      std::copy_n(strip_.targets.begin() + static_cast<std::ptrdiff_t>(i * dimension_), dimension_,
                  f_.begin() + static_cast<std::ptrdiff_t>(i * dimension_));
  assemble({}, Hold::Values);
  solve(Rows(f_.size()), bend_residual());
  gamma_ = dgamma_;
}

bool CurveEnergy::is_fixed(std::size_t knot) const { return std::isinf(strip_.weights[knot]); }

bool CurveEnergy::is_straight(std::size_t knot) const { return !strip_.closed && (knot == 0 || knot + 1 == knots()); }

// A closed curve is folded, 0, n - 1, 1, n - 2, ..., so that neighbours are at most two places apart.
std::size_t CurveEnergy::place(std::size_t knot) const {
  if (!strip_.closed) return knot;
  return knot < (knots() + 1) / 2 ? 2 * knot : 2 * (knots() - 1 - knot) + 1;
}

/// Q γ
CurveEnergy::Rows CurveEnergy::forces() const {
  Rows result(f_.size());
  for (std::size_t cell = 0; cell < strip_.widths.size(); ++cell) {
    const double h = strip_.widths[cell];
    if (h == 0) continue;
    for (std::size_t k = 0; k < dimension_; ++k) {
      const std::size_t left = cell * dimension_ + k, right = next(cell) * dimension_ + k;
      const double third = (gamma_[right] - gamma_[left]) / h;
      result[left] += third;
      result[right] -= third;
    }
  }
  return result;
}

/// R γ - Qᵀ f
CurveEnergy::Rows CurveEnergy::bend_residual() const {
  Rows result(f_.size());
  for (std::size_t cell = 0; cell < strip_.widths.size(); ++cell) {
    const double h = strip_.widths[cell];
    if (h == 0) continue;
    for (std::size_t k = 0; k < dimension_; ++k) {
      const std::size_t left = cell * dimension_ + k, right = next(cell) * dimension_ + k;
      const double slope = (f_[right] - f_[left]) / h;
      result[left] += h / 6 * (2 * gamma_[left] + gamma_[right]) - slope;
      result[right] += h / 6 * (gamma_[left] + 2 * gamma_[right]) + slope;
    }
  }
  return result;
}

/// ½ γ·R γ
double CurveEnergy::bending() const {
  double sum = 0;
  for (std::size_t cell = 0; cell < strip_.widths.size(); ++cell)
    for (std::size_t k = 0; k < dimension_; ++k) {
      const double left = gamma_[cell * dimension_ + k], right = gamma_[next(cell) * dimension_ + k];
      sum += strip_.widths[cell] * (left * left + left * right + right * right);
    }
  return sum / 6;
}

double CurveEnergy::energy() const {
  double data = 0;
  for (std::size_t row = 0; row < f_.size(); ++row) {
    const double w = strip_.weights[row / dimension_], miss = f_[row] - strip_.targets[row];
    if (!std::isinf(w)) data += w * miss * miss;
  }
  return bending() + data / 2;
}

void CurveEnergy::add_cell(std::size_t cell, Hold hold) {
  const double h = strip_.widths[cell];
  if (h == 0) return;
  const std::size_t left = cell, right = next(cell);
  const bool moves_left = hold == Hold::None && !is_fixed(left), moves_right = hold == Hold::None && !is_fixed(right);
  const bool bends_left = !is_straight(left), bends_right = !is_straight(right);
  const bool is_swapped = place(left) > place(right);
  const std::size_t first = dimension_ * std::min(place(left), place(right));
  const std::size_t offset = dimension_ * std::max(place(left), place(right)) - first;
  for (std::size_t k = 0; k < dimension_; ++k) {
    PairedBand::Block& a = band_.at(dimension_ * place(left) + k, 0);
    PairedBand::Block& b = band_.at(dimension_ * place(right) + k, 0);
    PairedBand::Block& both = band_.at(first + k, offset);
    if (bends_left) a.bb -= h / 3;
    if (bends_right) b.bb -= h / 3;
    if (bends_left && bends_right) both.bb -= h / 6;
    if (bends_left && moves_left) a.vb = a.bv -= 1 / h;
    if (bends_right && moves_right) b.vb = b.bv -= 1 / h;
    if (bends_left && moves_right) (is_swapped ? both.bv : both.vb) += 1 / h;
    if (bends_right && moves_left) (is_swapped ? both.vb : both.bv) += 1 / h;
  }
}

/// Without weights: all values are held.
void CurveEnergy::assemble(const RowWeights& weights, Hold hold) {
  band_.clear();
  const std::size_t pairs = dimension_ * (dimension_ - 1) / 2;
  for (std::size_t i = 0; i < knots(); ++i) {
    const std::size_t first = dimension_ * place(i);
    const bool moves = hold == Hold::None && !is_fixed(i);
    std::size_t beside = i * pairs;
    for (std::size_t k = 0; k < dimension_; ++k) {
      band_.at(first + k, 0).vv = moves ? strip_.weights[i] + weights.diagonal[i * dimension_ + k] : 1;
      if (is_straight(i)) band_.at(first + k, 0).bb = -1;
      for (std::size_t j = k + 1; j < dimension_ && moves; ++j)
        band_.at(first + k, j - k).vv = weights.beside[beside++];
    }
  }
  for (std::size_t cell = 0; cell < strip_.widths.size(); ++cell) add_cell(cell, hold);
  band_.factor();
  ++factorisations_;
}

/// dc from the right sides of Newton's equations.
void CurveEnergy::solve(const Rows& force, const Rows& bend) {
  std::vector<double> x(2 * f_.size());
  for (std::size_t i = 0; i < knots(); ++i)
    for (std::size_t k = 0; k < dimension_; ++k) {
      const std::size_t row = i * dimension_ + k, pair = place(i) * dimension_ + k;
      if (!is_fixed(i)) x[2 * pair] = force[row];
      if (!is_straight(i)) x[2 * pair + 1] = bend[row];
    }
  x = band_.solved(std::move(x));
  for (std::size_t i = 0; i < knots(); ++i)
    for (std::size_t k = 0; k < dimension_; ++k) {
      const std::size_t row = i * dimension_ + k, pair = place(i) * dimension_ + k;
      df_[row] = x[2 * pair];
      dgamma_[row] = x[2 * pair + 1];
    }
}

std::vector<double> CurveEnergy::direction(const RowWeights& weights, std::span<const double> force, double) {
  if (weights.diagonal != factored_.diagonal || weights.beside != factored_.beside) {
    factored_ = weights;
    assemble(weights, Hold::None);
  }
  Rows pull = forces();
  for (std::size_t row = 0; row < f_.size(); ++row) {
    pull[row] = force[row] - pull[row];
    const std::size_t knot = row / dimension_;
    if (!is_fixed(knot)) pull[row] -= strip_.weights[knot] * (f_[row] - strip_.targets[row]);
  }
  solve(pull, bend_residual());
  return df_;
}

void CurveEnergy::advance(double step) {
  for (std::size_t row = 0; row < f_.size(); ++row) {
    f_[row] += step * df_[row];
    gamma_[row] += step * dgamma_[row];
  }
}

// Of ½ γ·R γ at any f the tangent at our γ is a bound: Q γ·f - ½ γ·R γ.
double CurveEnergy::bound(std::span<double> force) {
  const Rows bent = forces();
  double sum = 0;
  for (std::size_t row = 0; row < f_.size(); ++row) {
    const double w = strip_.weights[row / dimension_];
    if (w == 0) force[row] = bent[row];
    const double pull = bent[row] - force[row];
    if (w != 0) sum += pull * (strip_.targets[row] - pull / (2 * w));
  }
  return sum - bending();
}

}  // namespace batten
