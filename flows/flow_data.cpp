// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/flows/flow_data.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace batten {
namespace {

void check(const VectorObservations& o) {
  const std::size_t n = o.size();
  if (o.y.size() != n || o.u.size() != n || o.v.size() != n || (!o.weight.empty() && o.weight.size() != n))
    throw InvalidInput("fit_flow: expected x, y, u, v and weight of one length, found " + std::to_string(n) + ", " +
                       std::to_string(o.y.size()) + ", " + std::to_string(o.u.size()) + ", " +
                       std::to_string(o.v.size()) + " and " + std::to_string(o.weight.size()));
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(o.x[i]) || !std::isfinite(o.y[i]) || !std::isfinite(o.u[i]) || !std::isfinite(o.v[i]))
      throw InvalidInput("fit_flow: expected finite numbers, found (" + number_text(o.x[i], 10) + ", " +
                         number_text(o.y[i], 10) + ") with velocity (" + number_text(o.u[i], 10) + ", " +
                         number_text(o.v[i], 10) + ") at observation " + std::to_string(i + 1));
    if (!o.weight.empty() && !(o.weight[i] >= 0 && std::isfinite(o.weight[i])))
      throw InvalidInput("fit_flow: expected weights that are not negative, found " + number_text(o.weight[i], 10) +
                         " at observation " + std::to_string(i + 1));
  }
  if (!o.weight.empty() && std::all_of(o.weight.begin(), o.weight.end(), [](double w) { return w == 0; }))
    throw InvalidInput("fit_flow: expected a weight that is not zero, found all " + std::to_string(n) + " zero");
}

/// Those inside the region with a weight; `source` are their indices.
struct Chosen {
  VectorObservations vectors;
  std::vector<std::size_t> source;
};

/// A vector that joins another at the same place: mean, summed weight.
void join(VectorObservations& o, std::size_t into, std::size_t from, const VectorObservations& all) {
  const double w = all.weight.empty() ? 1 : all.weight[from], sum = o.weight[into] + w;
  o.u[into] += w / sum * (all.u[from] - o.u[into]);
  o.v[into] += w / sum * (all.v[from] - o.v[into]);
  o.weight[into] = sum;
}

Chosen choose(const VectorObservations& o, const Rectangle& region, bool merge, FlowData& result) {
  Chosen chosen;
  auto& [x, y, u, v, weight] = chosen.vectors;
  std::map<std::pair<double, double>, std::size_t> places;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const bool inside = region.contains(o.x[i], o.y[i]);
    const double w = o.weight.empty() ? 1 : o.weight[i];
    if (!inside) ++result.outside;
    if (!inside || w == 0) continue;
    if (merge) {
      const auto [place, is_new] = places.try_emplace({o.x[i], o.y[i]}, x.size());
      if (!is_new) {
        ++result.merged;
        join(chosen.vectors, place->second, i, o);
        continue;
      }
    }
    x.push_back(o.x[i]);
    y.push_back(o.y[i]);
    u.push_back(o.u[i]);
    v.push_back(o.v[i]);
    weight.push_back(w);
    chosen.source.push_back(i);
  }
  return chosen;
}

const char* name_of(FlowModel model) {
  switch (model) {
    case FlowModel::Smooth:
      return "smooth";
    case FlowModel::Slow:
      return "slow";
    case FlowModel::Irrotational:
      return "irrotational";
    default:
      return "general";
  }
}

