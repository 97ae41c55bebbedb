// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/streaming_copy.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/errors.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace batten {
namespace {

constexpr std::ptrdiff_t tile = 2048;  // groups of the last level carried through all levels at once
constexpr std::ptrdiff_t smallest_streamed = std::ptrdiff_t{1}
                                             << 22;  // numbers: results of 32 MB leave the caches anyway
constexpr std::ptrdiff_t streamed_chunk = 128;       // groups, whole lines

struct Step {
  AxisRules rules;
  std::vector<double> weights;
  double half;  // shift of the mask's powers
};

std::vector<Step> steps_of(const Scheme& scheme, const SubdivisionOptions& options) {
  if (options.levels < 0 || options.data_level < 0)
    throw InvalidInput("subdivided: levels must not be negative, found " +
                       std::to_string(std::min(options.levels, options.data_level)));
  std::vector<Step> steps;
  for (int k = 1; k <= options.levels; ++k) {
    const auto mask = scheme.mask(options.data_level + k);
    require_ends("subdivided", mask, 0, options.ends);
    const auto rules = axis_rules(mask, 0, scheme.arity());
    steps.push_back({rules, group_weights(mask, rules).front(), 0.5 * mask.half()[0]});
  }
  return steps;
}

IndexRange range_after(const std::vector<Step>& steps, std::ptrdiff_t n, Ends ends) {
  IndexRange range{0, n};
  for (const Step& step : steps) {
    if (range.size() > 0) range = step.rules.refined(range, ends);
    if (range.size() > std::numeric_limits<int>::max())
      throw InvalidInput("subdivided: the result must have at most 2^31 points, found more after " +
                         std::to_string(steps.size()) + " levels of " + std::to_string(n));
  }
  return range;
}

/// Old points range.begin .. range.end - 1 of data with the given ends; 0 where there are none.
void gather_into(std::span<const double> points, Ends ends, const IndexRange& range, double* out) {
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  if (range.begin >= 0 && range.end <= n) {
    std::copy_n(points.data() + range.begin, range.size(), out);
    return;
  }
  for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
    const std::ptrdiff_t place = place_of(i, n, ends);
    *out++ = place >= 0 ? points[static_cast<std::size_t>(place)] : 0;
  }
}

/// One job: data, steps, and the result's indices.
class Subdivision {
public:
  Subdivision(std::span<const double> points, const std::vector<Step>& steps, Ends ends, const IndexRange& range)
      : points_(points), steps_(steps), ends_(ends), range_(range) {
    int widest = 0;
    for (const Step& step : steps) widest = std::max(widest, step.rules.width);
    buffer_size_ = tile + 2 * widest + 32;  // of each level's part of a tile: halved, and at most width + 2 more
  }

  std::size_t scratch_size() const { return static_cast<std::size_t>(2 * buffer_size_ + 3 * streamed_chunk); }

  /// Whether the result is written past the caches.
  bool streams() const { return range_.size() >= smallest_streamed; }

  /// Groups g.begin .. g.end - 1 of the last level, at most a tile, written to their place in out.
  void run(const IndexRange& groups, double* scratch, double* out) const {
    const std::size_t last = steps_.size() - 1;
    const double* in = level(last, steps_[last].rules.window_of(groups), scratch);
    write_groups(steps_[last], groups, in, scratch + 2 * buffer_size_, out);
  }

private:
  /// The points `range` of level k, computed within the scratch.
  const double* level(std::size_t k, const IndexRange& range, double* scratch) const {
    double* buffer = scratch + static_cast<std::ptrdiff_t>(k % 2) * buffer_size_;
    if (k == 0) {
      gather_into(points_, ends_, range, buffer);
      return buffer;
    }
    const Step& step = steps_[k - 1];
    const IndexRange groups = step.rules.groups_of(range);
    const double* in = level(k - 1, step.rules.window_of(groups), scratch);
    refine_groups_into(step.rules, step.weights.data(), in, groups.size(), buffer);
    return buffer + (range.begin - step.rules.arity * groups.begin);
  }

  /// Groups that lie in the result only in part go through a small copy.
  void write_groups(const Step& step, const IndexRange& groups, const double* in, double* buffer, double* out) const {
    const int arity = step.rules.arity;
    IndexRange whole = groups;
    if (arity * whole.begin < range_.begin) ++whole.begin;
    if (whole.end > whole.begin && arity * whole.end > range_.end) --whole.end;
    for (std::ptrdiff_t g : {groups.begin, groups.end - 1}) {
      if (g >= whole.begin && g < whole.end) continue;
      std::array<double, 3> part{};
      refine_groups_into(step.rules, step.weights.data(), in + (g - groups.begin), 1, part.data());
      for (int r = 0; r < arity; ++r)
        if (arity * g + r >= range_.begin && arity * g + r < range_.end)
          out[arity * g + r - range_.begin] = part[static_cast<std::size_t>(r)];
    }
    if (whole.size() <= 0) return;
    in += whole.begin - groups.begin;
    out += arity * whole.begin - range_.begin;
    if (streams())
      stream_groups(step, in, whole.size(), buffer, out);
    else
      refine_groups_into(step.rules, step.weights.data(), in, whole.size(), out);
  }

