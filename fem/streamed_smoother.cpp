// SPDX-License-Identifier: MIT
#include <batten/fem/streamed_block.h>
#include <batten/fem/streamed_rows.h>
#include <batten/fem/streamed_smoother.h>

#include <omp.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace batten {
namespace {

constexpr int piece_columns = 512;          // of a row that is worked on at a time, in the first-level cache
constexpr int panel_numbers = 75000;        // of the rings of one, which then fit in the second-level cache
constexpr std::size_t shared_size = 20000;  // smaller levels are left to one thread

/// The last few rows of a vector that passes by, some of its columns.
class Ring {
public:
  Ring() = default;
  /// Takes its rows from `memory` on.
  Ring(double*& memory, int height, ColumnRange columns)
      : rows_(memory), height_(height), stride_(stride(columns)), first_(columns.begin) {
    memory += height * stride_;
  }
  /// Where column 0 of row j would be.
  double* operator[](int j) const { return rows_ + (j % height_) * stride_ - first_; }
  static std::ptrdiff_t stride(ColumnRange columns) { return (columns.end - columns.begin + 7) / 8 * 8 + 8; }

private:
  double* rows_ = nullptr;
  int height_ = 1;
  std::ptrdiff_t stride_ = 0, first_ = 0;
};

/// Asks for numbers that are read soon: a pass starts too many rows for the processor to foresee it.
void prefetch(const double* row, int n) {
  for (int i = 0; i < n; i += 8) __builtin_prefetch(row + i);
}

/// Rows of all rings at the most: where a start is refined, the residual restricted and the product measured.
int ring_rows(const Hierarchy::Level& level, int steps) {
  const int reach = level.space.y.degree(), behind = steps * reach + 1;
  const int window = level.restriction ? level.restriction->band_height() : 0;
  return 4 * behind + 2 * reach + window + steps * (2 * reach + 2);
}

int panels(const Hierarchy::Level& level, int steps) {
  const int columns = std::max(1, panel_numbers / ring_rows(level, steps));
  return std::max(1, (level.energy.columns() + columns / 2) / columns);
}

}  // namespace

/// What one pass reads and writes: `descend` has coarse_right, `ascend` has not.
struct StreamedSmoother::Job {
  Start start;  // both for `ascend`: the sum of the two
  const double* b = nullptr;
  double* x = nullptr;
  double* coarse_right = nullptr;
  bool measure = false;
};

/// One pass over one block of rows and columns: refine the start, first step, further steps, last residual with
/// restriction.
class StreamedSmoother::Block {
public:
  Block(const StreamedSmoother& smoother, const Job& job, BlockPlace rows, BlockPlace columns,
        std::vector<double>& memory)
      : s_(smoother),
        job_(job),
        level_(*smoother.level_),
        rows_(level_.energy.rows()),
        n_(level_.energy.columns()),
        reach_(level_.space.y.degree()),
        steps_(static_cast<int>(smoother.steps_.size())),
        first_(job.start.coarse ? 0 : 1),
        last_(job.coarse_right ? steps_ + 1 : steps_),
        panel_(columns.index),
        panels_(columns.count),
        own_rows_(part<RowRange>(rows_, rows)),
        own_(part<ColumnRange>(n_, columns)),
        needed_rows_(own_rows_),
        needed_(own_) {
    if (job.coarse_right) {
      const auto& term = level_.restriction->terms().front();
      coarse_rows_ = part<RowRange>(term.y.rows, rows);
      coarse_ = part<ColumnRange>(term.x.rows, columns);
      needed_rows_ = with_inputs(own_rows_, term.y, coarse_rows_);
      needed_ = with_inputs(own_, term.x, coarse_);
    }
    allocate(memory);
  }

  void run() {
    const int front_end = needed_rows_.end + (last_ - first_) * reach_;
    for (int front = rows(first_).begin; front < front_end; ++front)
      for (int stage = first_; stage <= last_; ++stage) {
        const int row = front - (stage - first_) * reach_;
        if (const RowRange range = rows(stage); row >= range.begin && row < range.end) work(stage, row);
      }
  }

private:
  /// The rows and columns of a stage that the stages after it need.
  RowRange rows(int stage) const { return widened(needed_rows_, (last_ - stage) * reach_, rows_); }
  ColumnRange columns(int stage) const { return widened(needed_, (last_ - stage) * reach_, n_); }
  std::ptrdiff_t at(int j) const { return static_cast<std::ptrdiff_t>(j) * n_; }
  bool is_own(int j) const { return j >= own_rows_.begin && j < own_rows_.end; }