/// A quadratic ψ or φ without velocity at all points has them on one line; none has walls on all sides.
void check_determined(const VectorObservations& o, const Rectangle& region, const FlowOptions& options,
                      std::size_t given) {
  if (o.size() == 0)
    throw InvalidInput("fit_flow: expected at least one point inside the region, found none of " +
                       std::to_string(given) + " in x from " + number_text(region.x.lower(), 10) + " to " +
                       number_text(region.x.upper(), 10) + ", y from " + number_text(region.y.lower(), 10) + " to " +
                       number_text(region.y.upper(), 10));
  if (energy_of(options.model).null_degree() < 2 || options.sides.are_closed()) return;
  std::vector<double> s, t;
  for (std::size_t i = 0; i < o.size(); ++i) {
    s.push_back((o.x[i] - region.x.lower()) / region.x.length());
    t.push_back((o.y[i] - region.y.lower()) / region.y.length());
  }
  if (flatness(s, t) < 1e-10)
    throw InvalidInput(std::string("fit_flow: the model ") + name_of(options.model) +
                       " needs three points that are not on one line, found " + std::to_string(o.size()) +
                       (o.size() == 1 ? " point" : " points on one line") + " (the model slow needs one point)");
}

void check_geometry(const Rectangle& region, const FlowOptions& options) {
  try {
    geometry_of(options).expect_inside(region);
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string("fit_flow: ") + error.what());
  }
  if (options.geographic && (options.sides.bottom == FlowSide::Periodic || options.sides.top == FlowSide::Periodic))
    throw InvalidInput("fit_flow: expected periodic sides in longitude alone, found them in latitude");
}

/// Two rows for each vector.
void add_rows(const Chosen& chosen, const Rectangle& region, const FlowOptions& options, FlowData& result) {
  const auto& o = chosen.vectors;
  const bool is_potential = options.model == FlowModel::Irrotational;
  const FlowGeometry geometry = geometry_of(options);
  const double unit_x = geometry.length_y() / geometry.aspect(region);  // that of the mid latitude
  FitData& rows = result.rows;
  rows.total_weight = 2 * std::accumulate(o.weight.begin(), o.weight.end(), 0.);
  for (std::size_t i = 0; i < o.size(); ++i)
    for (const bool second : {false, true}) {
      const Measured kind = second == is_potential ? Measured::SlopeY : Measured::SlopeX;
      const double c = geometry.length_x(o.y[i]) / unit_x, factor = kind == Measured::SlopeX ? c : 1;
      rows.x.push_back(o.x[i]);
      rows.y.push_back(o.y[i]);
      rows.value.push_back(factor * (!second ? o.u[i] : is_potential ? o.v[i] : -o.v[i]));
      rows.kind.push_back(kind);
      rows.weight.push_back(o.weight[i] / rows.total_weight / (factor * factor));
      rows.source.push_back(chosen.source[i]);
      result.stretch.push_back(c);
    }
}

/// The slopes of s, t, s², s t, t² that a row measures, and what it measures of φ = s² + t² where they are those of ψ.
Eigen::Matrix<double, 6, 1> slopes(Measured kind, double stretch, double s, double t) {
  Eigen::Matrix<double, 6, 1> result;
  if (kind == Measured::SlopeX)
    result << 1, 0, 2 * s, t, 0, -2 * t * stretch;
  else
    result << 0, 1, 0, s, 2 * t, 2 * s / stretch;
  return result;
}

Eigen::Index null_dimension(const FlowOptions& options) {
  if (!options.sides.are_free()) return 0;
  if (options.model == FlowModel::Slow) return 2;
  return options.model == FlowModel::General ? 6 : 5;
}

/// What the null functions measure in a row; q has a centre and length.
Eigen::VectorXd null_row(const FlowData& data, double aspect, std::size_t i, Eigen::Index used) {
  const FitData& d = data.rows;
  const QuadraticFunction& q = data.null_element;
  const double s = (d.x[i] - q.x0) / q.length, t = aspect * (d.y[i] - q.y0) / q.length;
  return slopes(d.kind[i], data.stretch[i], s, t).head(used);
}

