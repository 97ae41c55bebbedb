// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/flows/streamlines.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>

namespace batten {

/// A point of a line, at a time.
struct StreamlineTracer::State {
  double x = 0, y = 0, time = 0, length = 0;

  State operator+(const State& b) const { return {x + b.x, y + b.y, time + b.time, length + b.length}; }
  State operator*(double factor) const { return {factor * x, factor * y, factor * time, factor * length}; }
};

struct StreamlineTracer::Step {
  State end;
  double error = 0;  // over the tolerance
};

namespace {

// [Dormand & Prince 1980, RK5(4)7M]: the stages, the last of them the solution of order 5, and its weights less those
// of order 4.
constexpr std::size_t stages = 7;
constexpr double stage_weights[stages][stages - 1] = {
    {},
    {1 / 5.},
    {3 / 40., 9 / 40.},
    {44 / 45., -56 / 15., 32 / 9.},
    {19372 / 6561., -25360 / 2187., 64448 / 6561., -212 / 729.},
    {9017 / 3168., -355 / 33., 46732 / 5247., 49 / 176., -5103 / 18656.},
    {35 / 384., 0, 500 / 1113., 125 / 192., -2187 / 6784., 11 / 84.}};
constexpr std::array<double, stages> error_weights = {71 / 57600.,      0,         -71 / 16695., 71 / 1920.,
                                                      -17253 / 339200., 22 / 525., -1 / 40.};

/// Length of a step (dx, dy) near y.
double length_of(const FlowGeometry& geometry, double dx, double dy, double y) {
  return std::hypot(dx * geometry.length_x(y), dy * geometry.length_y());
}

// Points of the line at least so far from each other along it, and its last.
std::vector<std::size_t> spread_points(const FlowGeometry& geometry, const Streamline& line, double distance) {
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i < line.x.size(); ++i) {
    const std::size_t k = kept.back();
    const double gone = length_of(geometry, line.x[i] - line.x[k], line.y[i] - line.y[k], line.y[i]);
    if (i + 1 == line.x.size() || gone >= distance) kept.push_back(i);
  }
  return kept;
}

}  // namespace

double largest_speed(const FlowField& field) {
  double largest = 0;
  for (const PointArray& array : field.samples().arrays) {
    if (array.name != "speed") continue;
    for (const double v : array.values) largest = std::max(largest, v);
  }
  return largest;
}

/// One way along a line, from its seed.
class StreamlineTracer::Walk {
public:
  Walk(const StreamlineTracer& tracer, const State& seed, double direction)
      : tracer_(tracer), seed_(seed), direction_(direction), start_(tracer.slope(seed, direction)), points_{seed} {}

  /// Walks to the end.
  StreamlineEnd run() {
    const double smallest = 1e-3 * tracer_.options_.tolerance * tracer_.side_;
    const double most = tracer_.options_.longest * tracer_.side_;
    double length = 0.1 * tracer_.longest_step_, travelled = 0;
    while (travelled < most) {
      if (at_rest(points_.back())) return StreamlineEnd::AtRest;
      length = std::min({length, tracer_.longest_step_, most - travelled});
      const Step step = tracer_.step(points_.back(), length, direction_);
      const double growth = std::clamp(0.9 * std::pow(std::max(step.error, 1e-10), -0.2), 0.2, 5.);
      if (step.error > 1) {
        length *= growth;
        // Where the field turns round at once: an exact hit of a point at rest.
        if (length < smallest) return StreamlineEnd::AtRest;
        continue;
      }
      if (leaves(step.end)) return end_on_side(length);
      if (returns(step.end) && close(length)) return StreamlineEnd::Closed;
      points_.push_back(step.end);
      travelled += length;
      length *= growth;
    }
    return StreamlineEnd::Length;
  }

  const std::vector<State>& points() const { return points_; }

private:
  bool at_rest(const State& p) const {
    return !(tracer_.field_.speed(p.x, p.y) > tracer_.options_.slowest * tracer_.speed_);
  }

