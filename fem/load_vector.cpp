// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/cell_quadrature.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/load_vector.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace batten {
namespace {

[[noreturn]] void refuse(const char* what, double value, double x, double y) {
  throw InvalidInput(std::string("load_vector: expected a finite ") + what + ", found " + number_text(value, 6) +
                     " at (" + number_text(x, 6) + ", " + number_text(y, 6) + ")");
}

/// Of derivatives.
struct Orders {
  int x = 0, y = 0;
};

class LoadVector {
public:
  explicit LoadVector(const BoundaryProblem& problem)
      : region_(problem.region),
        x_(problem.region.x, problem.degree),
        y_(problem.region.y, problem.degree),
        b_(static_cast<std::size_t>(x_.size()) * static_cast<std::size_t>(y_.size())) {}

  std::vector<double> take() { return std::move(b_); }

  /// v ∂_x^a ∂_y^b N_i(x, y) for all i.
  void add_point(double x, double y, double v, Orders orders = {}) {
    const auto nx = x_.at(region_.x.to_cells(x), orders.x), ny = y_.at(region_.y.to_cells(y), orders.y);
    v *= std::pow(region_.x.finest_cell_length(), -orders.x) * std::pow(region_.y.finest_cell_length(), -orders.y);
    for (int j = 0; j <= y_.degree(); ++j)
      for (int i = 0; i <= x_.degree(); ++i)
        b_[static_cast<std::size_t>(ny.first + j) * x_.size() + nx.first + i] +=
            v * nx.values[static_cast<std::size_t>(i)] * ny.values[static_cast<std::size_t>(j)];
  }

  void add_constant(double q) {
    const auto mx = x_.integrals(), my = y_.integrals();
    const double cell = region_.x.finest_cell_length() * region_.y.finest_cell_length();
    for (std::size_t j = 0; j < my.size(); ++j)
      for (std::size_t i = 0; i < mx.size(); ++i) b_[j * mx.size() + i] += q * cell * my[j] * mx[i];
  }

  /// ∫∫ q ∂_x^a ∂_y^b N_i
  void add_function(const Field& q, Orders orders = {});
  void add_line(const Loads::Line& line, const Field& factor);
  void add_patch(const Loads::Patch& patch);

private:
  /// The ends of the pieces into which cells cut [from, to].
  static std::vector<double> cuts(const Interval& interval, double from, double to) {
    std::vector<double> result = {from};
    for (int i = 1; i < interval.cells(); ++i)
      if (interval.coordinate(i) > from && interval.coordinate(i) < to) result.push_back(interval.coordinate(i));
    result.push_back(to);
    return result;
  }

