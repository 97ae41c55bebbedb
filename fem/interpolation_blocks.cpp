// SPDX-License-Identifier: MIT
#include <batten/fem/curve_lanes.h>
#include <batten/fem/interpolation_blocks.h>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones.

namespace batten {
namespace {

constexpr double third = 1. / 3;  // divisions take longer than all else

/// A group of blocks with what is around them. There is no curve where cells have width 0.
struct Window {
  explicit Window(int count) : steps(count) {
    const auto n = static_cast<std::size_t>(count);
    for (LaneSteps* s : {&widths, &points}) s->resize(n + 1);
    for (LaneSteps* s : {&inverse_widths, &pivots, &upper, &right}) s->resize(n);
  }

  int steps;
  LaneSteps widths;          // from that of the cell before the first knot
  LaneSteps points;          // up to that after the last knot; replaced by coefficients
  LaneSteps inverse_widths;  // of the cell behind a knot, 0 where there is none
  LaneSteps pivots, upper;   // 1 / D and D^-1 L^T of the equations, 0 where there is none
  LaneSteps right;           // D^-1 L^-1 of the right-hand side
};

[[gnu::always_inline]] inline void factor_lanes(Window& w) {
  const Lanes zero{};
  Lanes upper = zero, before = w.widths[0].value;
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.steps); ++k) {
    const Lanes after = w.widths[k + 1].value;
    const Lanes pivot = before == 0. ? zero : after == 0. ? zero : 1 / (2 * (before + after) - before * upper);
    upper = after * pivot;
    w.pivots[k].value = pivot;
    w.upper[k].value = upper;
    w.inverse_widths[k].value = after == 0. ? zero : 1 / after;
    before = after;
  }
}

[[gnu::always_inline]] inline void solve_lanes(Window& w) {
  const Lanes zero{};
  Lanes slope = zero, last = zero, value = w.points[0].value;
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.steps); ++k) {
    const Lanes next = w.points[k + 1].value, slope_next = (next - value) * w.inverse_widths[k].value;
    last = w.pivots[k].value * (6 * (slope_next - slope) - w.widths[k].value * last);
    w.right[k].value = last;
    slope = slope_next;
    value = next;
  }
  Lanes bend_next = zero;
  value = w.points[static_cast<std::size_t>(w.steps)].value;
  for (auto k = static_cast<std::size_t>(w.steps); k-- > 0;) {
    const Lanes before = w.widths[k].value, after = w.widths[k + 1].value, next = value;
    value = w.points[k].value;
    const Lanes bend = w.right[k].value - w.upper[k].value * bend_next;
    const Lanes tangent = (next - value) * w.inverse_widths[k].value - after * (2 * bend + bend_next) * (third / 2);
    const Lanes p = value + tangent * (after - before) * third - bend * before * after * (third / 2);
    w.points[k].value = before == 0. ? value : after == 0. ? value : p;
    bend_next = bend;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void factor(Window& w) {
  factor_lanes(w);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void solve(Window& w) {
  solve_lanes(w);
}

class Interpolation {
public:
  Interpolation(std::span<const double> knots, const Eigen::MatrixXd& points, bool closed)
      : knots_(knots),
        points_(points),
        closed_(closed),
        rows_(static_cast<int>(points.rows())),
        blocks_(rows_, 128, 512),
        overlap_(closed || blocks_.count() > 1 ? 60 : 0) {}

  Eigen::MatrixXd coefficients() const {
    Eigen::MatrixXd result(rows_, points_.cols());
#pragma omp parallel if (blocks_.groups() > 1)
    {
      Window w(blocks_.longest() + 2 * overlap_);
#pragma omp for schedule(static)
      for (int group = 0; group < blocks_.groups(); ++group) fill(w, group, result);
    }
    return result;
  }

private:
  /// Behind a row of a closed curve; 0 outside an open one.
  double width(int row) const {
    if (closed_) row = wrapped(row);
    if (row < 0 || row + 1 >= static_cast<int>(knots_.size())) return 0;
    const auto k = static_cast<std::size_t>(row);
    return knots_[k + 1] - knots_[k];
  }

  int wrapped(int row) const { return row >= 0 && row < rows_ ? row : (row % rows_ + rows_) % rows_; }

  void fill(Window& w, int group, Eigen::MatrixXd& result) const {
    int starts[lane_count], first[lane_count], before[lane_count], lengths[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      starts[l] = blocks_.begin(lane_count * group + l);
      lengths[l] = blocks_.length(lane_count * group + l);
      first[l] = starts[l] - overlap_;
      before[l] = first[l] - 1;
    }
    gather_lanes(before, w.steps + 1, w.widths, [&](int, int row, int n, double* out) {
      const bool is_inside = row >= 0 && row + n < static_cast<int>(knots_.size());
      const double* const knots = knots_.data() + row;
      for (int k = 0; k < n; ++k) out[k] = is_inside ? knots[k + 1] - knots[k] : width(row + k);
    });
    factor(w);
    for (Eigen::Index column = 0; column < points_.cols(); ++column) {
      const double* const values = points_.col(column).data();
      gather_lanes(first, w.steps + 1, w.points, [&](int, int row, int n, double* out) {
        if (row >= 0 && row + n <= rows_) {
          std::copy(values + row, values + row + n, out);
          return;
        }
        for (int k = 0; k < n; ++k) out[k] = values[closed_ ? wrapped(row + k) : std::clamp(row + k, 0, rows_ - 1)];
      });
      solve(w);
      scatter_lanes(starts, lengths, overlap_, w.points, result.col(column).data());
    }
  }

  std::span<const double> knots_;
  const Eigen::MatrixXd& points_;
  bool closed_;
  int rows_;
  LaneBlocks blocks_;
  int overlap_;  // 2^-60 is below rounding
};

}  // namespace

Eigen::MatrixXd interpolation_coefficients(std::span<const double> knots, const Eigen::MatrixXd& points, bool closed) {
  return Interpolation(knots, points, closed).coefficients();
}

}  // namespace batten
