// SPDX-License-Identifier: MIT
#include <batten/fem/bilinear_rows.h>
#include <batten/fem/bilinear_smoother.h>
#include <batten/fem/bilinear_transfer.h>
#include <batten/fem/streamed_block.h>

#include <omp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

namespace batten {
namespace {

constexpr int panel_columns = 4096;                // the rings of so many fit in the second-level cache
constexpr int margin = 8;                          // columns beyond a panel that its steps take in, a cache line
constexpr int most_steps = margin - 2;             // of a pass, so that it needs no more than the margin
constexpr int inner_weights = 7, end_weights = 9;  // in a row of them
constexpr std::size_t shared_size = 20000;         // smaller levels are left to one thread

/// The last few rows of a vector that passes by, some of its columns. Those beyond the ends of the grid hold 0.
class Ring {
public:
  Ring() = default;
  /// Takes `height` rows, a power of two, from `memory` on.
  Ring(double*& memory, int height, int stride, int first)
      : rows_(memory), mask_(height - 1), stride_(stride), first_(first) {
    memory += height * stride_;
  }
  /// Where column 0 of row j would be.
  double* operator[](int j) const { return rows_ + (j & mask_) * stride_ - first_; }

private:
  double* rows_ = nullptr;
  int mask_ = 0;
  std::ptrdiff_t stride_ = 0, first_ = 0;
};

int panels(int columns) { return std::max(1, (columns + panel_columns / 2) / panel_columns); }

RowRange repeated_rows(const SplineBasis& basis) {
  const BandedRows mass = basis.inner_products(0), stiffness = basis.inner_products(1);
  return {std::max(mass.begin, stiffness.begin), std::min(mass.end, stiffness.end)};
}

std::vector<int> end_columns(const Hierarchy::Level& level) {
  const RowRange inner = repeated_rows(level.space.x);
  std::vector<int> result;
  for (int i = 0; i < level.energy.columns(); ++i)
    if (i < inner.begin || i >= inner.end) result.push_back(i);
  return result;
}

}  // namespace

/// What one pass reads and writes: `descend` and `turn` have coarse_right, `ascend` has not.
struct BilinearSmoother::Job {
  Start start;  // both for `ascend` and `turn`: the sum of the two
  const double* b = nullptr;
  double* x = nullptr;
  double* coarse_right = nullptr;
  bool measure = false;
  int times = 1;  // that the steps of the polynomial are done
};

/// One pass over one block of rows and columns. Stage 0 brings b and the start, stages 1 .. steps make x_1 .. x_steps,
/// the next one the last residual. Row j of a stage is one row behind that of the stage before.
class BilinearSmoother::Block {
public:
  Block(const BilinearSmoother& smoother, const Job& job, BlockPlace rows, BlockPlace columns,
        std::vector<double>& memory)
      : s_(smoother),
        job_(job),
        level_(*smoother.level_),
        rows_(level_.energy.rows()),
        n_(level_.energy.columns()),
        steps_(job.times * static_cast<int>(smoother.steps_.size())),
        begin_(steps_ - static_cast<int>(smoother.steps_.size())),
        last_(job.coarse_right ? steps_ + 1 : steps_),
        panel_(columns.index),
        panels_(columns.count),
        has_start_(job.start.given || job.start.coarse),
        own_rows_(part<RowRange>(rows_, rows)),
        needed_rows_(own_rows_) {
    const bool is_last = panel_ + 1 == panels_;
    own_ = {panel_ * panel_columns, is_last ? n_ : (panel_ + 1) * panel_columns};
    all_ = widened(own_, margin, n_);
    if (job.coarse_right) {
      const auto& term = level_.restriction->terms().front();
      const int by = halves_columns(*level_.refinement) ? 2 : 1;
      coarse_ = {own_.begin / by, is_last ? term.x.rows : own_.end / by};
      coarse_rows_ = part<RowRange>(term.y.rows, rows);
      needed_rows_ = with_inputs(own_rows_, term.y, coarse_rows_);
      next_coarse_ = coarse_rows_.begin;
    }
    allocate(memory);
  }

