// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/contradictions.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace batten {
namespace {

constexpr int digits = 6;

/// The values that the surface may take at an observation.
struct Span {
  double low, high;
};

class Contradictions {
public:
  Contradictions(const Observations& o, const FitOptions& options) : o_(o), options_(options) {}

  void check_tolerances() const {
    if (!o_.tolerance.empty() && o_.tolerance.size() != o_.size())
      throw InvalidInput("fit_surface: expected a tolerance for each of " + std::to_string(o_.size()) +
                         " observations, found " + std::to_string(o_.tolerance.size()));
    for (std::size_t i = 0; i < o_.tolerance.size(); ++i)
      if (!(o_.tolerance[i] > 0 && std::isfinite(o_.tolerance[i])))
        throw InvalidInput("fit_surface: expected positive tolerances, found " + number_text(o_.tolerance[i], digits) +
                           " at " + name_of(options_, i));
  }

  void check_bounds() const {
    if (options_.minimum && !std::isfinite(*options_.minimum))
      throw InvalidInput("fit_surface: expected a finite minimum");
    if (options_.maximum && !std::isfinite(*options_.maximum))
      throw InvalidInput("fit_surface: expected a finite maximum");
    if (options_.minimum && options_.maximum && *options_.minimum >= *options_.maximum)
      throw InvalidInput("fit_surface: expected a minimum below the maximum, found " +
                         number_text(*options_.minimum, digits) + " and " + number_text(*options_.maximum, digits));
  }

  /// Tolerances are strict limits, and so is interpolation.
  void check_value(std::size_t i) const {
    const Span span = span_of(i);
    const auto refuse = [&](const char* end, double bound) {
      throw InvalidInput("fit_surface: expected values that can be kept with the " + std::string(end) + " " +
                         number_text(bound, digits) + ", found " + number_text(o_.value[i], digits) + " in " +
                         name_of(options_, i) + (is_within() ? ", farther from it than the tolerance" : ""));
    };
    if (options_.minimum && span.high < *options_.minimum) refuse("minimum", *options_.minimum);
    if (options_.maximum && span.low > *options_.maximum) refuse("maximum", *options_.maximum);
  }

  /// At one place: the span with the lowest top and the one with the highest bottom.
  void check_place(std::size_t i) {
    const auto [at, is_new] = extremes_.try_emplace({o_.x[i], o_.y[i]}, i, i);
    auto& [low, high] = at->second;
    if (span_of(i).high < span_of(low).high) low = i;
    if (span_of(i).low > span_of(high).low) high = i;
    if (span_of(high).low <= span_of(low).high) return;
    throw InvalidInput("fit_surface: expected values at one place within their tolerances of each other, found " +
                       number_text(o_.value[low], digits) + " (" + name_of(options_, low) + ") and " +
                       number_text(o_.value[high], digits) + " (" + name_of(options_, high) + ") at (" +
                       number_text(o_.x[i], digits) + ", " + number_text(o_.y[i], digits) + ")");
  }

  bool is_within() const { return options_.smoothing.kind == Smoothing::Kind::Tolerance; }

private:
  Span span_of(std::size_t i) const {
    const double t = !is_within() ? 0 : options_.smoothing.value * (o_.tolerance.empty() ? 1 : o_.tolerance[i]);
    return {o_.value[i] - t, o_.value[i] + t};
  }

  const Observations& o_;
  const FitOptions& options_;
  std::map<std::pair<double, double>, std::pair<std::size_t, std::size_t>> extremes_;
};

}  // namespace

std::string name_of(const FitOptions& options, std::size_t observation) {
  return options.name_of ? options.name_of(observation) : "observation " + std::to_string(observation + 1);
}

void check_contradictions(const Observations& o, std::span<const std::size_t> used, const FitOptions& options) {
  Contradictions contradictions(o, options);
  const bool is_within = contradictions.is_within();
  const bool is_met = options.smoothing.kind == Smoothing::Kind::None ||
                      (options.smoothing.kind == Smoothing::Kind::Fixed && options.smoothing.value == 0);
  if (is_within) contradictions.check_tolerances();
  contradictions.check_bounds();
  for (const std::size_t i : used) {
    if (is_within || is_met) contradictions.check_value(i);
    if (is_within) contradictions.check_place(i);
  }
}

}  // namespace batten
