// SPDX-License-Identifier: MIT
#include <batten/bases/torus_zeros.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace batten {
namespace {

using Angles = std::array<double, 2>;

constexpr double pi = std::numbers::pi;
constexpr double zero_size = 1e-12;
constexpr std::size_t most_zeros = 64;

/// A function on the points 2π (i, j) / n.
class GridFunction {
public:
  GridFunction(std::vector<double> values, int n) : values_(std::move(values)), n_(n) {}
  double at(int i, int j) const { return values_[static_cast<std::size_t>(((i + n_) % n_) * n_ + (j + n_) % n_)]; }
  /// No higher than the eight neighbours, and so low that a zero may be next to it.
  bool is_valley(int i, int j) const {
    for (int k = 0; k < 9; ++k)
      if (at(i, j) > at(i + k / 3 - 1, j + k % 3 - 1)) return false;
    return at(i, j) < 0.3;
  }

private:
  std::vector<double> values_;
  int n_;
};

/// |b| on the grid, in double: enough to tell valleys.
GridFunction samples(const TorusQuotient& quotient, int n) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k) {
    const auto line = quotient.denominators_on_line(2 * pi * k / n, n);
    values.insert(values.end(), line.begin(), line.end());
  }
  return {std::move(values), n};
}

std::vector<Angles> valleys(const GridFunction& values, int n) {
  std::vector<Angles> found;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (values.is_valley(i, j)) found.push_back({2 * pi * i / n, 2 * pi * j / n});
  return found;
}

/// The lowest of 5 x 5 points around the best one, on ever finer grids.
Angles descended(const TorusQuotient& quotient, Angles best, double step) {
  double least = quotient.relative_denominator(best[0], best[1]);
  while (step > 1e-16 && least > 0) {
    const Angles centre = best;
    for (int k = 0; k < 25; ++k) {
      const Angles next = {centre[0] + (k / 5 - 2) * step, centre[1] + (k % 5 - 2) * step};
      const double value = quotient.relative_denominator(next[0], next[1]);
      if (value >= least) continue;
      least = value;
      best = next;
    }
    if (best == centre) step /= 2;
  }
  return best;
}

double reduced(double angle) {
  const double turned = std::remainder(angle, 2 * pi);
  return turned < 0 ? turned + 2 * pi : turned;
}

/// The multiple of π/12 next to it, where the mask is as small there.
Angles snapped(const TorusQuotient& quotient, const Angles& angles) {
  constexpr double unit = pi / 12;
  const Angles nice = {unit * std::round(angles[0] / unit), unit * std::round(angles[1] / unit)};
  const bool is_near = std::hypot(nice[0] - angles[0], nice[1] - angles[1]) < 1e-3;
  return is_near && quotient.relative_denominator(nice[0], nice[1]) < 1e-15 ? nice : angles;
}

bool is_same(const Angles& a, const Angles& b) {
  return std::hypot(std::remainder(a[0] - b[0], 2 * pi), std::remainder(a[1] - b[1], 2 * pi)) < 1e-4;
}

double largest_on_circle(const TorusQuotient& quotient, const Angles& centre, double radius) {
  constexpr int directions = 60;
  double largest = 0;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * pi * (k + 0.3) / directions;
    largest = std::max(largest,
                       std::abs(quotient(centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle))));
  }
  return largest;
}

std::string angle_text(double angle) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g π", angle / pi);
  return text;
}

}  // namespace

std::vector<Angles> denominator_zeros(const TorusQuotient& quotient, int n) {
  std::vector<Angles> zeros;
  for (const Angles& start : valleys(samples(quotient, n), n)) {
    const Angles lowest = snapped(quotient, descended(quotient, start, pi / n));
    if (quotient.relative_denominator(lowest[0], lowest[1]) > zero_size) continue;
    const Angles zero = {reduced(lowest[0]), reduced(lowest[1])};
    if (std::any_of(zeros.begin(), zeros.end(), [&](const Angles& other) { return is_same(zero, other); })) continue;
    zeros.push_back(zero);
    if (zeros.size() > most_zeros)
      throw InvalidInput("denominator_zeros: the denominator must have isolated zeros on the torus, found more than " +
                         std::to_string(most_zeros) + ", one at angles (" + angle_text(zero[0]) + ", " +
                         angle_text(zero[1]) + "): divide common factors out first");
  }
  return zeros;
}

void require_bounded(const TorusQuotient& quotient, const std::vector<Angles>& zeros) {
  for (const Angles& zero : zeros)
    if (largest_on_circle(quotient, zero, 0x1p-16) > 4 * largest_on_circle(quotient, zero, 0x1p-6))
      throw InvalidInput(
          "require_bounded: the quotient must be bounded on the torus, found that the denominator "
          "vanishes at (x, y) = (e^(iα), e^(iβ)), (α, β) = (" +
          angle_text(zero[0]) + ", " + angle_text(zero[1]) + "), and the numerator less or not at all");
}

}  // namespace batten
