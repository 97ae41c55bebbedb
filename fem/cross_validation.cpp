// SPDX-License-Identifier: MIT
#include <batten/fem/cross_validation.h>
#include <batten/fem/random_signs.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace batten {
namespace {

constexpr double misfit_accuracy = 1e-3, probe_accuracy = 1e-2;  // of the first solves
constexpr double exact_accuracy = 1e-6;  // of the first solves for data that may be exact: their misfits are small
constexpr double coarse_step = 2, fine_step = 0.1;  // in log10 λ
constexpr double refining_step = 0.4;

int probe_count(std::size_t points) { return points < 200 ? 12 : points < 2000 ? 6 : points < 20000 ? 2 : 1; }

/// Scores on one grid. Keeps its solutions as starts for the next λ.
class Score {
public:
  Score(PenalisedProblem& problem, const FitOptions& options, int probes) : problem_(problem), limits_(options.limits) {
    const auto& order = problem.order();
    for (int k = 0; k < probes; ++k) {
      const auto signs = random_signs(order.size(), options.seed, static_cast<std::uint64_t>(k));
      std::vector<double> probe(order.size());
      for (std::size_t i = 0; i < order.size(); ++i) probe[i] = signs[order[i]] / std::sqrt(problem.weight()[i]);
      probes_.push_back(std::move(probe));
    }
    starts_.assign(probes_.size() + 1, std::vector<double>(problem.unknowns()));
  }

  struct Value {
    double misfit;
    double first;  ///< the first probe's estimate of 1 - tr H / N
    double free;   ///< all probes' estimate
    double score() const { return free > 0 ? misfit / (free * free) : std::numeric_limits<double>::infinity(); }
  };

  /// `accuracy`: of the first solve for the data.
  Value operator()(double log_lambda, double accuracy = misfit_accuracy) {
    const auto known = values_.find(log_lambda);
    if (known != values_.end()) return known->second;
    problem_.set(std::pow(10., log_lambda));
    Value value{objective(problem_.value(), starts_[0], accuracy, true).misfit, 0, 0};
    for (std::size_t k = 0; k < probes_.size(); ++k) {
      // a probe's solution is rough: coarser levels give a better start than another λ
      if (problem_.can_predict()) std::fill(starts_[k + 1].begin(), starts_[k + 1].end(), 0.);
      // ξ·(I - H) ξ / N in the basis in which H is symmetric
      const double free =
          objective(probes_[k], starts_[k + 1], probe_accuracy, false).least / static_cast<double>(problem_.size());
      if (k == 0) value.first = free;
      value.free += free / static_cast<double>(probes_.size());
    }
    return values_[log_lambda] = value;
  }

  double work() const { return work_; }
  const std::vector<double>& last_solution() const { return starts_[0]; }
  double log_lambda_of_least() const {
    return std::min_element(values_.begin(), values_.end(),
                            [](const auto& a, const auto& b) { return a.second.score() < b.second.score(); })
        ->first;
  }

private:
  /// Σ w_i (v_i - p(x_i))² and that plus λ E(p), for the minimiser p of the latter: v·W (I - H) v.
  struct Objective {
    double misfit, least;
  };

  /// Solves for the values v, as accurately as the result asks: its error is the square of the one in p, in the energy
  /// norm. Starts at c and leaves the solution there.
  Objective objective(const std::vector<double>& v, std::vector<double>& c, double accuracy, bool needs_misfit) {
    const auto b = problem_.right_side(problem_.weight(), v);
    const auto product = [&](const std::vector<double>& a) {
      return std::inner_product(a.begin(), a.end(), c.begin(), 0.);
    };
    double size = 0;
    for (std::size_t i = 0; i < v.size(); ++i) size += problem_.weight()[i] * v[i] * v[i];
    std::vector<double> image(c.size());
    IterationLimits limits = limits_;
    limits.accuracy = accuracy;
    for (;;) {
      work_ += problem_.solve(b, c, limits, std::sqrt(std::max(0., product(b)))).iterations + 1;
      problem_.apply(c, image);
      Objective result{0, size - 2 * product(b) + product(image)};
      double wanted = std::abs(result.least);
      if (needs_misfit) {
        const auto fitted = problem_.values(c);
        for (std::size_t i = 0; i < v.size(); ++i)
          result.misfit += problem_.weight()[i] * (v[i] - fitted[i]) * (v[i] - fitted[i]);
        wanted = std::min(wanted, result.misfit);
      }
      const double needed = std::sqrt(1e-3 * wanted / std::max(product(b), 1e-300));
      if (limits.accuracy <= std::max(needed, limits_.accuracy)) return result;
      limits.accuracy = std::max({needed / 2, limits.accuracy / 1000, limits_.accuracy});
    }
  }

