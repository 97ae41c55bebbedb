// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/fem/multigrid.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace batten {
namespace {

// Cubic B-splines oscillate at a far smaller energy than quadratic ones, so their smoother works harder. Measured:
// degree + 1 needs the least time for membrane, thin plate and tension alike.
int degree_of_smoothing(int spline_degree) { return spline_degree + 1; }

constexpr std::size_t largest_grid_factor = 40'000;  // coefficients
constexpr double largest_points_factor = 6e6;        // estimated entries of K
constexpr double very_large_lambda = 1e3;
constexpr double largest_predicted_stiffness = 1e8;

/// Keeps rounding from adding up in a constant that no equation knows.
void subtract_mean(std::vector<double>& v) {
  constexpr int row = 1024;
  const auto n = static_cast<std::ptrdiff_t>(v.size());
  const double sum = sum_blocks(RowBlocks(static_cast<int>((n + row - 1) / row), row), [&](int begin, int end) {
    return std::accumulate(v.begin() + begin * std::ptrdiff_t{row},
                           v.begin() + std::min<std::ptrdiff_t>(n, end * std::ptrdiff_t{row}), 0.);
  });
  const double mean = sum / static_cast<double>(n);
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) v[static_cast<std::size_t>(i)] -= mean;
}

/// Coefficients that the data see; the others stay alone in a factorisation.
std::size_t coupled_coefficients(const SymmetricStencil& data) {
  std::size_t count = 0;
  for (int j = 0; j < data.rows(); ++j)
    for (int i = 0; i < data.columns(); ++i) count += data.entry(i, j, 0, 0) != 0;
  return count;
}

}  // namespace

Multigrid::Multigrid(const Hierarchy& hierarchy, const GridPoints& points)
    : hierarchy_(&hierarchy),
      streams_(points.size() == 0 && !hierarchy.finest().energy.stencil() && !hierarchy.finest().space.is_periodic()),
      vectors_(static_cast<std::size_t>(hierarchy.size())),
      degree_(degree_of_smoothing(hierarchy.degree())),
      repeats_(hierarchy.finest().energy.stencil() != nullptr),
      grounded_(points.are_slopes() && hierarchy.finest().space.holds_constants()) {
  for (int k = 0; k < hierarchy.size(); ++k) {
    const std::size_t n = hierarchy[k].space.size();
    levels_.emplace_back(hierarchy[k], points, k + 1 == hierarchy.size());
    work_.emplace_back(streams_ ? 0 : n);
    repeat_.push_back(repeats_ && k > 0 ? Repeat{std::vector<double>(n), std::vector<double>(n)} : Repeat{});
  }
}

bool Multigrid::can_be_data_aware() const {
  const auto& finest = levels_.front();
  const double n = static_cast<double>(finest.size()), count = static_cast<double>(data().size());
  if (data().is_stored()) return coupled_coefficients(data().stencil()) <= largest_grid_factor;
  const double band = 2. * hierarchy_->degree() + 1;
  return count * (1 + band * band * count / n) / 2 < largest_points_factor;
}

void Multigrid::set(double lambda, std::span<const double> weights, std::span<const double> beside) {
  if (!(lambda > 0)) throw InvalidInput("Multigrid::set: expected lambda > 0, found " + std::to_string(lambda));
  PairWeights w(weights, beside);
  if (lambda == lambda_ && w == data().weights()) return;
  lambda_ = 0;  // until all levels are set: a factorisation may fail
  auto& finest = levels_.front();
  finest.set(lambda, w, Smoother::Kind::Plain);
  const auto give = finest.compliance();
  double stiffness = 0;
  for (std::size_t i = 0; i < w.size(); ++i) stiffness = std::max(stiffness, w.diagonal[i] * give[i]);
  data_aware_ = levels_.size() > 1 && stiffness > 0.5 && can_be_data_aware();
  if (data_aware_) finest.set(lambda, w, Smoother::Kind::DataAware);
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    if (data_aware_) w.soften(levels_[k - 1].compliance());
    if (!data_aware_ && levels_[k - 1].data().is_stored())
      levels_[k].set_from_finer(levels_[k - 1]);
    else
      levels_[k].set(lambda, w, Smoother::Kind::Plain);
  }
  factor_coarsest();
  if (streams_) streamed_.emplace(*hierarchy_, degree_, lambda, *coarsest_);
  // by differences, rounding grows with the root of the stiffness only
  const double rounding =
      finest.level().energy.is_by_differences() ? std::sqrt(finest.stiffness()) : finest.stiffness();
  can_predict_ = levels_.size() > 1 && !data_aware_ && rounding < largest_predicted_stiffness;
  null_projection_.reset();
  if (lambda > very_large_lambda && finest.level().space.is_unconstrained())
    null_projection_.emplace(finest.level().space, data(), hierarchy_->energy().null_degree());
  lambda_ = lambda;
}

