// SPDX-License-Identifier: MIT
#include <batten/flows/coupled_cycle.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace batten {
namespace {

// Of the data in the diagonals of a level, measured for λ from 1e-4 to 1e-10: with less than this ψ and φ can be
// smoothed apart (14 iterations, as with all smoothed together).
constexpr double share_apart = 0.1;
// With less than this part of √λ, the energy norm of the smoothest pairs against the data's, cross terms do not matter
// either: 14 iterations, where the share 3 √λ takes 48.
constexpr double share_unseen = 0.3;
constexpr double stiff_data = 0.5;      // as in Multigrid
constexpr double largest_factor = 6e6;  // estimated entries of the matrix of the rows
constexpr std::size_t largest_direct = 40 * 40, largest_direct_stiff = 80 * 80;  // coefficients of each of the two

}  // namespace

CoupledCycle::CoupledCycle(const CoupledParts& parts, std::function<Eigen::MatrixXd(int)> unseen)
    : parts_(parts), unseen_(std::move(unseen)), buffers_(static_cast<std::size_t>(parts.levels())) {
  for (int k = 0; k < parts_.levels(); ++k) data_.emplace_back(parts_, k);
}

/// Finds the finest level that is smoothed together and the levels above it whose cross terms matter.
void CoupledCycle::find_coupled(double lambda) {
  const auto &psi = parts_.stream.system(), &phi = parts_.potential.system();
  sees_cross_.clear();
  first_ = 0;
  if (psi.is_data_aware() || phi.is_data_aware()) return;
  for (; first_ + 1 < parts_.levels(); ++first_) {
    const double share = std::max(psi.level(first_).data_share(), phi.level(first_).data_share());
    if (share > share_apart) return;
    sees_cross_.push_back(share > share_unseen * std::sqrt(lambda));
  }
}

/// True if the data outweigh the energy on the finest level.
bool CoupledCycle::are_stiff(const PairWeights& weights) const {
  if (first_ > 0) return false;
  const auto of_psi = parts_.stream.system().level(0).compliance(),
             of_phi = parts_.potential.system().level(0).compliance();
  double stiffness = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    stiffness =
        std::max(stiffness, weights.diagonal[i] * (of_psi[i] + parts_.factor[i] * parts_.factor[i] * of_phi[i]));
  return stiffness > stiff_data;
}

bool CoupledCycle::can_be_data_aware() const {
  const auto& data = parts_.stream.system().data();
  const auto& space = parts_.psi(0).space;
  const double n = static_cast<double>(space.size()), rows = static_cast<double>(data.size());
  const double band = 2. * space.x.degree() + 1;
  return !data.is_stored() && rows * (1 + band * band * rows / n) / 2 < largest_factor;
}

/// The data of a level: those that ψ and φ have, unless weights are softened or a direct solution asks for stencils.
void CoupledCycle::set_data(int level, const PairWeights& weights, bool are_softened) {
  auto& data = data_[static_cast<std::size_t>(level)];
  const auto &psi = parts_.stream.system(), &phi = parts_.potential.system();
  if (are_softened || psi.is_data_aware() || phi.is_data_aware() ||
      (level == last_ && !psi.level(level).data().is_stored()))
    return data.set(weights, level == last_);
  data.share(psi.level(level).data(), phi.level(level).data(), weights,
             level > 0 ? &data_[static_cast<std::size_t>(level - 1)] : nullptr);
}

void CoupledCycle::set(double lambda, const PairWeights& weights) {
  levels_.clear();
  direct_.reset();
  find_coupled(lambda);
  const bool stiff = are_stiff(weights), is_aware = stiff && can_be_data_aware();
  last_ = first_;
  while (last_ + 1 < parts_.levels() &&
         parts_.psi(last_).space.kept() > (stiff ? largest_direct_stiff : largest_direct))
    ++last_;
  PairWeights w = weights;
  for (int k = 0; k <= last_; ++k) {
    const auto& data = data_[static_cast<std::size_t>(k)];
    set_data(k, w, is_aware && k > 0);
    if (k < first_ || k == last_) continue;
    levels_.push_back(
        {CoupledSmoother(parts_, k, data, lambda), CoupledSmoother::Work(2 * parts_.psi(k).space.size())});
    auto& smoother = levels_.back().smoother;
    smoother.set(k == 0 && is_aware ? Smoother::Kind::DataAware : Smoother::Kind::Plain, w);
    if (is_aware) w.soften(smoother.compliance());
  }
  direct_.emplace(parts_, last_, data_[static_cast<std::size_t>(last_)], lambda, unseen_(last_));
}

