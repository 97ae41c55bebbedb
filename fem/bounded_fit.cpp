// SPDX-License-Identifier: MIT
#include <batten/bases/blossom.h>
#include <batten/domains/errors.h>
#include <batten/fem/bounded_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace batten {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double spacing = 1. / 8;  // of the finer grid's knots, in cells

/// The functions of the finer grid along one direction: Greville abscissae and what coefficients of the grid give
/// theirs.
struct Finer {
  Finer(const SplineBasis& basis) {
    const Interval& interval = basis.interval();
    for (const double t : refined_greville(basis, spacing)) {
      coordinate.push_back(interval.lower() + interval.length() * (t / interval.finest_cells()));
      local.push_back(refined_coefficient(basis, t, spacing));
    }
  }
  std::vector<double> coordinate;
  std::vector<SplineBasis::Local> local;
};

struct FineCoefficient {
  std::size_t index;  // among all, x fastest
  double value;
};

class BoundedFit {
public:
  BoundedFit(const FitData& data, const Rectangle& region, const FitOptions& options, const BoundedFitTask& task)
      : data_(data),
        wanted_(data.value),
        region_(region),
        options_(options),
        task_(task),
        basis_x_(region.x, options.degree),
        basis_y_(basis_x_.on(region.y, {})),
        x_(basis_x_),
        y_(basis_y_),
        is_row_(x_.local.size() * y_.local.size()) {
    if (data_.kind.empty()) data_.kind.assign(data_.size(), Measured::Value);
    data_.spacing = spacing;
    fit_ = task.start;
  }

  ConstrainedFit solved() {
    constexpr int most_rounds = 12;
    constexpr double first_rise = 1000;  // data that lie at a bound can only be met with far more bending
    bool is_within = false;
    for (int round = 0; round < most_rounds; ++round) {
      is_within = !add_rows();
      if (is_within && (round == 0 || !move_data())) break;
      solve(round == 0 ? first_rise : 1);
      is_within = false;
    }
    if (!is_within && add_rows())
      throw SolverError("fit_between: the bounds are not kept after " + std::to_string(most_rounds) + " rounds");
    fit_.iterations = fit_.account.cycles;
    return std::move(fit_);
  }

private:
  double lower(std::size_t index) const { return bound(options_.minimum.value_or(-infinity), index); }
  double upper(std::size_t index) const { return bound(options_.maximum.value_or(infinity), index); }
  double bound(double value, std::size_t index) const {
    const auto [i, j] = std::pair(index % x_.local.size(), index / x_.local.size());
    return (value - data_.null_element(x_.coordinate[i], y_.coordinate[j])) / data_.scale;
  }
  /// How far a value is inside of the nearer bound.
  double room(const FineCoefficient& c) const { return std::min(c.value - lower(c.index), upper(c.index) - c.value); }

  /// Those of the finer grid that have less room than `margin`.
  std::vector<FineCoefficient> near_bounds(double margin) const {
    std::vector<std::vector<FineCoefficient>> rows(y_.local.size());
    const auto count = static_cast<std::ptrdiff_t>(rows.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t j = 0; j < count; ++j) rows[static_cast<std::size_t>(j)] = row_near_bounds(j, margin);
    std::vector<FineCoefficient> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
  }

  std::vector<FineCoefficient> row_near_bounds(std::ptrdiff_t j, double margin) const {
    const auto& across = y_.local[static_cast<std::size_t>(j)];
    const auto columns = static_cast<std::size_t>(basis_x_.size()), degree = static_cast<std::size_t>(options_.degree);
    std::vector<double> line(columns);
    for (std::size_t b = 0; b <= degree; ++b)
      for (std::size_t i = 0; i < columns; ++i)
        line[i] += across.values[b] * fit_.coefficients[(static_cast<std::size_t>(across.first) + b) * columns + i];
    std::vector<FineCoefficient> result;
    for (std::size_t i = 0; i < x_.local.size(); ++i) {
      FineCoefficient one{static_cast<std::size_t>(j) * x_.local.size() + i, 0};
      for (std::size_t a = 0; a <= degree; ++a)
        one.value += x_.local[i].values[a] * line[static_cast<std::size_t>(x_.local[i].first) + a];
      if (room(one) < margin) result.push_back(one);
    }
    return result;
  }