  void run() {
    for (int front = rows(0).begin; front < needed_rows_.end + last_; ++front)
      for (int stage = 0; stage <= last_; ++stage) {
        const int row = front - stage;
        if (const RowRange range = rows(stage); row >= range.begin && row < range.end) work(stage, row);
      }
  }

private:
  /// The rows of a stage that the stages after it need.
  RowRange rows(int stage) const { return widened(needed_rows_, last_ - stage, rows_); }
  std::ptrdiff_t at(int j) const { return static_cast<std::ptrdiff_t>(j) * n_; }
  bool is_own(int j) const { return j >= own_rows_.begin && j < own_rows_.end; }
  int size() const { return all_.end - all_.begin; }

  void allocate(std::vector<double>& memory) {
    const int window = std::max(4, level_.restriction->band_height());
    const auto power = [](int rows) { return static_cast<int>(std::bit_ceil(static_cast<unsigned>(rows))); };
    const int height = power(std::max(last_ - begin_ + 1, window)), passed = power(last_ + 1);
    const int stride = (own_.end - own_.begin + 7) / 8 * 8 + 5 * margin, first = own_.begin - 2 * margin;
    const auto numbers = static_cast<std::size_t>((passed + (steps_ + 2) * height) * stride);
    if (memory.size() < numbers + 8) memory.resize(numbers + 8);
    auto* next = reinterpret_cast<double*>((reinterpret_cast<std::uintptr_t>(memory.data()) + 63) / 64 * 64);
    std::fill_n(next, numbers, 0.);
    b_ = Ring(next, passed, stride, first);
    r_ = Ring(next, height, stride, first);
    for (int k = 0; k <= steps_; ++k) x_[static_cast<std::size_t>(k)] = Ring(next, height, stride, first);
  }

  const Ring& x(int k) const { return x_[static_cast<std::size_t>(k)]; }

  void work(int stage, int j) {
    if (stage == 0) return bring(j);
    if (stage > steps_) return finish(j);
    step(stage, j);
  }

  /// True if whole cache lines can be read of row j of a vector in memory.
  bool has_more_behind(int j) const { return at(j) + all_.end + 2 * margin <= at(rows_); }
  /// Row j of b, where its column 0 would be: a copy where there is not enough behind it.
  const double* b(int j) const { return has_more_behind(j) ? job_.b + at(j) : b_[j]; }

  void bring(int j) {
    if (!has_more_behind(j)) copy_row(job_.b + at(j) + all_.begin, b_[j] + all_.begin, size());
    if (job_.start.coarse)
      refine(j);
    else if (job_.start.given)
      copy_row(job_.start.given + at(j) + all_.begin, x(0)[j] + all_.begin, size());
  }

  /// Row j of the refined start.
  void refine(int j) {
    const double* given = job_.start.given ? job_.start.given + at(j) : nullptr;
    refine_columns({*job_.start.refinement, job_.start.coarse}, j, all_, {given, has_more_behind(j)}, x(0)[j]);
  }

  /// out = gain b - keep before + (from - gain λ E) c_j in the inner columns, from and gain in units of M^-1 if asked.
  void stencil(int stage, int j, const Ring& c, double from, double gain, double keep, const double* before,
               ColumnRange range, double* out) const {
    const double* w = s_.weights_.row(j);
    BilinearWeights weights;
    for (int q = 0; q < 3; ++q) weights.near[q] = -gain * w[q], weights.far[q] = -gain * w[3 + q];
    weights.near[1] += from;
    const std::ptrdiff_t at = range.begin;
    const BilinearInputs in = {{c[std::max(j - 1, 0)] + at, c[j] + at, c[std::min(j + 1, rows_ - 1)] + at},
                               gain,
                               b(j) + at,
                               keep,
                               before ? before + at : nullptr,
                               {soon(stage, j, 0) + at, soon(stage, j, 1) + at}};
    bilinear_row(weights, in, out + at, range.end - range.begin);
  }

  /// What the next rows need from memory: a pass starts too many rows for the processor to foresee it. The first
  /// stencil of a pass asks for what is read, the last one for what is written.
  const double* soon(int stage, int j, int index) const {
    const int first = has_start_ ? 1 : 2;
    if (stage > first || (stage == last_ && index == 1)) return job_.x + at(std::min(j + 1, rows_ - 1));
    return (index == 1 && job_.start.given ? job_.start.given : job_.b) + at(std::min(j + stage + 1, rows_ - 1));
  }