  /// Each ring holds the rows between the stage that makes them and the last one that reads them.
  void allocate(std::vector<double>& memory) {
    const int behind = steps_ * reach_ + 1;  // rows from the first step to the last residual
    const int window = job_.coarse_right ? level_.restriction->band_height() : 0;
    const int start = job_.start.coarse ? behind + 2 * reach_ : 0, right = job_.measure ? behind : 0;
    const int sum = steps_ > 1 ? behind : 0, z = 2 * reach_ + 2;
    const int all = start + right + behind + window + sum + steps_ * z;
    const ColumnRange widest = columns(first_);
    const auto size = static_cast<std::size_t>(all * Ring::stride(widest));
    if (memory.size() < size) memory.resize(size);
    double* at = memory.data();
    if (start > 0) start_ = Ring(at, start, widest);
    if (right > 0) right_ = Ring(at, right, widest);
    r_ = Ring(at, behind + window, widest);
    if (sum > 0) sum_ = Ring(at, sum, widest);
    for (int k = 0; k < steps_; ++k) z_[static_cast<std::size_t>(k)] = Ring(at, z, widest);
    next_coarse_ = coarse_rows_.begin;
  }

  /// What the first stages read of the next row in memory.
  void prefetch_next(int stage, int j) const {
    const ColumnRange c = columns(stage);
    const int ahead = job_.start.given && stage == 1 && first_ == 1 ? j + reach_ + 2 : j + 1;
    if (stage == 1 && j + 1 < rows_) prefetch(job_.b + at(j + 1) + c.begin, c.end - c.begin);
    if (stage == first_ && job_.start.given && ahead < rows_)
      prefetch(job_.start.given + at(ahead) + c.begin, c.end - c.begin);
  }

  /// Stage 0 refines, stage 1 .. steps make z_1 .. z_steps, the next one the last residual.
  void work(int stage, int j) {
    if (stage <= 1) prefetch_next(stage, j);
    if (stage == 0) return refine(j);
    const Ring* z = stage > 1 ? &z_[static_cast<std::size_t>(stage - 2)] : nullptr;
    const bool has_start = job_.start.coarse || job_.start.given;
    std::array<const double*, 2 * SplineBasis::max_degree + 1> table{};
    const int first = level_.energy.first_row(j);
    for (int q = 0; q < level_.energy.band_height(); ++q)
      table[static_cast<std::size_t>(q)] = z ? (*z)[first + q] : has_start ? start_row(first + q) : nullptr;
    std::array<double, piece_columns> ae;
    double product = 0;
    const ColumnRange all = columns(stage);
    for (int from = all.begin; from < all.end; from += piece_columns) {
      const ColumnRange piece = {from, std::min(from + piece_columns, all.end)};
      if (z || (has_start && !level_.energy.is_delicate()))
        level_.energy.rough_row(j, table.data(), piece, ae.data());
      else if (has_start)
        level_.energy.row(j, table.data(), piece, ae.data());
      if (stage == 1)
        begin(j, piece, has_start ? ae.data() : nullptr);
      else if (stage <= steps_)
        step(stage, j, piece, ae.data());
      else
        product += finish(j, piece, ae.data());
    }
    if (stage > steps_) {
      if (job_.measure && is_own(j)) s_.sums_[static_cast<std::size_t>(j * panels_ + panel_)] = product;
      restrict_rows(j);
    }
  }

  const double* start_row(int j) const { return job_.start.coarse ? start_[j] : job_.start.given + at(j); }

  void refine(int j) {
    const ColumnRange c = columns(0);
    const TensorSum& refinement = *job_.start.refinement;
    std::array<const double*, SplineBasis::max_degree + 2> table{};
    for (int q = 0; q < refinement.band_height(); ++q)
      table[static_cast<std::size_t>(q)] =
          job_.start.coarse + static_cast<std::ptrdiff_t>(refinement.first_row(j) + q) * refinement.input_columns();
    double* row = start_[j] + c.begin;
    refinement.row(j, table.data(), c, row);
    if (job_.start.given) add_rows(job_.start.given + at(j) + c.begin, row, row, c.end - c.begin);
  }

  void begin(int j, ColumnRange c, const double* ae) {
    const double* b = job_.b + at(j) + c.begin;
    const double gain = s_.steps_.front().gain;
    double* r = r_[j] + c.begin;
    const std::ptrdiff_t n = c.end - c.begin;
    if (ae)
      first_step(s_.lambda_, gain, s_.inverse_.row(j) + c.begin, b, ae, r, z_[0][j] + c.begin, n);
    else
      first_step_from_zero(gain, s_.inverse_.row(j) + c.begin, b, r, z_[0][j] + c.begin, n);
    if (job_.measure) std::copy_n(r, n, right_[j] + c.begin);
  }

