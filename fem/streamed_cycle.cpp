// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/streamed_cycle.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace batten {

StreamedCycle::StreamedCycle(const Hierarchy& hierarchy, int steps, double lambda, const SparseCholesky& coarsest)
    : hierarchy_(&hierarchy), coarsest_(&coarsest) {
  for (int k = 0; k < hierarchy.size(); ++k) {
    const std::size_t n = hierarchy[k].space.size();
    const auto size = [n](bool used) { return std::vector<double>(used ? n : 0); };
    levels_.push_back({smoother_of(hierarchy[k], steps, lambda),
                       {},
                       cubic_refinement(hierarchy, k),
                       size(k > 0),
                       size(k + 1 < hierarchy.size()),
                       size(k > 0)});
    if (hierarchy.degree() == 1) levels_.back().first.emplace(smoother_of(hierarchy[k], 1, lambda));
  }
}

StreamedCycle::AnySmoother StreamedCycle::smoother_of(const Hierarchy::Level& level, int steps, double lambda) {
  if (level.space.x.degree() == 1) return BilinearSmoother(level, steps, lambda);
  return StreamedSmoother(level, steps, lambda);
}

/// The second half of a cycle on one level.
void StreamedCycle::ascend(std::size_t k, std::span<const double> middle, std::span<const double> b,
                           std::span<double> out) const {
  std::visit([&](const auto& s) { s.ascend(middle, levels_[k + 1].x, b, out, rings_); }, levels_[k].smoother);
}

/// The first half of a cycle, which leaves `middle` and the solution x of the next coarser level. Returns r·Br if
/// `measure` is set.
double StreamedCycle::correct(Kind kind, std::size_t k, const StreamedSmoother::Start& start, std::span<const double> b,
                              std::span<double> middle, bool measure) const {
  const auto& fine = levels_[k];
  const auto& first = kind == Kind::ByLevels && fine.first ? *fine.first : fine.smoother;
  const double square = std::visit(
      [&](const auto& s) { return s.descend(start, b, middle, levels_[k + 1].right, measure, rings_); }, first);
  return square + correct_coarse(kind, k + 1, measure);
}

/// x = B right on a coarse level. Returns right·B right if `measure` is set.
double StreamedCycle::correct_coarse(Kind kind, std::size_t k, bool measure) const {
  auto& level = levels_[k];
  if (k + 1 < levels_.size()) {
    const double square = correct(kind, k, {}, level.right, level.middle, measure);
    ascend(k, level.middle, level.right, level.x);
    return square;
  }
  std::copy(level.right.begin(), level.right.end(), level.x.begin());
  coarsest_->solve(level.x);
  return measure ? std::inner_product(level.x.begin(), level.x.end(), level.right.begin(), 0.) : 0;
}

void StreamedCycle::improve(Kind kind, std::size_t k, const StreamedSmoother::Start& start, std::span<const double> b,
                            std::span<double> out) const {
  if (k + 1 == levels_.size()) {
    std::copy(b.begin(), b.end(), out.begin());
    return coarsest_->solve(out);
  }
  correct(kind, k, start, b, levels_[k].middle, false);
  ascend(k, levels_[k].middle, b, out);
}

/// The second half of a cycle on the finest level and the first half of the next one. `middle` is what the first half
/// left and leaves; `other` takes part. Either holds the iterate in between or what is better.
StreamedCycle::Iterate StreamedCycle::turn(std::span<const double> b, std::span<double>& middle,
                                           std::span<double>& other) const {
  auto& coarse = levels_[1];
  BilinearSmoother::Turn found;
  if (const auto* s = std::get_if<BilinearSmoother>(&levels_[0].smoother)) {
    found = s->turn(middle, coarse.x, b, other, coarse.right, rings_);
    std::swap(middle, other);
  } else {
    ascend(0, middle, b, other);
    found.work = dot(b, other);
    found.product = std::get<StreamedSmoother>(levels_[0].smoother)
                        .descend({.given = other.data()}, b, middle, coarse.right, true, rings_);
  }
  const double square = found.product + correct_coarse(Kind::Symmetric, 1, true);
  return {std::sqrt(std::max(0., square)), std::sqrt(std::max(0., found.work))};
}

void StreamedCycle::iterate(Begin begin, std::span<const double> b, std::span<double> c,
                            const std::function<bool(const Iterate&)>& goes_on) const {
  if (levels_.size() == 1) {
    improve(Kind::Symmetric, 0, {}, b, c);
    goes_on({0, std::sqrt(std::max(0., dot(b, c)))});
    return;
  }
  std::span<double> middle = c, other = levels_[0].middle;
  if (begin == Begin::AtStart) {
    std::swap(middle, other);
    const double square = correct(Kind::Symmetric, 0, {.given = c.data()}, b, middle, true);
    if (!goes_on({std::sqrt(std::max(0., square)), 0})) return;
  } else {
    descend_by_levels(b, middle);
  }
  while (goes_on(turn(b, middle, other))) {
  }
  if (middle.data() != c.data()) std::copy(middle.begin(), middle.end(), c.begin());
}

/// Where full multigrid starts on a level: at the refined solution of the next coarser one.
StreamedSmoother::Start StreamedCycle::start_by_levels(std::size_t k) const {
  const auto& cubic = levels_[k].cubic;
  return {.coarse = levels_[k + 1].x.data(),
          .refinement = cubic ? &*cubic : &*(*hierarchy_)[static_cast<int>(k)].refinement};
}

/// Full multigrid up to the first half of the cycle on the finest level.
void StreamedCycle::descend_by_levels(std::span<const double> b, std::span<double> middle) const {
  const std::size_t last = levels_.size() - 1;
  for (std::size_t k = 0; k < last; ++k)
    (*hierarchy_)[static_cast<int>(k)].restriction->apply(k == 0 ? b : levels_[k].right, levels_[k + 1].right);
  for (std::size_t k = last; k > 0; --k)
    improve(Kind::ByLevels, k, k < last ? start_by_levels(k) : StreamedSmoother::Start{}, levels_[k].right,
            levels_[k].x);
  correct(Kind::ByLevels, 0, start_by_levels(0), b, middle, false);
}

void StreamedCycle::solve_by_levels(std::span<const double> b, std::span<double> c) const {
  if (levels_.size() == 1) return improve(Kind::ByLevels, 0, {}, b, c);
  descend_by_levels(b, levels_[0].middle);
  ascend(0, levels_[0].middle, b, c);
}

double StreamedCycle::work_by_levels() const {
  double sum = 0;
  for (int k = 0; k < hierarchy_->size(); ++k) sum += static_cast<double>((*hierarchy_)[k].space.size());
  return sum / static_cast<double>(hierarchy_->finest().space.size());
}

}  // namespace batten