  /// visit(i, b_i - λ (E c)_i) for the columns i of row j whose weights differ.
  template <typename Visit>
  void for_ends(int j, const Ring& c, Visit&& visit) const {
    const double* const rows[] = {c[std::max(j - 1, 0)], c[j], c[std::min(j + 1, rows_ - 1)]};
    const double* w = s_.weights_.row(j) + inner_weights;
    for (const int i : s_.end_columns_) {
      if (i >= all_.begin && i < all_.end) {
        double r = b(j)[i];
        for (int q = 0; q < 3; ++q)
          r -= w[3 * q] * rows[q][i - 1] + w[3 * q + 1] * rows[q][i] + w[3 * q + 2] * rows[q][i + 1];
        visit(i, r);
      }
      w += end_weights;
    }
  }

  /// Row j of x_k.
  void step(int k, int j) const {
    const auto [keep, gain] = s_.steps_[static_cast<std::size_t>(k - 1) % s_.steps_.size()];
    const bool is_result = k == last_;  // of `ascend`
    const ColumnRange range = is_result ? own_ : all_;
    double* out = is_result ? job_.x + at(j) : x(k)[j];
    const double* inverse = s_.inverse_.row(j);
    if (k == 1 && !has_start_)
      return multiply_rows(gain, inverse + all_.begin, b(j) + all_.begin, out + all_.begin, size());
    const double* before = k == 2 && !has_start_ ? nullptr : k > 1 ? x(k - 2)[j] : nullptr;
    const Ring& c = x(k - 1);
    stencil(k, j, c, 1 + keep, gain * s_.weights_.row(j)[6], keep, before, range, out);
    for_ends(j, c, [&, keep = keep, gain = gain](int i, double r) {
      if (i < range.begin || i >= range.end) return;
      const double value = c[j][i];
      out[i] = value + keep * (before ? value - before[i] : value) + gain * (inverse[i] * r);
    });
  }

  /// The last residual, x and the part of the product that `measure` asks for.
  void finish(int j) {
    double* r = r_[j];
    stencil(steps_ + 1, j, x(steps_), 0, 1, 0, nullptr, all_, r);
    for_ends(j, x(steps_), [r](int i, double value) { r[i] = value; });
    if (is_own(j)) {
      copy_row(x(steps_)[j] + own_.begin, job_.x + at(j) + own_.begin, own_.end - own_.begin);
      if (job_.measure) s_.sums_[static_cast<std::size_t>(j * panels_ + panel_)] = {product(j), work(j)};
    }
    restrict_rows(j);
  }

  /// (x - s)·(r_0 + r) of row j, where the first residual is r_0 = M (x_1 - s) / gain.
  double product(int j) const {
    const double gain = s_.steps_.front().gain, inner_inverse = s_.weights_.row(j)[6];
    if (inner_inverse == 0) return 0;  // a row whose functions a condition takes away
    const double inside = 1 / (gain * inner_inverse);
    const double *found = x(steps_)[j], *first = x(begin_ + 1)[j], *start = has_start_ ? x(begin_)[j] : nullptr;
    const double* inverse = s_.inverse_.row(j);
    const std::ptrdiff_t from = own_.begin;
    double sum = sum_of_changes(start ? start + from : nullptr, found + from, inside, first + from, r_[j] + from,
                                own_.end - own_.begin);
    for (const int i : s_.end_columns_) {
      if (i < own_.begin || i >= own_.end || inverse[i] == 0) continue;
      const double s = start ? start[i] : 0;
      sum += (found[i] - s) * (1 / (gain * inverse[i]) - inside) * (first[i] - s);
    }
    return sum;
  }

  /// b·s of row j, where it is asked for.
  double work(int j) const {
    return job_.times == 1 ? 0 : product_of_rows(b(j) + own_.begin, x(begin_)[j] + own_.begin, own_.end - own_.begin);
  }

  /// The coarse rows whose last fine row is j.
  void restrict_rows(int j) {
    const auto& restriction = *level_.restriction;
    for (; next_coarse_ < coarse_rows_.end; ++next_coarse_) {
      const int first = restriction.first_row(next_coarse_), height = restriction.band_height();
      if (first + height - 1 > j) return;
      std::array<const double*, 2 * margin> table{};
      for (int q = 0; q < height; ++q) table[static_cast<std::size_t>(q)] = r_[first + q];
      const auto row = static_cast<std::ptrdiff_t>(next_coarse_) * restriction.output_columns();
      restrict_columns(restriction, next_coarse_, {table.data(), own_.begin}, coarse_, job_.coarse_right + row);
    }
  }