  /// Adds rows for coefficients beyond a bound, and for those that are close to it by comparison. Returns whether there
  /// are any beyond.
  bool add_rows() {
    constexpr double least_margin = 0.01, share_of_worst = 0.25;  // of the range of the data
    double worst = 0;
    bool is_outside = false;
    for (const auto& c : near_bounds(0)) {
      worst = std::max(worst, -room(c));
      is_outside = is_outside || !is_row_[c.index] || -room(c) > rounding;
    }
    if (!is_outside) return false;
    for (const auto& c : near_bounds(std::max(least_margin, share_of_worst * worst))) {
      if (is_row_[c.index]) continue;
      is_row_[c.index] = true;
      rows_.push_back(c.index);
      data_.x.push_back(x_.coordinate[c.index % x_.local.size()]);
      data_.y.push_back(y_.coordinate[c.index / x_.local.size()]);
      data_.value.push_back(0);
      data_.weight.push_back(0);
      data_.source.push_back(0);
      data_.kind.push_back(Measured::Coefficient);
    }
    return true;
  }

  /// Of interpolation, by the method of multipliers: moves the data by what is left of them. False where that has
  /// ended.
  bool move_data() {
    constexpr double goal = 1e-9, least_gain = 0.5;
    if (!task_.interpolates) return false;
    const double before = std::exchange(missed_, largest(residuals_));
    if (missed_ < goal || missed_ > least_gain * before) return false;
    for (std::size_t i = 0; i < wanted_.size(); ++i) data_.value[i] += residuals_[i];
    return true;
  }

  static double largest(std::span<const double> values) {
    double result = 0;
    for (const double v : values) result = std::max(result, std::abs(v));
    return result;
  }

  MeasurementLimits limits_of(const FitProblem& problem) const {
    constexpr double unit = 0.1;  // of bounds
    MeasurementLimits limits;
    for (const std::size_t k : problem.order()) {
      const bool is_datum = k < wanted_.size(), gives = is_datum && !task_.tolerances.empty();
      const double tolerance = gives ? task_.tolerances[k] : infinity;
      limits.lower.push_back(is_datum ? wanted_[k] - tolerance : lower(rows_[k - wanted_.size()]));
      limits.upper.push_back(is_datum ? wanted_[k] + tolerance : upper(rows_[k - wanted_.size()]));
      limits.unit.push_back(gives ? tolerance : unit);
      limits.gives.push_back(gives);
      limits.pull.push_back(is_datum && !gives ? data_.weight[k] / fit_.lambda : 0);
    }
    return limits;
  }

  void solve(double rise) {
    FitProblem problem(data_, region_, options_);
    MeasurementLimits limits = limits_of(problem);
    limits.rise = rise;
    const int before = fit_.account.cycles;
    auto next = fit_within(problem, limits, std::move(fit_.coefficients), options_);
    next.lambda = fit_.lambda;
    next.account.cycles += before;
    fit_ = std::move(next);
    const auto values = problem.values(fit_.coefficients);
    residuals_.assign(wanted_.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t k = problem.order()[i];
      if (k < wanted_.size()) residuals_[k] = wanted_[k] - values[i];
    }
  }

  static constexpr double rounding = 1e-12;  // of the range: what is a row has been kept within by another formula

  FitData data_;                // and behind it the rows
  std::vector<double> wanted_;  // the data's own values
  const Rectangle& region_;
  const FitOptions& options_;
  const BoundedFitTask& task_;
  SplineBasis basis_x_, basis_y_;
  Finer x_, y_;
  std::vector<bool> is_row_;
  std::vector<std::size_t> rows_;  // indices of the bounded coefficients
  std::vector<double> residuals_;  // of the data
  double missed_ = infinity;       // the largest of them, a round before
  ConstrainedFit fit_;
};

}  // namespace

ConstrainedFit fit_between(const FitData& data, const Rectangle& region, const FitOptions& options,
                           const BoundedFitTask& task) {
  return BoundedFit(data, region, options, task).solved();
}

}  // namespace batten
