// SPDX-License-Identifier: MIT
#include <batten/fem/plate_forces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr int most_order = 3;

/// ∂_x^a ∂_y^b w at a point, for a + b <= 3.
using Derivatives = std::array<std::array<double, most_order + 1>, most_order + 1>;

/// D and its slope.
struct Rigidity {
  double D = 0, Dx = 0, Dy = 0;
};

double slope(const Interval& range, double at, const auto& function) {
  const double step = 1e-5 * range.length();
  const double a = std::max(at - step, range.lower()), b = std::min(at + step, range.upper());
  return (function(b) - function(a)) / (b - a);
}

Rigidity rigidity_at(const Field& D, const Rectangle& region, double x, double y) {
  if (D.is_constant()) return {D(x, y), 0, 0};
  return {D(x, y), slope(region.x, x, [&](double v) { return D(v, y); }),
          slope(region.y, y, [&](double v) { return D(x, v); })};
}

PlateForces forces_of(const Derivatives& w, const Rigidity& r, double nu) {
  const double bend_x = w[2][0] + nu * w[0][2], bend_y = w[0][2] + nu * w[2][0], twist = (1 - nu) * w[1][1];
  return {-r.D * bend_x, -r.D * bend_y, -r.D * twist, -r.D * (w[3][0] + w[1][2]) - r.Dx * bend_x - r.Dy * twist,
          -r.D * (w[2][1] + w[0][3]) - r.Dy * bend_y - r.Dx * twist};
}

struct Normal {
  double x, y;
};

Normal normal_of(Edge edge) {
  switch (edge) {
    case Edge::Left:
      return {-1, 0};
    case Edge::Right:
      return {1, 0};
    case Edge::Bottom:
      return {0, -1};
    case Edge::Top:
      break;
  }
  return {0, 1};
}

/// V_n. With t = (-n_y, n_x), M_nt = n_x t_y Mxy + n_y t_x Mxy on a side along an axis.
double reaction_of(const Derivatives& w, const Rigidity& r, double nu, double tension, const Normal& n) {
  const PlateForces f = forces_of(w, r, nu);
  const double twist_x = -(1 - nu) * (r.D * w[2][1] + r.Dx * w[1][1]);  // ∂Mxy/∂x
  const double twist_y = -(1 - nu) * (r.D * w[1][2] + r.Dy * w[1][1]);
  return n.x * (f.Qx + twist_y + tension * w[1][0]) + n.y * (f.Qy + twist_x + tension * w[0][1]);
}

/// Where the derivative of this order is taken, to be averaged: on both sides of a breakpoint where it jumps.
std::vector<double> places_of(const Interval& interval, int degree, int order, double v) {
  if (order < degree) return {v};
  const double t = interval.to_cells(v), nearest = std::round(t);
  const bool jumps = std::abs(t - nearest) < 1e-9 && nearest > 0 && nearest < interval.finest_cells();
  if (!jumps) return {v};
  const double half = interval.finest_cell_length() / 2;
  return {v - half, v + half};
}

double derivative_of(const Solution& w, double x, double y, int a, int b) {
  if (a > w.degree() || b > w.degree()) return 0;
  double sum = 0;
  const auto xs = places_of(w.region().x, w.degree(), a, x), ys = places_of(w.region().y, w.degree(), b, y);
  for (const double px : xs)
    for (const double py : ys) sum += w.derivative(px, py, a, b);
  return sum / static_cast<double>(xs.size() * ys.size());
}