void Multigrid::factor_coarsest() {
  const auto& level = levels_.back();
  const auto& space = level.level().space;
  const int d = hierarchy_->degree(), nx = space.x.size(), ny = space.y.size();
  ground_ = 0;
  while (space.is_removed(static_cast<int>(ground_) % nx, static_cast<int>(ground_) / nx)) ++ground_;
  std::vector<Eigen::Triplet<double>> entries;
  double largest = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int dy = 0; dy <= std::min(d, ny - 1 - j); ++dy)
        for (int dx = dy == 0 ? 0 : std::max(-d, -i); dx <= std::min(d, nx - 1 - i); ++dx) {
          double value = level.lambda() * level.level().energy.entry(i, j, i + dx, j + dy) +
                         level.data().stencil().entry(i, j, dx, dy);
          if (dx == 0 && dy == 0 && space.is_removed(i, j)) entries.emplace_back(j * nx + i, j * nx + i, 1.);
          largest = std::max(largest, value);
          const auto [column, row] = std::minmax({space.original(i, j), space.original(i + dx, j + dy)});
          if (grounded_ && column != row && (column == ground_ || row == ground_)) continue;
          entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
        }
  Eigen::SparseMatrix<double> lower(nx * ny, nx * ny);
  lower.setFromTriplets(entries.begin(), entries.end());
  try {
    coarsest_.emplace(lower);
  } catch (const SolverError&) {
    // λ so large that the data drown in the rounding of E: a shift of that size keeps the preconditioner definite.
    for (int i = 0; i < nx * ny; ++i) lower.coeffRef(i, i) += 1e-14 * largest * nx;
    coarsest_.emplace(lower);
  }
}

void Multigrid::precondition(std::span<const double> r, std::vector<double>& out, std::size_t level) const {
  const bool project = null_projection_ && level == 0;
  if (project) {
    out.assign(r.begin(), r.end());
    null_projection_->project_transposed(out);
    r = out;
  }
  out.resize(size(level));
  if (streamed_) {
    streamed_->improve(level, {}, r, out);
  } else {
    cycle(level, r);
    std::swap(out, work_[level].x);
  }
  if (grounded_) subtract_mean(out);
  if (project) null_projection_->project(out);
}

void Multigrid::cycle(std::size_t k, std::span<const double> r) const {
  auto& work = work_[k];
  if (k + 1 == levels_.size()) {
    work.x.assign(r.begin(), r.end());
    if (grounded_) work.x[ground_] = 0;
    coarsest_->solve(work.x);
    return fill_images(levels_[k].level().space, work.x);
  }
  levels_[k].smooth_first(degree_, r, work);
  if (repeats_ && k + 2 < levels_.size()) {
    hierarchy_->restrict_from(static_cast<int>(k), work.r, repeat_[k + 1].right);
    cycle_twice(k + 1);
  } else {
    hierarchy_->restrict_from(static_cast<int>(k), work.r, work_[k + 1].r);
    cycle(k + 1, work_[k + 1].r);
  }
  levels_[k].smooth_last(degree_, work_[k + 1].x, work);
}

/// Solves for repeat_[k].right by a cycle, and by a second one for what the first has left.
void Multigrid::cycle_twice(std::size_t k) const {
  auto& work = work_[k];
  auto& [right, first] = repeat_[k];
  cycle(k, right);
  std::swap(first, work.x);
  work.x.resize(first.size());
  levels_[k].apply(first, work.r);
  for (std::size_t i = 0; i < right.size(); ++i) work.r[i] = right[i] - work.r[i];
  cycle(k, work.r);
  for (std::size_t i = 0; i < first.size(); ++i) work.x[i] += first[i];
}

}  // namespace batten