  /// By chunks that fit into the processor's window, so that it computes one while memory takes the one before.
  static void stream_groups(const Step& step, const double* in, std::ptrdiff_t groups, double* buffer, double* out) {
    const int arity = step.rules.arity;
    std::ptrdiff_t chunk = 0;  // the first chunk ends with a line
    while (chunk < cache_line && place_in_line(out + arity * chunk) != 0) ++chunk;
    if (chunk == 0 || chunk == cache_line) chunk = streamed_chunk;
    for (std::ptrdiff_t g = 0; g < groups; g += chunk, chunk = streamed_chunk) {
      const std::ptrdiff_t count = std::min(chunk, groups - g);
      refine_groups_into(step.rules, step.weights.data(), in + g, count, buffer);
      streaming_copy(buffer, arity * count, out + arity * g);
    }
  }

  std::span<const double> points_;
  const std::vector<Step>& steps_;
  Ends ends_;
  IndexRange range_;
  std::ptrdiff_t buffer_size_;
};

void run_all(std::span<const double> points, const std::vector<Step>& steps, Ends ends, const IndexRange& range,
             double* out) {
  if (steps.empty()) {
    std::copy(points.begin(), points.end(), out);
    return;
  }
  const Subdivision job(points, steps, ends, range);
  const AxisRules& rules = steps.back().rules;
  const IndexRange groups = rules.groups_of(range);
  const RowBlocks blocks(static_cast<int>(groups.size()), rules.arity);
  const std::size_t scratch_size = job.scratch_size();
  std::vector<double> scratch(scratch_size * static_cast<std::size_t>(omp_get_max_threads()));
  for_blocks(blocks, [&](int begin, int end) {
    double* own = scratch.data() + scratch_size * static_cast<std::size_t>(omp_get_thread_num());
    for (std::ptrdiff_t g = groups.begin + begin; g < groups.begin + end; g += tile)
      job.run({g, std::min(g + tile, groups.begin + end)}, own, out);
    if (job.streams()) end_streaming();
  });
}

void require_finite(std::span<const double> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i]))
      throw InvalidInput("subdivided: the data must be finite, found a number that is not at place " +
                         std::to_string(i));
}

void require_result(const IndexRange& range, std::size_t points, int levels) {
  if (points == 0) throw InvalidInput("subdivided: there must be points, found none");
  if (range.size() <= 0)
    throw InvalidInput("subdivided: an open polygon must determine points, found none from " + std::to_string(points) +
                       " points after " + std::to_string(levels) + " levels");
}

}  // namespace

IndexRange subdivided_range(const Scheme& scheme, std::ptrdiff_t n, const SubdivisionOptions& options) {
  return range_after(steps_of(scheme, options), n, options.ends);
}

void subdivide_into(const Scheme& scheme, std::span<const double> points, const SubdivisionOptions& options,
                    std::span<double> out) {
  const auto steps = steps_of(scheme, options);
  const auto range = range_after(steps, static_cast<std::ptrdiff_t>(points.size()), options.ends);
  require_result(range, points.size(), options.levels);
  require_finite(points);
  if (static_cast<std::ptrdiff_t>(out.size()) != range.size())
    throw InvalidInput("subdivide_into: the result must have room for " + std::to_string(range.size()) +
                       " numbers, found " + std::to_string(out.size()));
  run_all(points, steps, options.ends, range, out.data());
}

ControlPolygon subdivided(const Scheme& scheme, const ControlPolygon& polygon, const SubdivisionOptions& options) {
  const auto steps = steps_of(scheme, options);
  const auto n = polygon.points.rows();
  const auto range = range_after(steps, n, options.ends);
  require_result(range, static_cast<std::size_t>(n), options.levels);
  ControlPolygon result{.points = Eigen::MatrixXd(range.size(), polygon.points.cols())};
  for (Eigen::Index c = 0; c < polygon.points.cols(); ++c) {
    const std::span<const double> column(polygon.points.col(c).data(), static_cast<std::size_t>(n));
    require_finite(column);
    run_all(column, steps, options.ends, range, result.points.col(c).data());
  }
  double shift = 0, scale = 1;  // index i of the last level lies at (i + shift) scale
  for (const Step& step : steps) {
    shift = step.rules.arity * shift + step.half;
    scale /= step.rules.arity;
  }
  result.spacing = polygon.spacing * scale;
  result.start = polygon.start + result.spacing * (static_cast<double>(range.begin) + shift);
  return result;
}

}  // namespace batten