void CoupledCycle::refine(int level, std::span<const double> coarse, Vector& fine) const {
  fine.resize(2 * parts_.psi(level).space.size());
  parts_.psi(level).refinement->apply(psi_of(coarse), psi_of(std::span(fine)));
  parts_.phi(level).refinement->apply(phi_of(coarse), phi_of(std::span(fine)));
}

/// The solution of the next coarser level for the residual r of this one.
void CoupledCycle::correct_below(int level, std::span<const double> r, Vector& coarse) const {
  Vector& right = buffers_[static_cast<std::size_t>(level + 1)].right;
  right.resize(2 * parts_.psi(level + 1).space.size());
  parts_.stream.hierarchy().restrict_from(level, psi_of(r), psi_of(std::span(right)));
  parts_.potential.hierarchy().restrict_from(level, phi_of(r), phi_of(std::span(right)));
  cycle(level + 1, right, coarse);
}

void CoupledCycle::cycle(int level, std::span<const double> b, Vector& x) const {
  if (level < first_) return cycle_apart(level, b, x);
  if (level == last_) {
    x.assign(b.begin(), b.end());
    return direct_->solve(x);
  }
  auto& [smoother, work] = levels_[static_cast<std::size_t>(level - first_)];
  const int degree = parts_.stream.system().smoothing_degree();
  smoother.smooth_first(degree, b, work);
  correct_below(level, work.r, x);
  refine(level, x, work.z);
  smoother.smooth_last(degree, work);
  x.assign(work.x.begin(), work.x.end());
}

/// ψ and φ are smoothed apart; the cross terms of the data enter what goes down and what comes up.
void CoupledCycle::cycle_apart(int level, std::span<const double> b, Vector& x) const {
  const auto &psi = parts_.stream.system(), &phi = parts_.potential.system();
  const auto& data = data_[static_cast<std::size_t>(level)];
  auto &of_psi = psi.work(level), &of_phi = phi.work(level);
  auto& [right, coarse, e] = buffers_[static_cast<std::size_t>(level)];
  const int degree = psi.smoothing_degree();
  const std::size_t n = of_psi.x.size();
  const auto join = [n](const Vector& first, const Vector& second, Vector& both) {
    both.resize(2 * n);
    std::copy(first.begin(), first.end(), both.begin());
    std::copy(second.begin(), second.end(), both.begin() + static_cast<std::ptrdiff_t>(n));
  };
  psi.level(level).smooth_first(degree, psi_of(b), of_psi);
  phi.level(level).smooth_first(degree, phi_of(b), of_phi);
  join(of_psi.r, of_phi.r, x);
  join(of_psi.x, of_phi.x, e);
  if (sees_cross_[static_cast<std::size_t>(level)]) data.add_cross(-1, e, x);
  correct_below(level, x, coarse);
  refine(level, coarse, e);
  if (sees_cross_[static_cast<std::size_t>(level)]) data.add_cross(-1, e, x);
  std::copy_n(x.begin(), n, of_psi.r.begin());
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(n), n, of_phi.r.begin());
  psi.level(level).smooth_last(degree, psi_of(std::span<const double>(coarse)), of_psi);
  phi.level(level).smooth_last(degree, phi_of(std::span<const double>(coarse)), of_phi);
  join(of_psi.x, of_phi.x, x);
}

void CoupledCycle::apply(std::span<const double> r, Vector& out) const { cycle(0, r, out); }

}  // namespace batten