Derivatives derivatives_at(const Solution& w, double x, double y) {
  Derivatives d{};
  for (int a = 0; a <= most_order; ++a)
    for (int b = 0; a + b <= most_order; ++b)
      d[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = derivative_of(w, x, y, a, b);
  return d;
}

/// The derivatives at the corners of the cells, a row at a time.
class CornerDerivatives {
public:
  explicit CornerDerivatives(const Solution& w) : w_(w) {
    const SplineBasis x(w.region().x, w.degree()), y(w.region().y, w.degree());
    for (int r = 0; r <= most_order; ++r) {
      x_.push_back(x.samples(r));
      y_.push_back(y.samples(r));
    }
    unit_ = {w.region().x.finest_cells() / w.region().x.length(), w.region().y.finest_cells() / w.region().y.length()};
  }

  std::vector<Derivatives> row(int j) const {
    std::vector<Derivatives> result(static_cast<std::size_t>(x_[0].rows));
    for (int b = 0; b <= most_order; ++b) {
      const std::vector<double> line = combined(y_[static_cast<std::size_t>(b)], j);
      for (int a = 0; a + b <= most_order; ++a) {
        const double scale = std::pow(unit_[0], a) * std::pow(unit_[1], b);
        for (int i = 0; i < x_[0].rows; ++i)
          result[static_cast<std::size_t>(i)][static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] =
              scale * product(x_[static_cast<std::size_t>(a)], i, line.data());
      }
    }
    return result;
  }

private:
  static double product(const BandedRows& rows, int i, const double* values) {
    const auto weights = rows.row(i);
    const double* v = values + rows.first[static_cast<std::size_t>(i)];
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * v[k];
    return rows.scale * sum;
  }

  /// Row j of `rows` times the rows of coefficients.
  std::vector<double> combined(const BandedRows& rows, int j) const {
    const auto n = static_cast<std::size_t>(x_[0].columns);
    std::vector<double> line(n);
    for (int k = 0; k < rows.width; ++k) {
      const double weight = rows.scale * rows.row(j)[static_cast<std::size_t>(k)];
      const double* c =
          w_.coefficients().data() + static_cast<std::size_t>(rows.first[static_cast<std::size_t>(j)] + k) * n;
      for (std::size_t i = 0; i < n; ++i) line[i] += weight * c[i];
    }
    return line;
  }

  const Solution& w_;
  std::vector<BandedRows> x_, y_;
  std::array<double, 2> unit_ = {1, 1};  // cells per length
};

/// The normal of the side on which corner (i, j) of the cells lies; 0 inside and in the corners of the rectangle.
Normal normal_at(int i, int j, int nx, int ny) {
  const bool on_x = i == 0 || i == nx, on_y = j == 0 || j == ny;
  if (on_x == on_y) return {0, 0};
  if (on_x) return {i == 0 ? -1. : 1., 0};
  return {0, j == 0 ? -1. : 1.};
}

}  // namespace

PlateForces plate_forces(const Solution& w, const KirchhoffPlate& plate, double x, double y) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!w.region().contains(x, y)) return {nan, nan, nan, nan, nan};
  return forces_of(derivatives_at(w, x, y), rigidity_at(plate.rigidity, w.region(), x, y), plate.poisson_ratio);
}

double edge_reaction(const Solution& w, const KirchhoffPlate& plate, Edge edge, double along) {
  const Normal n = normal_of(edge);
  const Rectangle& region = w.region();
  const auto coordinate = [&](double direction, const Interval& range) {
    return direction == 0 ? along : direction < 0 ? range.lower() : range.upper();
  };
  const double x = coordinate(n.x, region.x), y = coordinate(n.y, region.y);
  if (!region.contains(x, y)) return std::numeric_limits<double>::quiet_NaN();
  return reaction_of(derivatives_at(w, x, y), rigidity_at(plate.rigidity, region, x, y), plate.poisson_ratio,
                     plate.tension(x, y), n);
}

std::array<double, 4> corner_forces(const Solution& w, const KirchhoffPlate& plate) {
  const Interval &x = w.region().x, &y = w.region().y;
  const auto twist = [&](double px, double py) { return plate_forces(w, plate, px, py).Mxy; };
  return {-2 * twist(x.lower(), y.lower()), 2 * twist(x.upper(), y.lower()), 2 * twist(x.lower(), y.upper()),
          -2 * twist(x.upper(), y.upper())};
}

std::vector<PointArray> force_samples(const Solution& w, const KirchhoffPlate& plate) {
  const Rectangle& region = w.region();
  const int nx = region.x.cells(), ny = region.y.cells();
  const auto columns = static_cast<std::size_t>(nx) + 1, count = columns * (static_cast<std::size_t>(ny) + 1);
  std::vector<PointArray> arrays;
  for (const char* const name : {"Mx", "My", "Mxy", "Qx", "Qy", "Vn"})
    arrays.push_back({name, 1, std::vector<double>(count, std::numeric_limits<double>::quiet_NaN())});
  const CornerDerivatives corners(w);
#pragma omp parallel for schedule(static)
  for (int j = 0; j <= ny; ++j) {
    const std::vector<Derivatives> row = corners.row(j);
    for (int i = 0; i <= nx; ++i) {
      const double x = region.x.coordinate(i), y = region.y.coordinate(j);
      const Derivatives& d = row[static_cast<std::size_t>(i)];
      const Rigidity r = rigidity_at(plate.rigidity, region, x, y);
      const PlateForces f = forces_of(d, r, plate.poisson_ratio);
      const std::size_t k = static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i);
      const std::array values = {f.Mx, f.My, f.Mxy, f.Qx, f.Qy};
      for (std::size_t a = 0; a < values.size(); ++a) arrays[a].values[k] = values[a];
      const Normal n = normal_at(i, j, nx, ny);
      if (n.x != 0 || n.y != 0)
        arrays.back().values[k] = reaction_of(d, r, plate.poisson_ratio, plate.tension(x, y), n);
    }
  }
  return arrays;
}

}  // namespace batten