  Rectangle region_;
  SplineBasis x_, y_;
  std::vector<double> b_;
};

void LoadVector::add_function(const Field& q, Orders orders) {
  const CellQuadrature gx(x_, x_.degree() + 2), gy(y_, y_.degree() + 2);
  const int n = x_.degree() + 1;
  const std::size_t columns = static_cast<std::size_t>(x_.size());
  std::vector<double> bad(static_cast<std::size_t>(gy.cells()), NAN), bad_x(bad.size()), bad_y(bad.size());
  std::vector<char> is_bad(bad.size());
  for_alternating_blocks(RowBlocks(gy.cells(), x_.size() * 4, std::max(4, y_.degree())), [&](int begin, int end) {
    std::vector<double> line(columns);
    for (int cy = begin; cy < end; ++cy)
      for (int qy = 0; qy < gy.points(); ++qy) {
        std::fill(line.begin(), line.end(), 0.);
        const double y = gy.place(cy, qy);
        for (int cx = 0; cx < gx.cells(); ++cx)
          for (int qx = 0; qx < gx.points(); ++qx) {
            const double x = gx.place(cx, qx), value = q(x, y);
            const auto r = static_cast<std::size_t>(cy);
            if (!std::isfinite(value) && !is_bad[r])
              std::tie(is_bad[r], bad[r], bad_x[r], bad_y[r]) = std::tuple(1, value, x, y);
            const double v = value * gx.weight(cx, qx);
            for (int a = 0; a < n; ++a) line[static_cast<std::size_t>(cx + a)] += v * gx.value(cx, qx, orders.x, a);
          }
        for (int b = 0; b < n; ++b) {
          const double v = gy.weight(cy, qy) * gy.value(cy, qy, orders.y, b);
          double* out = b_.data() + static_cast<std::size_t>(cy + b) * columns;
          for (std::size_t i = 0; i < columns; ++i) out[i] += v * line[i];
        }
      }
  });
  const auto first = std::find(is_bad.begin(), is_bad.end(), 1) - is_bad.begin();
  if (const auto r = static_cast<std::size_t>(first); r < is_bad.size()) refuse("load", bad[r], bad_x[r], bad_y[r]);
}

/// The line is cut where it crosses borders of cells.
void LoadVector::add_line(const Loads::Line& line, const Field& factor) {
  const GaussRule rule = gauss_rule(x_.degree() + 2);
  const double dx = line.to[0] - line.from[0], dy = line.to[1] - line.from[1];
  std::vector<double> parts = {0, 1};
  const auto cut = [&](const Interval& interval, double from, double length) {
    if (length == 0) return;
    for (int i = 1; i < interval.cells(); ++i) {
      const double s = (interval.coordinate(i) - from) / length;
      if (s > 0 && s < 1) parts.push_back(s);
    }
  };
  cut(region_.x, line.from[0], dx);
  cut(region_.y, line.from[1], dy);
  std::sort(parts.begin(), parts.end());
  for (std::size_t k = 0; k + 1 < parts.size(); ++k)
    for (std::size_t q = 0; q < rule.place.size(); ++q) {
      const double step = parts[k + 1] - parts[k], s = parts[k] + rule.place[q] * step;
      const double x = line.from[0] + s * dx, y = line.from[1] + s * dy, value = line.value(x, y) * factor(x, y);
      if (!std::isfinite(value)) refuse("load along a line", value, x, y);
      add_point(x, y, value * rule.weight[q] * step * std::hypot(dx, dy));
    }
}

void LoadVector::add_patch(const Loads::Patch& patch) {
  const GaussRule rule = gauss_rule(x_.degree() + 2);
  const auto xs = cuts(region_.x, patch.x[0], patch.x[1]), ys = cuts(region_.y, patch.y[0], patch.y[1]);
  for (std::size_t j = 0; j + 1 < ys.size(); ++j)
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
      for (std::size_t qy = 0; qy < rule.place.size(); ++qy)
        for (std::size_t qx = 0; qx < rule.place.size(); ++qx) {
          const double hx = xs[i + 1] - xs[i], hy = ys[j + 1] - ys[j];
          const double x = xs[i] + rule.place[qx] * hx, y = ys[j] + rule.place[qy] * hy, value = patch.q(x, y);
          if (!std::isfinite(value)) refuse("load of a patch", value, x, y);
          add_point(x, y, value * rule.weight[qx] * hx * rule.weight[qy] * hy);
        }
}

/// Fluxes k ∂u/∂n through the sides of a Conduction problem.
void add_fluxes(const BoundaryProblem& problem, LoadVector& b) {
  const auto* conduction = std::get_if<Conduction>(&problem.material);
  if (!conduction) return;
  const double x0 = problem.region.x.lower(), x1 = problem.region.x.upper();
  const double y0 = problem.region.y.lower(), y1 = problem.region.y.upper();
  const auto add = [&](const Side& side, std::array<double, 2> from, std::array<double, 2> to) {
    if (side.normal && !side.normal->is_zero()) b.add_line({from, to, *side.normal}, conduction->k);
  };
  add(problem.sides.left, {x0, y0}, {x0, y1});
  add(problem.sides.right, {x1, y0}, {x1, y1});
  add(problem.sides.bottom, {x0, y0}, {x1, y0});
  add(problem.sides.top, {x0, y1}, {x1, y1});
}

/// Couples do work on the slopes.
void add_couples(const BoundaryProblem& problem, LoadVector& b) {
  const auto& loads = problem.loads;
  if (!loads.couples.empty() && !problem.is_plate())
    throw InvalidInput("load_vector: expected couples at points of plates only, found them in a Conduction problem");
  if (!loads.area_mx.is_zero()) b.add_function(loads.area_mx, {1, 0});
  if (!loads.area_my.is_zero()) b.add_function(loads.area_my, {0, 1});
  for (const auto& c : loads.couples) {
    b.add_point(c.x, c.y, c.mx, {1, 0});
    b.add_point(c.x, c.y, c.my, {0, 1});
  }
}

}  // namespace

std::vector<double> load_vector(const BoundaryProblem& problem) {
  LoadVector b(problem);
  const auto& loads = problem.loads;
  if (!loads.area.is_constant())
    b.add_function(loads.area);
  else if (!loads.area.is_zero())
    b.add_constant(loads.area(0, 0));
  for (const auto& p : loads.points) b.add_point(p.x, p.y, p.value);
  for (const auto& line : loads.lines) b.add_line(line, 1.);
  for (const auto& patch : loads.patches) b.add_patch(patch);
  add_couples(problem, b);
  add_fluxes(problem, b);
  return b.take();
}

}  // namespace batten
