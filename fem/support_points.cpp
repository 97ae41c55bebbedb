// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/support_points.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace batten {
namespace {

std::string place(double x, double y) { return "(" + number_text(x, 6) + ", " + number_text(y, 6) + ")"; }

class Collection {
public:
  explicit Collection(const BoundaryProblem& problem)
      : problem_(problem),
        region_(problem.region),
        hx_(region_.x.length() / region_.x.cells()),
        hy_(region_.y.length() / region_.y.cells()) {}

  SupportPoints take() { return std::move(result_); }

  void add(double x, double y, double value, std::size_t owner) {
    if (!region_.contains(x, y))
      throw InvalidInput("solve_boundary_problem: expected supports within the rectangle, found one at " + place(x, y));
    if (!std::isfinite(value))
      throw InvalidInput("solve_boundary_problem: expected finite values of supports, found " + number_text(value) +
                         " at " + place(x, y));
    if (is_fixed(x, y)) return;
    constexpr double resolution = 1e-6;  // of a cell
    const std::pair key{std::llround(region_.x.to_cells(x) / resolution),
                        std::llround(region_.y.to_cells(y) / resolution)};
    auto& c = result_.constraints;
    const auto [there, is_new] = seen_.try_emplace(key, c.size());
    if (!is_new) {
      const double other = c.target[there->second];
      if (std::abs(other - value) > 1e-12 * std::max(std::abs(other), std::abs(value)))
        throw InvalidInput("solve_boundary_problem: expected one value for each place, found supports with " +
                           number_text(other, 6) + " and " + number_text(value, 6) + " at " + place(x, y));
      return;
    }
    c.x.push_back(x);
    c.y.push_back(y);
    c.target.push_back(value);
    result_.owner.push_back(owner);
  }

  void add_disc(const Supports::Point& p, std::size_t owner) {
    const int columns = static_cast<int>(p.radius / hx_) + 1, rows = static_cast<int>(p.radius / hy_) + 1;
    for (int j = -rows; j <= rows; ++j)
      for (int i = -columns; i <= columns; ++i)
        if (std::hypot(i * hx_, j * hy_) < p.radius - std::max(hx_, hy_) / 2)
          add(p.x + i * hx_, p.y + j * hy_, p.value, owner);
    const int count = std::max(8, static_cast<int>(std::ceil(2 * std::numbers::pi * p.radius / std::min(hx_, hy_))));
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      add(p.x + p.radius * std::cos(angle), p.y + p.radius * std::sin(angle), p.value, owner);
    }
  }

  void add_line(const Supports::Line& line, std::size_t owner) {
    const double dx = line.to[0] - line.from[0], dy = line.to[1] - line.from[1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::max(std::abs(dx) / hx_, std::abs(dy) / hy_))));
    for (int k = 0; k <= pieces; ++k) {
      const double s = static_cast<double>(k) / pieces, x = line.from[0] + s * dx, y = line.from[1] + s * dy;
      add(x, y, line.value(x, y), owner);
    }
  }

private:
  /// True on sides whose value is prescribed.
  bool is_fixed(double x, double y) const {
    const auto& s = problem_.sides;
    const double ex = 1e-9 * hx_, ey = 1e-9 * hy_;
    return (s.left.value && x - region_.x.lower() < ex) || (s.right.value && region_.x.upper() - x < ex) ||
           (s.bottom.value && y - region_.y.lower() < ey) || (s.top.value && region_.y.upper() - y < ey);
  }

  const BoundaryProblem& problem_;
  const Rectangle& region_;
  double hx_, hy_;
  SupportPoints result_;
  std::map<std::pair<long long, long long>, std::size_t> seen_;
};

}  // namespace

SupportPoints support_points(const BoundaryProblem& problem, const std::vector<std::array<double, 2>>& pins) {
  Collection points(problem);
  std::size_t owner = 0;
  for (const auto& p : problem.supports.points) {
    if (!problem.is_plate() && !(p.radius > 0))
      throw InvalidInput(
          "solve_boundary_problem: expected a radius > 0 of the support at " + place(p.x, p.y) +
          ", found none: in two dimensions the value of a membrane at a point is not bounded by its energy");
    if (p.radius > 0)
      points.add_disc(p, owner++);
    else
      points.add(p.x, p.y, p.value, owner++);
  }
  for (const auto& line : problem.supports.lines) points.add_line(line, owner++);
  for (const auto& pin : pins) points.add(pin[0], pin[1], 0, owner++);
  return points.take();
}

std::vector<double> missing_values(const BoundarySystem::Constraints& constraints,
                                   const std::vector<std::size_t>& order, const Solution& spline) {
  std::vector<double> result;
  for (const std::size_t i : order)
    result.push_back(constraints.target[i] - spline.value(constraints.x[i], constraints.y[i]));
  return result;
}

}  // namespace batten