  const BilinearSmoother& s_;
  const Job& job_;
  const Hierarchy::Level& level_;
  int rows_, n_, steps_;
  int begin_;  // the step whose result is the start of what is measured
  int last_;   // stages 0 .. last_
  int panel_, panels_;
  bool has_start_;
  RowRange own_rows_, coarse_rows_;
  RowRange needed_rows_;  // of the last stage
  ColumnRange own_, coarse_;
  ColumnRange all_;  // of each stage: those that lack neighbours beyond are not used
  int next_coarse_ = 0;
  Ring b_, r_;
  std::array<Ring, most_steps + 1> x_;
};

BilinearSmoother::BilinearSmoother(const Hierarchy::Level& level, int steps, double lambda)
    : level_(&level),
      lambda_(lambda),
      inverse_(inverse_diagonal(level, lambda)),
      end_columns_(end_columns(level)),
      weights_(level.energy.rows(), inner_weights + end_weights * static_cast<int>(end_columns_.size()),
               repeated_rows(level.space.y)),
      sums_(static_cast<std::size_t>(level.energy.rows() * panels(level.energy.columns()))) {
  for (int i = 0; i < steps; ++i) steps_.push_back(chebyshev_step(i));
  set_weights();
}

void BilinearSmoother::set_weights() {
  const int rows = level_->energy.rows(), columns = level_->energy.columns();
  const int inside = std::clamp(repeated_rows(level_->space.x).begin, 0, columns - 2);
  const auto weight = [&](int i, int j, int k, int l) {
    return k < 0 || k >= columns || l < 0 || l >= rows ? 0. : lambda_ * level_->energy.entry(i, j, k, l);
  };
  for (int j = 0; j < rows; ++j) {
    if (weights_.is_repeated(j)) continue;
    double* w = weights_.row(j);
    for (int q = 0; q < 3; ++q) {
      w[q] = weight(inside, j, inside, j - 1 + q);
      w[3 + q] = weight(inside, j, inside + 1, j - 1 + q);
    }
    w[6] = inverse_.row(j)[inside];
    w += inner_weights;
    for (const int i : end_columns_)
      for (int q = 0; q < 3; ++q)
        for (int p = 0; p < 3; ++p) *w++ = weight(i, j, i - 1 + p, j - 1 + q);
  }
}

void BilinearSmoother::run(const Job& job, Rings& rings) const {
  const int stages = job.times * static_cast<int>(steps_.size()) + 2, columns = panels(level_->energy.columns());
  const int most = level_->space.size() < shared_size ? 1 : level_->energy.rows() / (4 * stages);
  const int blocks = std::clamp(omp_get_max_threads(), 1, std::max(most, 1));
  if (rings.size() < static_cast<std::size_t>(blocks)) rings.resize(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(static) num_threads(blocks) if (blocks > 1)
  for (int k = 0; k < blocks; ++k)
    for (int panel = 0; panel < columns; ++panel)
      Block(*this, job, {k, blocks}, {panel, columns}, rings[static_cast<std::size_t>(k)]).run();
}

BilinearSmoother::Turn BilinearSmoother::sum() const {
  Turn sum;
  for (const auto& [product, work] : sums_) sum.product += product, sum.work += work;
  return sum;
}

double BilinearSmoother::descend(const Start& start, std::span<const double> b, std::span<double> x,
                                 std::span<double> coarse_right, bool measure, Rings& rings) const {
  run({start, b.data(), x.data(), coarse_right.data(), measure}, rings);
  return measure ? sum().product : 0;
}

void BilinearSmoother::ascend(std::span<const double> x, std::span<const double> coarse, std::span<const double> b,
                              std::span<double> out, Rings& rings) const {
  run({{x.data(), coarse.data(), &*level_->refinement}, b.data(), out.data(), nullptr}, rings);
}

BilinearSmoother::Turn BilinearSmoother::turn(std::span<const double> x, std::span<const double> coarse,
                                              std::span<const double> b, std::span<double> out,
                                              std::span<double> coarse_right, Rings& rings) const {
  run({{x.data(), coarse.data(), &*level_->refinement}, b.data(), out.data(), coarse_right.data(), true, 2}, rings);
  return sum();
}

}  // namespace batten