  bool leaves(const State& p) const { return !tracer_.field_.region().contains(p.x, p.y); }

  // How far beyond the line across the seed.
  double beyond(const State& p) const { return (p.x - seed_.x) * start_.x + (p.y - seed_.y) * start_.y; }

  bool returns(const State& p) const {
    const double near = 2 * tracer_.longest_step_;
    return beyond(points_.back()) < 0 && beyond(p) >= 0 && from_seed(p) < near;
  }

  double from_seed(const State& p) const {
    return length_of(tracer_.field_.geometry(), p.x - seed_.x, p.y - seed_.y, seed_.y);
  }

  // The longest step from the last point, up to `length`, whose end does not fulfil the test, and that end.
  template <std::predicate<double, double> Test>
  State end_before(double length, const Test& test) const {
    double low = 0, high = length;
    State end = points_.back();
    for (double middle = high / 2; low < middle && middle < high; middle = low + (high - low) / 2) {
      const State p = tracer_.step(points_.back(), middle, direction_).end;
      if (test(p.x, p.y)) {
        high = middle;
      } else {
        low = middle;
        end = p;
      }
    }
    return end;
  }

  // Ends on the side that a step of this length crosses.
  StreamlineEnd end_on_side(double length) {
    const Rectangle& region = tracer_.field_.region();
    State end = end_before(length, [&](double x, double y) { return !region.contains(x, y); });
    const double rounding = 1e-12 * std::max(region.x.length(), region.y.length());
    const auto snap = [&](const Interval& interval, double& v) {
      for (const double side : {interval.lower(), interval.upper()})
        if (std::abs(v - side) < rounding) v = side;
    };
    snap(region.x, end.x);
    snap(region.y, end.y);
    const State& last = points_.back();
    if (points_.size() > 1 && std::hypot(end.x - last.x, end.y - last.y) < rounding) points_.pop_back();
    if (end.x != points_.back().x || end.y != points_.back().y) points_.push_back(end);
    return StreamlineEnd::Side;
  }

  // Whether a step up to this length comes back to the seed; then the line ends there.
  bool close(double length) {
    const State end = end_before(length, [&](double x, double y) { return beyond({x, y, 0, 0}) >= 0; });
    const double allowed = 1e4 * tracer_.options_.tolerance * tracer_.side_;
    if (from_seed(end) > allowed) return false;
    points_.push_back({seed_.x, seed_.y, end.time, end.length});
    return true;
  }

  const StreamlineTracer& tracer_;
  State seed_;
  double direction_;
  State start_;
  std::vector<State> points_;
};

StreamlineTracer::StreamlineTracer(const FlowField& field, const StreamlineOptions& options)
    : field_(field),
      options_(options),
      side_(field.geometry().longer_side(field.region())),
      speed_(largest_speed(field)) {
  for (const double number : {options.tolerance, options.longest, options.slowest}) {
    if (!(number > 0 && std::isfinite(number)))
      throw InvalidInput("StreamlineTracer: expected positive options, found " + number_text(number, 6));
  }
  constexpr double fewest_steps = 200;  // along the longer side, for the eye
  const auto &ix = field.region().x, &iy = field.region().y;
  const FlowGeometry& geometry = field.geometry();
  const double unit_y = geometry.length_y(), unit_x = unit_y / geometry.aspect(field.region());
  longest_step_ = std::min({unit_x * ix.finest_cell_length(), unit_y * iy.finest_cell_length(), side_ / fewest_steps});
}

/// Outside the region the field is that of the nearest point.
StreamlineTracer::State StreamlineTracer::slope(const State& at, double direction) const {
  const auto &ix = field_.region().x, &iy = field_.region().y;
  const double x = std::clamp(at.x, ix.lower(), ix.upper()), y = std::clamp(at.y, iy.lower(), iy.upper());
  const auto [u, v] = field_.velocity(x, y);
  const double speed = std::hypot(u, v);
  if (speed == 0) return {};
  const FlowGeometry& geometry = field_.geometry();
  return State{u / geometry.length_x(y), v / geometry.length_y(), 1, speed} * (direction / speed);
}

