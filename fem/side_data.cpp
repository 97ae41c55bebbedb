// SPDX-License-Identifier: MIT
#include <batten/bases/cell_quadrature.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/side_data.h>
#include <batten/fem/sparse_cholesky.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace batten {
namespace {

EndCondition condition_of(const Side& side, bool plate) {
  const bool slope = plate && side.normal;
  if (side.value) return slope ? EndCondition::Clamped : EndCondition::Zero;
  return slope ? EndCondition::Flat : EndCondition::Free;
}

using Trace = std::function<double(double)>;

double finite(const Trace& f, double s, const char* side) {
  const double value = f(s);
  if (!std::isfinite(value))
    throw InvalidInput(std::string("lifting: expected finite data on the side ") + side + ", found " +
                       number_text(value) + " at " + number_text(s, 6));
  return value;
}

/// Coefficients of the L2 projection that takes the values of f at both ends.
std::vector<double> projected(const SplineBasis& basis, const Trace& f, const char* side) {
  const int n = basis.size();
  const auto& interval = basis.interval();
  std::vector<double> c(static_cast<std::size_t>(n));
  c.front() = finite(f, interval.lower(), side);
  c.back() = finite(f, interval.upper(), side);
  if (n == 2) return c;
  const CellQuadrature gauss(basis, basis.degree() + 2);
  std::vector<double> b(c.size());
  for (int cell = 0; cell < gauss.cells(); ++cell)
    for (int q = 0; q < gauss.points(); ++q) {
      const double v = finite(f, gauss.place(cell, q), side) * gauss.weight(cell, q);
      for (int a = 0; a < gauss.functions(); ++a)
        b[static_cast<std::size_t>(cell + a)] += v * gauss.value(cell, q, 0, a);
    }
  const auto mass = basis.inner_products(0);
  const double unit = interval.finest_cell_length();
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 1; i < n - 1; ++i) {
    b[static_cast<std::size_t>(i)] -= unit * (mass(i, 0) * c.front() + mass(i, n - 1) * c.back());
    for (int j = 1; j <= i; ++j)
      if (mass(i, j) != 0) entries.emplace_back(i - 1, j - 1, unit * mass(i, j));
  }
  Eigen::SparseMatrix<double> lower(n - 2, n - 2);
  lower.setFromTriplets(entries.begin(), entries.end());
  SparseCholesky(lower).solve(std::span(b).subspan(1, c.size() - 2));
  std::copy(b.begin() + 1, b.end() - 1, c.begin() + 1);
  return c;
}

/// One side: its place in the grid of coefficients, and its data along it.
struct SideGrid {
  const Side* side;
  const char* name;
  const SplineBasis *along, *across;
  std::ptrdiff_t start, step, inward;  ///< first coefficient, next along the side, next from the side
  double fixed;                        ///< the coordinate that does not change along the side
  bool vertical;

  Trace trace(const Field& field) const {
    return [&field, this](double s) { return vertical ? field(fixed, s) : field(s, fixed); };
  }
};

/// A value for each coefficient that several sides may ask for.
class Wishes {
public:
  explicit Wishes(std::size_t size) : sum_(size), count_(size) {}
  void add(std::ptrdiff_t i, double value) {
    sum_[static_cast<std::size_t>(i)] += value;
    ++count_[static_cast<std::size_t>(i)];
  }
  bool has(std::ptrdiff_t i) const { return count_[static_cast<std::size_t>(i)] > 0; }
  double mean(std::ptrdiff_t i) const {
    const auto k = static_cast<std::size_t>(i);
    return count_[k] > 0 ? sum_[k] / count_[k] : 0;
  }
  std::size_t size() const { return sum_.size(); }

private:
  std::vector<double> sum_;
  std::vector<int> count_;
};

std::array<SideGrid, 4> side_grids(const BoundaryProblem& problem, const SplineBasis& x, const SplineBasis& y) {
  const std::ptrdiff_t nx = x.size(), ny = y.size();
  const auto& [left, right, bottom, top] = problem.sides;
  return {SideGrid{&left, "left", &y, &x, 0, nx, 1, problem.region.x.lower(), true},
          SideGrid{&right, "right", &y, &x, nx - 1, nx, -1, problem.region.x.upper(), true},
          SideGrid{&bottom, "bottom", &x, &y, 0, 1, nx, problem.region.y.lower(), false},
          SideGrid{&top, "top", &x, &y, (ny - 1) * nx, 1, -nx, problem.region.y.upper(), false}};
}

/// A sentence for every corner where two sides prescribe different values.
std::vector<std::string> corner_notes(const std::array<SideGrid, 4>& sides) {
  std::vector<std::string> notes;
  for (const auto& v : {sides[0], sides[1]})
    for (const auto& h : {sides[2], sides[3]}) {
      if (!v.side->value || !h.side->value) continue;
      const double a = (*v.side->value)(v.fixed, h.fixed), b = (*h.side->value)(v.fixed, h.fixed);
      if (std::abs(a - b) > 1e-12 * std::max(std::abs(a), std::abs(b)))
        notes.push_back(std::string("the corner of the sides ") + v.name + " and " + h.name + " has the values " +
                        number_text(a, 6) + " and " + number_text(b, 6) + "; their mean is taken");
    }
  return notes;
}

/// How far a coefficient next to the side lies above the one on it, for a slope of 1 in the outward direction: the
/// derivative of a clamped spline at an end is degree / (length of the cell) times the difference.
double slope_step(const SplineBasis& across) {
  const auto& interval = across.interval();
  return -interval.finest_cell_length() * interval.regular_cell() / across.degree();
}

}  // namespace

SpaceEnds side_conditions(const BoundaryProblem& problem) {
  const bool plate = problem.is_plate();
  const auto& s = problem.sides;
  for (const Side* side : {&s.left, &s.right, &s.bottom, &s.top})
    if (side->periodic)
      throw InvalidInput("side_conditions: expected sides that are not periodic; those cannot be solved yet");
  return {{condition_of(s.left, plate), condition_of(s.right, plate)},
          {condition_of(s.bottom, plate), condition_of(s.top, plate)}};
}

Lifting lifting(const BoundaryProblem& problem) {
  const SplineBasis x(problem.region.x, problem.degree), y(problem.region.y, problem.degree);
  const auto sides = side_grids(problem, x, y);
  Wishes value(static_cast<std::size_t>(x.size()) * static_cast<std::size_t>(y.size())), next(value.size());
  for (const auto& s : sides) {
    if (!s.side->value) continue;
    const auto c = projected(*s.along, s.trace(*s.side->value), s.name);
    for (std::size_t k = 0; k < c.size(); ++k) value.add(s.start + static_cast<std::ptrdiff_t>(k) * s.step, c[k]);
  }
  for (const auto& s : sides) {
    if (!problem.is_plate() || !s.side->normal) continue;
    const auto slope = projected(*s.along, s.trace(*s.side->normal), s.name);
    for (std::size_t k = 0; k < slope.size(); ++k) {
      const std::ptrdiff_t i = s.start + static_cast<std::ptrdiff_t>(k) * s.step;
      next.add(i + s.inward, value.mean(i) + slope_step(*s.across) * slope[k]);
    }
  }
  Lifting result{std::vector<double>(value.size()), corner_notes(sides)};
  for (std::size_t k = 0; k < value.size(); ++k) {
    const auto i = static_cast<std::ptrdiff_t>(k);
    result.coefficients[k] = value.has(i) && next.has(i) ? (value.mean(i) + next.mean(i)) / 2
                             : next.has(i)               ? next.mean(i)
                                                         : value.mean(i);
  }
  return result;
}

}  // namespace batten