  /// Makes z_k and, for every second k and the last one, adds what came since to the sum.
  void step(int k, int j, ColumnRange c, const double* ae) {
    const auto& [keep, gain] = s_.steps_[static_cast<std::size_t>(k - 1)];
    const StepFactors factors = {s_.lambda_, keep, gain};
    const std::ptrdiff_t n = c.end - c.begin;
    const double* inverse = s_.inverse_.row(j) + c.begin;
    const double* z = z_[static_cast<std::size_t>(k - 2)][j] + c.begin;
    double* next = z_[static_cast<std::size_t>(k - 1)][j] + c.begin;
    double* r = r_[j] + c.begin;
    double* sum = sum_[j] + c.begin;
    double* target = k == last_ ? job_.x + at(j) + c.begin : sum;  // the last stage has nothing but rows of its own
    if (k % 2 == 0) {
      const double* before = k > 2 ? sum : job_.coarse_right ? nullptr : start_[j] + c.begin;
      next_step_with_sum(factors, inverse, ae, z, r, next, before, target, n);
    } else {
      next_step(factors, inverse, ae, z, r, next, n);
      if (k == steps_) add_rows(sum, next, target, n);
    }
  }

  /// The last residual and x; returns the part of the product that `measure` asks for.
  double finish(int j, ColumnRange c, const double* ae) {
    double* r = r_[j] + c.begin;
    last_residual(s_.lambda_, ae, r, c.end - c.begin);
    const ColumnRange own = {std::max(c.begin, own_.begin), std::min(c.end, own_.end)};
    if (!is_own(j) || own.begin >= own.end) return 0;
    const std::ptrdiff_t n = own.end - own.begin;
    const double* sum = (steps_ > 1 ? sum_ : z_[0])[j] + own.begin;
    double* x = job_.x + at(j) + own.begin;
    if (job_.start.coarse || job_.start.given)
      add_rows(start_row(j) + own.begin, sum, x, n);
    else
      std::copy_n(sum, n, x);
    return job_.measure ? sum_of_products(sum, right_[j] + own.begin, r_[j] + own.begin, n) : 0;
  }

  /// The coarse rows whose last fine row is j.
  void restrict_rows(int j) {
    const auto& restriction = *level_.restriction;
    for (; next_coarse_ < coarse_rows_.end; ++next_coarse_) {
      const int first = restriction.first_row(next_coarse_), height = restriction.band_height();
      if (first + height - 1 > j) return;
      std::array<const double*, SplineBasis::max_degree + 3> table{};
      for (int q = 0; q < height; ++q) table[static_cast<std::size_t>(q)] = r_[first + q];
      const auto row = static_cast<std::ptrdiff_t>(next_coarse_) * restriction.output_columns();
      restriction.row(next_coarse_, table.data(), coarse_, job_.coarse_right + row + coarse_.begin);
    }
  }

  const StreamedSmoother& s_;
  const Job& job_;
  const Hierarchy::Level& level_;
  int rows_, n_, reach_, steps_, first_, last_;  // stages first_ .. last_
  int panel_, panels_;
  RowRange own_rows_, coarse_rows_;
  ColumnRange own_, coarse_;
  RowRange needed_rows_;  // of the last stage
  ColumnRange needed_;
  int next_coarse_ = 0;
  Ring start_, right_, r_, sum_;
  std::array<Ring, SplineBasis::max_degree + 1> z_;
};

StreamedSmoother::StreamedSmoother(const Hierarchy::Level& level, int steps, double lambda)
    : level_(&level),
      lambda_(lambda),
      inverse_(inverse_diagonal(level, lambda)),
      panels_(panels(level, steps)),
      sums_(static_cast<std::size_t>(level.energy.rows() * panels_)) {
  for (int i = 0; i < steps; ++i) steps_.push_back(chebyshev_step(i));
}

void StreamedSmoother::run(const Job& job, Rings& rings) const {
  const int stages = static_cast<int>(steps_.size()) + 2, least = 4 * stages * level_->space.y.degree();
  const int most = level_->space.size() < shared_size ? 1 : level_->energy.rows() / least;
  const int blocks = std::clamp(omp_get_max_threads(), 1, std::max(most, 1));
  if (rings.size() < static_cast<std::size_t>(blocks)) rings.resize(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(static) num_threads(blocks) if (blocks > 1)
  for (int k = 0; k < blocks; ++k)
    for (int panel = 0; panel < panels_; ++panel)
      Block(*this, job, {k, blocks}, {panel, panels_}, rings[static_cast<std::size_t>(k)]).run();
}

double StreamedSmoother::descend(const Start& start, std::span<const double> b, std::span<double> x,
                                 std::span<double> coarse_right, bool measure, Rings& rings) const {
  run({start, b.data(), x.data(), coarse_right.data(), measure}, rings);
  return measure ? std::accumulate(sums_.begin(), sums_.end(), 0.) : 0;
}

void StreamedSmoother::ascend(std::span<const double> x, std::span<const double> coarse, std::span<const double> b,
                              std::span<double> out, Rings& rings) const {
  run({{x.data(), coarse.data(), &*level_->refinement}, b.data(), out.data(), nullptr, false}, rings);
}

}  // namespace batten
