// SPDX-License-Identifier: MIT
#include <batten/io/axis_ticks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace batten {
namespace {

constexpr double slack = 1e-9;  // of a step: a multiple at the very end is in

double first_multiple(double low, double step) { return std::ceil(low / step - slack); }
double last_multiple(double high, double step) { return std::floor(high / step + slack); }

// The smallest step of 1, 2 or 5 times a power of ten with at most `most` multiples in [low, high].
double nice_step(double low, double high, int most) {
  const double power = std::pow(10, std::floor(std::log10((high - low) / most)));
  for (const double factor : {1, 2, 5, 10, 20, 50}) {
    const double step = factor * power;
    if (last_multiple(high, step) - first_multiple(low, step) + 1 <= most) return step;
  }
  return high - low;
}

}  // namespace

std::vector<Tick> nice_ticks(double low, double high, int most) {
  if (!(low < high)) return {};
  const double step = nice_step(low, high, most);
  const double last = last_multiple(high, step);
  std::vector<Tick> ticks;
  for (double k = first_multiple(low, step); k <= last; ++k) ticks.push_back({k * step, number_label(k * step, step)});
  return ticks;
}

std::string number_label(double value, double step) {
  constexpr double largest_fixed = 1e7, smallest_fixed_step = 1e-5;
  std::array<char, 64> text;
  const double magnitude = std::max(std::abs(value), step);
  if (magnitude < largest_fixed && step >= smallest_fixed_step) {
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  } else {
    const int digits =
        static_cast<int>(std::floor(std::log10(magnitude) + 1e-9) - std::floor(std::log10(step) + 1e-9)) + 1;
    std::snprintf(text.data(), text.size(), "%.*g", std::clamp(digits, 1, 17), value);
  }
  const std::string label = text.data();
  const bool is_zero = label.find_first_not_of("-0.") == std::string::npos;  // "-0.0"
  return is_zero && label[0] == '-' ? label.substr(1) : label;
}

}  // namespace batten