  PenalisedProblem& problem_;
  IterationLimits limits_;
  std::vector<std::vector<double>> probes_, starts_;
  std::map<double, Value> values_;
  double work_ = 0;
};

/// Steps down from large λ until the score has risen twice, then halves the step around the least score. On the last
/// grid, where that is expensive, it first asks whether the data are exact: the score still halves at the lower end.
void search(Score& score, const FitOptions& options, bool last_grid) {
  const double top = std::log10(largest_lambda), bottom = std::log10(smallest_lambda);
  const auto exact_score = [&](double x) { return score(x, exact_accuracy).score(); };
  if (last_grid && exact_score(bottom + coarse_step) > 2 * exact_score(bottom)) return;
  double least = score(top).score();
  int rises = 0;
  for (double x = top - coarse_step; x > bottom - coarse_step / 2 && rises < 2; x -= coarse_step) {
    const double value = score(std::max(x, bottom)).score();
    rises = value < least ? 0 : rises + 1;
    least = std::min(least, value);
    if (options.progress) options.progress("cross-validation", (top - x) / (top - bottom));
  }
  for (double step = coarse_step / 2; step > fine_step; step /= 2) {
    const double x = score.log_lambda_of_least();
    if (x <= bottom) return score(bottom + step), void();
    score(std::min(x + step, top));
    score(std::max(x - step, bottom));
  }
}

/// Minimum of the parabola through three equally spaced scores, within their range.
double parabola_minimum(double x, double step, double left, double middle, double right) {
  const double curvature = left - 2 * middle + right;
  if (!(curvature > 0)) return left < right ? x - step : x + step;
  return x + std::clamp(step / 2 * (left - right) / curvature, -step, step);
}

/// The grid of the search: at least 2 sqrt(N) cells on the longer side, with cells of the same shape.
Rectangle search_grid(const Rectangle& region, std::size_t points) {
  const int nx = region.x.cells(), ny = region.y.cells();
  const double least = std::max(16., 2 * std::sqrt(static_cast<double>(points)));
  const double ratio = std::min(1., least / std::min(nx, ny));
  const auto cells = [&](int n) { return std::min(n, std::max(2, static_cast<int>(std::ceil(n * ratio)))); };
  return {Interval(region.x.lower(), region.x.upper(), cells(nx)),
          Interval(region.y.lower(), region.y.upper(), cells(ny))};
}

}  // namespace

namespace {

/// Minimum of the parabola through scores of the last grid around the one found. Misfits are those of the last grid; so
/// is the first probe's trace, while the other probes' part of it is taken over from the grid of the search.
double refined(double log_lambda, Score& searched, PenalisedProblem& problem, const FitOptions& options, double& work) {
  Score last(problem, options, 1);
  const auto score = [&](double x) {
    auto value = last(x);
    const auto before = searched(x);
    value.free = std::max(before.free + value.first - before.first, 0.1 * before.free);
    return value.score();
  };
  const double left = score(log_lambda - refining_step), right = score(log_lambda + refining_step);
  const double x = parabola_minimum(log_lambda, refining_step, left, score(log_lambda), right);
  work += last.work();
  return x;
}

}  // namespace

CrossValidationResult cross_validate(PenalisedProblem& problem, const FitOptions& options) {
  const Rectangle& region = problem.region();
  const Rectangle grid = search_grid(region, problem.size());
  const bool last_grid = grid.x.cells() == region.x.cells() && grid.y.cells() == region.y.cells();
  std::unique_ptr<PenalisedProblem> coarse;
  if (!last_grid) coarse = problem.on(grid);
  PenalisedProblem& searched = last_grid ? problem : *coarse;
  Score score(searched, options, probe_count(problem.size()));
  search(score, options, last_grid);

  const double bottom = std::log10(smallest_lambda), found = score.log_lambda_of_least();
  CrossValidationResult result;
  result.effective_degrees = static_cast<double>(problem.size()) * (1 - score(found).free);
  double log_lambda = found;
  if (!last_grid && found > bottom)
    log_lambda = std::max(bottom, refined(found, score, problem, options, result.refinement_work));
  result.work = result.refinement_work +
                score.work() * static_cast<double>(searched.unknowns()) / static_cast<double>(problem.unknowns());
  if (last_grid) result.start = score.last_solution();
  result.interior = log_lambda > bottom;
  result.lambda = result.interior ? std::pow(10., log_lambda) : smallest_lambda;
  return result;
}

}  // namespace batten
