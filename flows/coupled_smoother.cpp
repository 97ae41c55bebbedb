// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/chebyshev_step.h>
#include <batten/flows/coupled_smoother.h>

#include <algorithm>

namespace batten {
namespace {

double inverse_or_zero(double v) { return v > 0 ? 1 / v : 0; }

/// The diagonal of the energies of both times the bounds of their spectra.
std::vector<double> energy_diagonal(const CoupledParts& parts, int level) {
  auto result = parts.psi(level).energy.diagonal();
  auto more = parts.phi(level).energy.diagonal();
  for (double& v : result) v *= parts.psi(level).bound;
  for (double& v : more) v *= parts.phi(level).bound * parts.ratio;
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

}  // namespace

CoupledSmoother::CoupledSmoother(const CoupledParts& parts, int level, const CoupledData& data, double lambda)
    : parts_(parts), level_(level), data_(&data), lambda_(lambda), diagonal_(energy_diagonal(parts, level)) {}

void CoupledSmoother::set(Smoother::Kind kind, const PairWeights& weights) {
  factor_.reset();
  inverse_.assign(size(), 0.);
  if (kind == Smoother::Kind::Plain) {
    inverse_ = data_->lumped();
    fold_images(parts_.psi(level_).space, psi_of(std::span(inverse_)));
    fold_images(parts_.phi(level_).space, phi_of(std::span(inverse_)));
  }
  for (std::size_t i = 0; i < size(); ++i) inverse_[i] = inverse_or_zero(inverse_[i] + lambda_ * diagonal_[i]);
  if (kind == Smoother::Kind::Plain) return;
  columns_ = data_->columns();
  const Eigen::Map<const Eigen::VectorXd> inverse(inverse_.data(), columns_.rows());
  Eigen::SparseMatrix<double> k = columns_.transpose() * (inverse.asDiagonal() * columns_);
  add_lower_triangle(weights.inverse(), k);
  factor_.emplace(Eigen::SparseMatrix<double>(k.triangularView<Eigen::Lower>()));
}

std::vector<double> CoupledSmoother::compliance() const {
  std::vector<double> inverse(size());
  for (std::size_t i = 0; i < size(); ++i) inverse[i] = inverse_or_zero(lambda_ * diagonal_[i]);
  fill_images(parts_.psi(level_).space, psi_of(std::span(inverse)));
  fill_images(parts_.phi(level_).space, phi_of(std::span(inverse)));
  return data_->compliance(inverse);
}

std::vector<CoupledSmoother::Step> CoupledSmoother::steps(int degree) const {
  std::vector<Step> result;
  for (int i = 0; i < (factor_ ? degree - 1 : degree); ++i) {
    const auto [keep, gain] = chebyshev_step(i);
    result.push_back({keep, gain});
  }
  if (factor_) result.push_back({0., 1.});  // a zero at 1: what the data see is removed at once
  return result;
}

void CoupledSmoother::multiply_inverse_diagonal(std::span<double> v) const {
  const auto n = static_cast<std::ptrdiff_t>(v.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) v[static_cast<std::size_t>(i)] *= inverse_[static_cast<std::size_t>(i)];
}

/// out = M^-1 r
void CoupledSmoother::precondition(std::span<const double> r, std::span<double> out) const {
  const auto fill = [&] {
    multiply_inverse_diagonal(out);
    fill_images(parts_.psi(level_).space, psi_of(out));
    fill_images(parts_.phi(level_).space, phi_of(out));
  };
  std::copy(r.begin(), r.end(), out.begin());
  fill();
  if (!factor_) return;
  auto v = data_->values(out);
  factor_->solve(v);
  for (double& force : v) force = -force;
  std::copy(r.begin(), r.end(), out.begin());
  data_->add_adjoint(v, out);
  fill();
}

/// r -= A z
void CoupledSmoother::subtract_product(Work& work) const {
  parts_.psi(level_).energy.apply(psi_of(std::span<const double>(work.z)), psi_of(std::span(work.t)));
  parts_.phi(level_).energy.apply(phi_of(std::span<const double>(work.z)), phi_of(std::span(work.t)));
  combine(-lambda_, psi_of(std::span<const double>(work.t)), 1, psi_of(std::span(work.r)));
  combine(-lambda_ * parts_.ratio, phi_of(std::span<const double>(work.t)), 1, phi_of(std::span(work.r)));
  data_->add_normal(-1, work.z, work.r);
}

/// z <- keep z + gain M^-1 r; x += z
void CoupledSmoother::advance(const Step& step, Work& work) const {
  precondition(work.r, work.t);
  combine(step.gain, work.t, step.keep, work.z);
  combine(1, work.z, 1, work.x);
}

void CoupledSmoother::smooth_first(int degree, std::span<const double> b, Work& work) const {
  if (b.data() != work.r.data()) work.r.assign(b.begin(), b.end());
  work.x.assign(size(), 0.);
  work.z.assign(size(), 0.);
  for (const Step& step : steps(degree)) {
    advance(step, work);
    subtract_product(work);
  }
}

void CoupledSmoother::smooth_last(int degree, Work& work) const {
  combine(1, work.z, 1, work.x);
  auto all = steps(degree);
  if (factor_) std::rotate(all.begin(), all.end() - 1, all.end());
  for (const Step& step : all) {
    subtract_product(work);
    advance(step, work);
  }
}

}  // namespace batten
