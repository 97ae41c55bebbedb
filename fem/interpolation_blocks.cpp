// SPDX-License-Identifier: MIT
#include <batten/fem/curve_checks.h>
#include <batten/fem/curve_lanes.h>
#include <batten/fem/interpolation_blocks.h>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones.

namespace batten {
namespace {

constexpr double third = 1. / 3;  // divisions take longer than all else

/// A group of blocks with what is around them.
struct Window {
  explicit Window(int count) : steps(count) {
    const auto n = static_cast<std::size_t>(count);
    for (LaneSteps* s : {&widths, &points}) s->resize(n + 1);
    for (LaneSteps* s : {&inverse_widths, &pivots, &slopes, &right}) s->resize(n);
  }

  int steps;
  LaneSteps widths;          // from that of the cell before the first knot
  LaneSteps points;          // up to that after the last knot; replaced by coefficients
  LaneSteps inverse_widths;  // of the cell behind a knot
  LaneSteps pivots;          // 1 / D of the equations
  LaneSteps slopes;          // of the chord behind a knot
  LaneSteps right;           // D^-1 L^-1 of the right-hand side
};

/// With `factors`, pivots and inverse widths as well: they are the same for all components.
template <bool factors>
[[gnu::always_inline]] inline void sweep_forwards(Window& w) {
  const Lanes zero{};
  Lanes upper = zero, before = w.widths[0].value;
  Lanes slope = zero, last = zero, value = w.points[0].value;
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.steps); ++k) {
    const Lanes after = w.widths[k + 1].value;
    if constexpr (factors) {
      const Lanes pivot = 1 / (2 * (before + after) - before * upper);
      upper = after * pivot;
      w.pivots[k].value = pivot;
      w.inverse_widths[k].value = 1 / after;
    }
    const Lanes next = w.points[k + 1].value, slope_next = (next - value) * w.inverse_widths[k].value;
    last = w.pivots[k].value * (6 * (slope_next - slope) - before * last);
    w.right[k].value = last;
    w.slopes[k].value = slope_next;
    slope = slope_next;
    value = next;
    before = after;
  }
}

/// Coefficients in place of the points.
[[gnu::always_inline]] inline void sweep_back(Window& w) {
  Lanes bend_next{}, after = w.widths[static_cast<std::size_t>(w.steps)].value;
  for (auto k = static_cast<std::size_t>(w.steps); k-- > 0;) {
    const Lanes before = w.widths[k].value, value = w.points[k].value;
    const Lanes bend = w.right[k].value - after * w.pivots[k].value * bend_next;
    const Lanes tangent = w.slopes[k].value - after * (2 * bend + bend_next) * (third / 2);
    w.points[k].value = value + tangent * (after - before) * third - bend * before * after * (third / 2);
    bend_next = bend;
    after = before;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void factor_and_solve(Window& w) {
  sweep_forwards<true>(w);
  sweep_back(w);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void solve(Window& w) {
  sweep_forwards<false>(w);
  sweep_back(w);
}

class Interpolation {
public:
  Interpolation(std::span<const double> knots, const Eigen::MatrixXd& points, bool closed)
      : knots_(knots),
        points_(points),
        closed_(closed),
        rows_(static_cast<int>(points.rows())),
        blocks_(rows_, 128, 1000),
        overlap_(closed || blocks_.count() > 1 ? 60 : 0),
        outside_(std::min(1e30 * (knots.back() - knots.front()), 1e300)) {}

  FoundCoefficients coefficients() const {
    FoundCoefficients found = {Eigen::MatrixXd(rows_, points_.cols()), true};
    bool are_sound = true;
#pragma omp parallel if (blocks_.groups() > 1) reduction(&& : are_sound)
    {
      Window w(blocks_.longest() + 2 * overlap_);
#pragma omp for schedule(static)
      for (int group = 0; group < blocks_.groups(); ++group)
        are_sound = fill(w, group, found.coefficients) && are_sound;
    }
    found.are_sound = are_sound;
    return found;
  }

private:
  /// Behind a row.
  double width(int row) const {
    if (closed_) row = wrapped(row);
    if (row < 0 || row + 1 >= static_cast<int>(knots_.size())) return outside_;
    const auto k = static_cast<std::size_t>(row);
    return knots_[k + 1] - knots_[k];
  }

  int wrapped(int row) const { return row >= 0 && row < rows_ ? row : (row % rows_ + rows_) % rows_; }

  /// Whether knots and coefficients are what they must be.
  bool fill(Window& w, int group, Eigen::MatrixXd& result) const {
    int starts[lane_count], first[lane_count], before[lane_count], lengths[lane_count], ends[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      starts[l] = blocks_.begin(lane_count * group + l);
      lengths[l] = blocks_.length(lane_count * group + l);
      first[l] = starts[l] - overlap_;
      before[l] = first[l] - 1;
      ends[l] = static_cast<int>(knots_.size()) - 1;
    }
    gather_widths(knots_.data(), 1, before, ends, w.steps + 1, w.widths.data(),
                  [&](int, int row) { return width(row); });
    for (Eigen::Index column = 0; column < points_.cols(); ++column) {
      const double* const values = points_.col(column).data();
      gather_lanes(first, w.steps + 1, w.points.data(), [&](int, int row, int n, double* buffer) -> const double* {
        if (row >= 0 && row + n <= rows_) return values + row;
        for (int k = 0; k < n; ++k) buffer[k] = values[closed_ ? wrapped(row + k) : std::clamp(row + k, 0, rows_ - 1)];
        return buffer;
      });
      column == 0 ? factor_and_solve(w) : solve(w);
      scatter_lanes(starts, lengths, overlap_, w.points, result.col(column).data());
    }
    return is_sound(blocks_.begin(lane_count * group), blocks_.begin(lane_count * (group + 1)), result);
  }

  bool is_sound(int begin, int end, Eigen::MatrixXd& result) const {
    bool sound = increases(knots_.data() + begin, std::min(end, static_cast<int>(knots_.size()) - 1) - begin);
    for (Eigen::Index column = 0; column < points_.cols(); ++column) {
      if (!closed_ && begin == 0) result(0, column) = points_(0, column);
      if (!closed_ && end == rows_) result(end - 1, column) = points_(end - 1, column);
      sound = sound && is_finite(result.col(column).data() + begin, end - begin);
    }
    return sound;
  }

  std::span<const double> knots_;
  const Eigen::MatrixXd& points_;
  bool closed_;
  int rows_;
  LaneBlocks blocks_;
  int overlap_;     // 2^-60 is below rounding
  double outside_;  // width of the cells beyond the ends of an open curve, where all bends less than rounding
};

}  // namespace

FoundCoefficients interpolation_coefficients(std::span<const double> knots, const Eigen::MatrixXd& points,
                                             bool closed) {
  return Interpolation(knots, points, closed).coefficients();
}

}  // namespace batten
