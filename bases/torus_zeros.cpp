// SPDX-License-Identifier: MIT
#include <batten/bases/torus_zeros.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace batten {
namespace {

using Angles = std::array<double, 2>;

constexpr double pi = std::numbers::pi;
constexpr double zero_size = 1e-12;
constexpr std::size_t most_zeros = 64;

/// |b| on the grid, in double: enough to tell valleys.
std::vector<double> samples(const TorusQuotient& quotient, int n) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k)
    for (double value : quotient.denominators_on_line(2 * pi * k / n, n)) values.push_back(value);
  return values;
}

/// Grid points no higher than their eight neighbours, and so low that a zero may be next to them.
std::vector<Angles> valleys(const std::vector<double>& values, int n) {
  std::vector<Angles> found;
  const auto at = [&](int i, int j) { return values[static_cast<std::size_t>(((i + n) % n) * n + (j + n) % n)]; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      bool lowest = at(i, j) < 0.3;
      for (int di = -1; di <= 1 && lowest; ++di)
        for (int dj = -1; dj <= 1; ++dj) lowest = lowest && at(i, j) <= at(i + di, j + dj);
      if (lowest) found.push_back({2 * pi * i / n, 2 * pi * j / n});
    }
  return found;
}

/// The lowest of 5 x 5 points around the best one, on ever finer grids.
Angles descended(const TorusQuotient& quotient, Angles best, double step) {
  double least = quotient.relative_denominator(best[0], best[1]);
  while (step > 1e-16 && least > 0) {
    const Angles centre = best;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) {
        const Angles next = {centre[0] + i * step, centre[1] + j * step};
        const double value = quotient.relative_denominator(next[0], next[1]);
        if (value < least) {
          least = value;
          best = next;
        }
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