StreamlineTracer::Step StreamlineTracer::step(const State& from, double length, double direction) const {
  std::array<State, stages> slopes;
  State end, error;
  for (std::size_t k = 0; k < stages; ++k) {
    end = from;
    for (std::size_t j = 0; j < k; ++j) end = end + slopes[j] * (length * stage_weights[k][j]);
    slopes[k] = slope(end, direction);
    error = error + slopes[k] * (length * error_weights[k]);
  }
  // Times grow without bound towards points at rest: their errors are measured against them.
  const double time_unit = std::max(side_ / speed_, std::abs(end.time));
  const double found =
      std::max(length_of(field_.geometry(), error.x, error.y, from.y) / side_, std::abs(error.time) / time_unit);
  return {end, found / options_.tolerance};
}

Streamline StreamlineTracer::trace(double x, double y) const {
  const auto &ix = field_.region().x, &iy = field_.region().y;
  if (!field_.region().contains(x, y))
    throw InvalidInput("StreamlineTracer: the point (" + number_text(x, 10) + ", " + number_text(y, 10) +
                       ") lies outside the region (x from " + number_text(ix.lower(), 6) + " to " +
                       number_text(ix.upper(), 6) + ", y from " + number_text(iy.lower(), 6) + " to " +
                       number_text(iy.upper(), 6) + ")");
  Streamline line;
  const auto add = [&line](const State& p) {
    line.x.push_back(p.x);
    line.y.push_back(p.y);
    line.time.push_back(p.time);
    line.length.push_back(p.length);
  };
  Walk down(*this, {x, y, 0, 0}, 1);
  line.upstream = line.downstream = down.run();
  if (!line.closed()) {
    Walk up(*this, {x, y, 0, 0}, -1);
    line.upstream = up.run();
    for (std::size_t k = up.points().size(); k-- > 1;) add(up.points()[k]);
  }
  for (const State& p : down.points()) add(p);
  return line;
}

std::vector<Streamline> StreamlineTracer::evenly_spaced(int count) const {
  constexpr int across = 64;
  const Rectangle& region = field_.region();
  const FlowGeometry& geometry = field_.geometry();
  struct Candidate {
    double x, y, distance;
  };
  std::vector<Candidate> candidates = {{region.x.lower() + region.x.length() / 2,
                                        region.y.lower() + region.y.length() / 2,
                                        std::numeric_limits<double>::infinity()}};
  for (int k = 0; k < across * across; ++k)
    candidates.push_back({region.x.lower() + region.x.length() * (k % across + 0.5) / across,
                          region.y.lower() + region.y.length() * (k / across + 0.5) / across,
                          std::numeric_limits<double>::infinity()});
  std::vector<Streamline> lines;
  while (static_cast<int>(lines.size()) < count) {
    const auto seed = std::max_element(candidates.begin(), candidates.end(),
                                       [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    if (seed->distance == 0) break;
    Streamline line = trace(seed->x, seed->y);
    seed->distance = 0;
    for (const std::size_t i : spread_points(geometry, line, side_ / (2 * across)))
      for (Candidate& c : candidates)
        c.distance = std::min(c.distance, length_of(geometry, line.x[i] - c.x, line.y[i] - c.y, c.y));
    if (line.x.size() > 1) lines.push_back(std::move(line));
  }
  return lines;
}

CurveSamples samples_of(const FlowField& field, const Streamline& line) {
  CurveSamples curve;
  curve.x = line.x;
  curve.y = line.y;
  curve.z.assign(line.x.size(), 0.);
  curve.arrays = {{"speed", 1, {}}, {"time", 1, line.time}, {"length", 1, line.length}, {"vorticity", 1, {}}};
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    curve.arrays[0].values.push_back(field.speed(line.x[i], line.y[i]));
    curve.arrays[3].values.push_back(field.vorticity(line.x[i], line.y[i]));
  }
  return curve;
}

}  // namespace batten
