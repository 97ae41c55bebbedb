// SPDX-License-Identifier: MIT
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
void StreamedCycle::ascend(std::size_t k, std::span<const double> b, std::span<double> out) const {
  std::visit([&](const auto& s) { s.ascend(levels_[k].middle, levels_[k + 1].x, b, out, rings_); },
             levels_[k].smoother);
}

/// The first half of a cycle, which leaves `middle` and the solution x of the next coarser level. Returns r·Br if
/// `measure` is set.
double StreamedCycle::correct(Kind kind, std::size_t k, const StreamedSmoother::Start& start, std::span<const double> b,
                              bool measure) const {
  auto& coarse = levels_[k + 1];
  const auto& fine = levels_[k];
  const auto& first = kind == Kind::ByLevels && fine.first ? *fine.first : fine.smoother;
  double square = std::visit(
      [&](const auto& s) { return s.descend(start, b, levels_[k].middle, coarse.right, measure, rings_); }, first);
  if (k + 2 < levels_.size()) {
    square += correct(kind, k + 1, {}, coarse.right, measure);
    ascend(k + 1, coarse.right, coarse.x);
  } else {
    improve(kind, k + 1, {}, coarse.right, coarse.x);
    if (measure) square += std::inner_product(coarse.x.begin(), coarse.x.end(), coarse.right.begin(), 0.);
  }
  return square;
}

void StreamedCycle::improve(Kind kind, std::size_t k, const StreamedSmoother::Start& start, std::span<const double> b,
                            std::span<double> out) const {
  if (k + 1 == levels_.size()) {
    std::copy(b.begin(), b.end(), out.begin());
    return coarsest_->solve(out);
  }
  correct(kind, k, start, b, false);
  ascend(k, b, out);
}

double StreamedCycle::improve_unless(double enough, std::span<const double> b, std::span<double> c) const {
  if (levels_.size() == 1) {
    improve(0, {}, b, c);
    return 0;
  }
  const double error = std::sqrt(std::max(
      0., correct(Kind::Symmetric, 0, {.given = c.data(), .coarse = nullptr, .refinement = nullptr}, b, true)));
  if (error > enough) ascend(0, b, c);
  return error;
}

void StreamedCycle::solve_by_levels(std::span<const double> b, std::span<double> c) const {
  const std::size_t last = levels_.size() - 1;
  const auto right = [&](std::size_t k) { return k == 0 ? b : std::span<const double>(levels_[k].right); };
  for (std::size_t k = 0; k < last; ++k)
    (*hierarchy_)[static_cast<int>(k)].restriction->apply(right(k), levels_[k + 1].right);
  for (std::size_t k = last + 1; k-- > 0;) {
    StreamedSmoother::Start start;
    if (k < last) {
      const auto& cubic = levels_[k].cubic;
      start.coarse = levels_[k + 1].x.data();
      start.refinement = cubic ? &*cubic : &*(*hierarchy_)[static_cast<int>(k)].refinement;
    }
    improve(Kind::ByLevels, k, start, right(k), k == 0 ? c : levels_[k].x);
  }
}

double StreamedCycle::work_by_levels() const {
  double sum = 0;
  for (int k = 0; k < hierarchy_->size(); ++k) sum += static_cast<double>((*hierarchy_)[k].space.size());
  return sum / static_cast<double>(hierarchy_->finest().space.size());
}

}  // namespace batten