/// Adds to the null element; a QuadraticFunction knows no aspect.
void add_element(const Eigen::VectorXd& found, double aspect, FlowData& data) {
  const double a = aspect;
  const std::array<double, 5> factor = {1, a, 1, a, a * a};
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(found.size(), 5); ++k) {
    const auto at = static_cast<std::size_t>(k);
    data.null_element.c[at + 1] += factor[at] * found[k];
  }
  if (found.size() < 6) return;
  data.null_potential.c[3] += found[5];
  data.null_potential.c[5] += a * a * found[5];
}

/// Takes the weighted least-squares element of the null space off the rows and divides by their range.
void normalise(const Rectangle& region, const FlowOptions& options, FlowData& result) {
  FitData& d = result.rows;
  QuadraticFunction& q = result.null_element;
  const double aspect = geometry_of(options).aspect(region);
  q.length = std::max(region.x.length(), region.y.length() * aspect);
  const double total = std::accumulate(d.weight.begin(), d.weight.end(), 0.);
  q.x0 = std::inner_product(d.x.begin(), d.x.end(), d.weight.begin(), 0.) / total;
  q.y0 = std::inner_product(d.y.begin(), d.y.end(), d.weight.begin(), 0.) / total;
  const auto [low, high] = std::minmax_element(d.value.begin(), d.value.end());
  const double largest = std::max(std::abs(*low), std::abs(*high)), range = *high - *low;
  const Eigen::Index used = null_dimension(options);
  result.null_potential = {{}, q.x0, q.y0, q.length};
  // Twice: the second pass fits what rounding left of the first.
  for (int pass = 0; pass < 2 && used > 0; ++pass) {
    Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(used, used);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(used);
    const auto row = [&](std::size_t i) { return null_row(result, aspect, i, used); };
    for (std::size_t i = 0; i < d.size(); ++i) {
      moments += d.weight[i] * row(i) * row(i).transpose();
      right += d.weight[i] * d.value[i] * row(i);
    }
    const Eigen::VectorXd step = moments.completeOrthogonalDecomposition().solve(right);
    add_element(step, aspect, result);
    for (std::size_t i = 0; i < d.size(); ++i) d.value[i] -= row(i).dot(step);
  }
  d.scale = range > 0 ? range : largest > 0 ? largest : 1;
  double left = 0;
  for (double& v : d.value) left = std::max(left, std::abs(v /= d.scale));
  if (left <= 16 * std::numeric_limits<double>::epsilon() * largest / d.scale)
    std::fill(d.value.begin(), d.value.end(), 0.);  // data of the null space leave nothing to fit
}

}  // namespace

Energy energy_of(FlowModel model) {
  return model == FlowModel::Slow ? Energy::thin_plate() : Energy::third_derivatives();
}

FlowGeometry geometry_of(const FlowOptions& options) {
  return options.geographic ? FlowGeometry::sphere() : FlowGeometry::plane();
}

Eigen::MatrixXd null_measurements(const FlowData& data, const Rectangle& region, const FlowOptions& options) {
  const Eigen::Index used = null_dimension(options);
  const double aspect = geometry_of(options).aspect(region);
  Eigen::MatrixXd result(static_cast<Eigen::Index>(data.rows.size()), used);
  for (std::size_t i = 0; i < data.rows.size(); ++i)
    result.row(static_cast<Eigen::Index>(i)) = null_row(data, aspect, i, used).transpose();
  return result;
}

void add_to_null_element(const Eigen::VectorXd& amounts, const Rectangle& region, const FlowOptions& options,
                         FlowData& data) {
  add_element(data.rows.scale * amounts, geometry_of(options).aspect(region), data);
}

FlowData prepare_flow(const VectorObservations& o, const Rectangle& region, const FlowOptions& options,
                      bool merge_coincident) {
  check(o);
  check_geometry(region, options);
  FlowData result;
  const Chosen chosen = choose(o, region, merge_coincident, result);
  check_determined(chosen.vectors, region, options, o.size());
  add_rows(chosen, region, options, result);
  normalise(region, options, result);
  return result;
}

}  // namespace batten
