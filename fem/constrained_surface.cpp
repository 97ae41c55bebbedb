// SPDX-License-Identifier: MIT
#include <batten/fem/bounded_fit.h>
#include <batten/fem/boxes.h>
#include <batten/fem/constrained_surface.h>
#include <batten/fem/null_element.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace batten {
namespace {

/// Of the data, in their order and scale.
std::vector<double> scaled_tolerances(const Observations& o, const FitData& data, const FitOptions& options) {
  std::vector<double> result;
  for (const std::size_t i : data.source) result.push_back(tolerance_of(o, i, options.smoothing.value) / data.scale);
  return result;
}

/// A function without energy that stays within the tolerances and bounds, if there is one: added to the null element.
bool find_null_element(const Rectangle& region, const FitOptions& options, std::span<const double> tolerances,
                       FitData& d) {
  LinearFunction& f = d.null_element;
  const Eigen::Index functions = options.energy.null_degree() < 0 ? 0 : options.energy.null_degree() == 0 ? 1 : 3;
  const double length = std::max(region.x.length(), region.y.length());
  std::vector<double> lower, upper, unit(tolerances.begin(), tolerances.end()), x = d.x, y = d.y;
  double square = 0, widest = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    lower.push_back(d.value[i] - tolerances[i]);
    upper.push_back(d.value[i] + tolerances[i]);
    square += d.weight[i] * d.value[i] * d.value[i];
    widest = std::max(widest, tolerances[i]);
  }
  if (functions == 0 || square > widest * widest) return false;  // the least squares are larger than any within
  for (int corner = 0; corner < 4 && has_bounds(options); ++corner) {
    x.push_back(corner % 2 == 0 ? region.x.lower() : region.x.upper());
    y.push_back(corner / 2 == 0 ? region.y.lower() : region.y.upper());
    const double base = f(x.back(), y.back());
    lower.push_back(options.minimum ? (*options.minimum - base) / d.scale : -INFINITY);
    upper.push_back(options.maximum ? (*options.maximum - base) / d.scale : INFINITY);
    unit.push_back(widest);
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(x.size()), functions);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    rows.row(i) = Eigen::RowVector3d(1, (x[k] - f.x0) / length, (y[k] - f.y0) / length).head(functions);
  }
  Boxes boxes(lower, upper, unit);
  if (boxes.violation(std::vector<double>(x.size())) <= 0) return true;
  const auto element = element_within(rows, boxes);
  if (!element) return false;
  f.a += d.scale * (*element)[0];
  if (functions == 3) f.b += d.scale * (*element)[1] / length;
  if (functions == 3) f.c += d.scale * (*element)[2] / length;
  return true;
}

}  // namespace

double tolerance_of(const Observations& o, std::size_t i, double unit) {
  return o.tolerance.empty() ? unit : unit * o.tolerance[i];
}

ConstrainedFit fit_constrained(FitProblem& problem, FitData& data, const Observations& observations,
                               const FitOptions& options, ScaledFit free) {
  const bool is_within = options.smoothing.kind == Smoothing::Kind::Tolerance;
  const auto tolerances = is_within ? scaled_tolerances(observations, data, options) : std::vector<double>();
  ConstrainedFit fit{std::move(free), {}, {}};
  if (is_within) {
    if (find_null_element(problem.region(), options, tolerances, data)) {
      fit.coefficients.resize(problem.unknowns());
      return fit;
    }
    fit = fit_within(problem, reordered(tolerances, problem.order()), options);
  }
  if (!has_bounds(options)) return fit;
  fit.account.cycles = fit.iterations;
  return fit_between(data, problem.region(), options,
                     {std::move(fit), tolerances, options.smoothing.kind == Smoothing::Kind::None});
}

}  // namespace batten
