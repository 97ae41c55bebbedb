// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/flows/streamline_points.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// A cubic on [0, h] by its values and slopes at the ends.
struct Cubic {
  double h, a, b, slope_a, slope_b;

  double operator()(double s) const {
    const double t = s / h, r = 1 - t;
    return r * r * ((1 + 2 * t) * a + t * h * slope_a) + t * t * ((1 + 2 * r) * b - r * h * slope_b);
  }
};

/// A line between two of its points, over the length from the first.
class Piece {
public:
  Piece(const FlowField& field, const Streamline& line, std::size_t k) : start_(line.length[k]) {
    const double h = line.length[k + 1] - start_;
    const auto cubic = [&](const std::vector<double>& values, double slope_a, double slope_b) {
      return Cubic{h, values[k], values[k + 1], slope_a, slope_b};
    };
    const auto tangent = [&](std::size_t i) {
      const auto [u, v] = field.velocity(line.x[i], line.y[i]);
      const double speed = std::hypot(u, v);
      const FlowGeometry& geometry = field.geometry();
      if (!(speed > 0)) return std::array{(line.x[k + 1] - line.x[k]) / h, (line.y[k + 1] - line.y[k]) / h};
      return std::array{u / speed / geometry.length_x(line.y[i]), v / speed / geometry.length_y()};
    };
    const double mean = (line.time[k + 1] - line.time[k]) / h;
    const auto slowness = [&](std::size_t i) { return std::min(1 / field.speed(line.x[i], line.y[i]), 3 * mean); };
    const auto a = tangent(k), b = tangent(k + 1);
    x_ = cubic(line.x, a[0], b[0]);
    y_ = cubic(line.y, a[1], b[1]);
    time_ = cubic(line.time, slowness(k), slowness(k + 1));
  }

  void add_to(Streamline& line, double length) const {
    const double s = length - start_;
    line.x.push_back(x_(s));
    line.y.push_back(y_(s));
    line.time.push_back(time_(s));
    line.length.push_back(length);
  }

  /// Where the time is reached, by bisection.
  double length_at(double time) const {
    double low = 0, high = time_.h;
    for (double middle = high / 2; low < middle && middle < high; middle = low + (high - low) / 2)
      (time_(middle) < time ? low : high) = middle;
    return start_ + low;
  }

private:
  double start_;
  Cubic x_{}, y_{}, time_{};
};

void copy_point(const Streamline& from, std::size_t k, Streamline& to) {
  to.x.push_back(from.x[k]);
  to.y.push_back(from.y[k]);
  to.time.push_back(from.time[k]);
  to.length.push_back(from.length[k]);
}

}  // namespace

Streamline with_even_points(const FlowField& field, const Streamline& line, const EvenSteps& steps) {
  if (!(steps.step > 0 && std::isfinite(steps.step)))
    throw InvalidInput("with_even_points: expected a positive step, found " + number_text(steps.step, 6));
  if (line.x.size() < 2) return line;
  const bool is_time = steps.parameter == StreamlineParameter::Time;
  const std::vector<double>& at = is_time ? line.time : line.length;
  const double step = std::max(steps.step, (at.back() - at.front()) / std::max(steps.most, 1));
  constexpr double rounding = 1e-9;  // of a step, so that no point falls onto an end
  Streamline result;
  result.upstream = line.upstream;
  result.downstream = line.downstream;
  copy_point(line, 0, result);
  std::size_t k = 0;
  const double last = std::ceil(at.back() / step - rounding);
  for (double m = std::floor(at.front() / step + rounding) + 1; m < last; ++m) {
    while (k + 2 < at.size() && at[k + 1] <= m * step) ++k;
    const Piece piece(field, line, k);
    piece.add_to(result, is_time ? piece.length_at(m * step) : m * step);
  }
  copy_point(line, line.x.size() - 1, result);
  return result;
}

double fine_step(const FlowField& field, StreamlineParameter parameter) {
  constexpr double steps = 200;
  const double length = field.geometry().longer_side(field.region()) / steps;
  if (parameter == StreamlineParameter::Length) return length;
  const double speed = largest_speed(field);
  return speed > 0 ? length / speed : length;
}

}  // namespace batten
