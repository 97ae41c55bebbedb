// SPDX-License-Identifier: MIT
#include <batten/bases/cell_quadrature.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/side_blending.h>
#include <batten/fem/side_data.h>
#include <batten/fem/sparse_cholesky.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace batten {
namespace {

EndCondition condition_of(const Side& side, bool plate) {
  const bool slope = plate && side.normal;
  if (side.periodic) return EndCondition::Periodic;
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

/// ∫ f N_i
std::vector<double> moments(const SplineBasis& basis, const Trace& f, const char* side) {
  const CellQuadrature gauss(basis, basis.degree() + 2);
  std::vector<double> b(static_cast<std::size_t>(basis.size()));
  for (int cell = 0; cell < gauss.cells(); ++cell)
    for (int q = 0; q < gauss.points(); ++q) {
      const double v = finite(f, gauss.place(cell, q), side) * gauss.weight(cell, q);
      for (int a = 0; a < gauss.functions(); ++a)
        b[static_cast<std::size_t>(cell + a)] += v * gauss.value(cell, q, 0, a);
    }
  return b;
}

/// Coefficients, in the whole basis, of the L2 projection onto the periodic splines.
std::vector<double> projected_around(const SplineBasis& basis, const Trace& f, const char* side) {
  const auto original = [&](int i) { return basis.original(i); };
  const auto b = moments(basis, f, side);
  const auto mass = basis.inner_products(0);
  std::vector<double> c(b.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < basis.size(); ++i) {
    c[static_cast<std::size_t>(original(i))] += b[static_cast<std::size_t>(i)];
    for (int j = std::max(0, i - basis.degree()); j <= std::min(basis.size() - 1, i + basis.degree()); ++j)
      if (original(j) <= original(i) && mass(i, j) != 0)
        entries.emplace_back(original(i), original(j), basis.interval().finest_cell_length() * mass(i, j));
  }
  Eigen::SparseMatrix<double> lower(basis.kept(), basis.kept());
  lower.setFromTriplets(entries.begin(), entries.end());
  SparseCholesky(lower).solve(std::span(c).first(static_cast<std::size_t>(basis.kept())));
  for (int i = 0; i < basis.size(); ++i) c[static_cast<std::size_t>(i)] = c[static_cast<std::size_t>(original(i))];
  basis.to_unconstrained(c.data(), 1);
  return c;
}

/// Coefficients of the L2 projection that takes the values of f at both ends, or of the periodic one.
std::vector<double> projected(const SplineBasis& basis, const Trace& f, const char* side) {
  if (basis.is_periodic()) return projected_around(basis, f, side);
  const int n = basis.size();
  const auto& interval = basis.interval();
  std::vector<double> c(static_cast<std::size_t>(n));
  c.front() = finite(f, interval.lower(), side);
  c.back() = finite(f, interval.upper(), side);
  if (n == 2) return c;
  std::vector<double> b = moments(basis, f, side);
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

  std::ptrdiff_t on(int k) const { return start + k * step; }
  std::ptrdiff_t next(int k) const { return on(k) + inward; }
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

/// A sentence where data between periodic sides do not close.
void add_seam_notes(const SideGrid& s, std::vector<std::string>& notes) {
  for (const auto* data : {&s.side->value, &s.side->normal}) {
    if (!*data) continue;
    const auto f = s.trace(**data);
    const auto& interval = s.along->interval();
    const double a = f(interval.lower()), b = f(interval.upper());
    double size = 0;
    for (int k = 0; k <= 16; ++k) size = std::max(size, std::abs(f(interval.lower() + k * interval.length() / 16)));
    if (std::abs(a - b) > 1e-9 * size)
      notes.push_back(std::string("what the side ") + s.name + " prescribes is " + number_text(a, 6) +
                      " at one periodic side and " + number_text(b, 6) +
                      " at the other; the nearest periodic spline is taken");
  }
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
  const std::array<std::array<const Side*, 2>, 2> opposite = {{{&s.left, &s.right}, {&s.bottom, &s.top}}};
  for (const auto& [side, other] : opposite) {
    if (side->periodic != other->periodic)
      throw InvalidInput("side_conditions: expected opposite sides to be periodic together, found one that is not");
    if (side->periodic && (side->value || side->normal || other->value || other->normal))
      throw InvalidInput("side_conditions: expected nothing prescribed on periodic sides, found data");
  }
  return {{condition_of(s.left, plate), condition_of(s.right, plate)},
          {condition_of(s.bottom, plate), condition_of(s.top, plate)}};
}

namespace {

/// Coefficients that sides with values fix: on the side, and next to it where the plate's slope is given too.
struct FixedCoefficients {
  Wishes on, next;

  bool has(std::ptrdiff_t i) const { return on.has(i) || next.has(i); }
  double mean(std::ptrdiff_t i) const { return on.has(i) ? on.mean(i) : next.mean(i); }
};

std::vector<double> slopes_of(const SideGrid& s) {
  auto slopes = projected(*s.along, s.trace(*s.side->normal), s.name);
  for (double& slope : slopes) slope *= slope_step(*s.across);
  return slopes;
}

/// The L2 projection of the slopes of all sides at once: at a corner two sides share the coefficient next to both, and
/// the values of one fix the end of the other's slope. Slopes that jump at corners (the lid of a cavity) so are met in
/// the mean of every spline that can meet them.
class SlopeProjection {
public:
  SlopeProjection(std::vector<const SideGrid*> sides, const Wishes& on) : sides_(std::move(sides)), on_(on) {
    for (const SideGrid* const s : sides_)
      for (int k = 0; k < s->along->size(); ++k)
        if (!on_.has(s->next(k))) number_.emplace(s->next(k), 0);
    int count = 0;
    for (auto& [i, number] : number_) number = count++;
    right_.resize(number_.size());
    for (const SideGrid* const s : sides_) add(*s);
  }

  void solve_into(Wishes& next) {
    if (right_.empty()) return;
    const auto size = static_cast<Eigen::Index>(right_.size());
    Eigen::SparseMatrix<double> lower(size, size);
    lower.setFromTriplets(entries_.begin(), entries_.end());
    SparseCholesky(lower).solve(right_);
    for (const auto& [i, number] : number_) next.add(i, right_[static_cast<std::size_t>(number)]);
  }

private:
  /// With t the coefficients next to the side and p those on it the slope is Σ (t_k - p_k) N_k / step, hence
  /// Σ_j M_kj (t_j - p_j) / step² = ∫ slope N_k / step for every t_k that is not fixed.
  void add(const SideGrid& s) {
    const auto b = moments(*s.along, s.trace(*s.side->normal), s.name);
    const auto mass = s.along->inner_products(0);
    const double step = slope_step(*s.across), unit = s.along->interval().finest_cell_length() / (step * step);
    const int n = s.along->size(), degree = s.along->degree();
    for (int k = 0; k < n; ++k) {
      const auto row = number_.find(s.next(k));
      if (row == number_.end()) continue;
      double& right = right_[static_cast<std::size_t>(row->second)];
      right += b[static_cast<std::size_t>(k)] / step;
      for (int j = std::max(0, k - degree); j <= std::min(n - 1, k + degree); ++j) {
        const double m = unit * mass(k, j);
        const auto column = number_.find(s.next(j));
        right += m * on_.mean(s.on(j));
        if (column == number_.end())
          right -= m * on_.mean(s.next(j));
        else if (column->second <= row->second)
          entries_.emplace_back(row->second, column->second, m);
      }
    }
  }

  std::vector<const SideGrid*> sides_;
  const Wishes& on_;
  std::map<std::ptrdiff_t, int> number_;  // of the unknown coefficients
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> right_;
};

FixedCoefficients fixed_coefficients(const std::array<SideGrid, 4>& sides, std::size_t size, bool plate) {
  FixedCoefficients fixed{Wishes(size), Wishes(size)};
  for (const auto& s : sides) {
    if (!s.side->value) continue;
    const auto c = projected(*s.along, s.trace(*s.side->value), s.name);
    for (int k = 0; k < s.along->size(); ++k) fixed.on.add(s.on(k), c[static_cast<std::size_t>(k)]);
  }
  std::vector<const SideGrid*> joined;
  for (const auto& s : sides) {
    if (!plate || !s.side->value || !s.side->normal) continue;
    if (!s.along->is_periodic()) {
      joined.push_back(&s);
      continue;
    }
    const auto slopes = slopes_of(s);
    for (int k = 0; k < s.along->size(); ++k)
      fixed.next.add(s.next(k), fixed.on.mean(s.on(k)) + slopes[static_cast<std::size_t>(k)]);
  }
  SlopeProjection(joined, fixed.on).solve_into(fixed.next);
  return fixed;
}

/// Where the slope alone is given: the coefficients next to the side follow those on it.
void add_slopes(const SideGrid& s, const FixedCoefficients& fixed, std::vector<double>& c) {
  const auto slopes = slopes_of(s);
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    const std::ptrdiff_t i = s.start + static_cast<std::ptrdiff_t>(k) * s.step, next = i + s.inward;
    const double wanted = c[static_cast<std::size_t>(i)] + slopes[k];
    double& found = c[static_cast<std::size_t>(next)];
    found = fixed.has(next) ? (found + wanted) / 2 : wanted;
  }
}

}  // namespace

Lifting lifting(const BoundaryProblem& problem) {
  const auto around = [&](const Interval& interval, const Side& side) {
    const auto end = side.periodic ? EndCondition::Periodic : EndCondition::Free;
    return SplineBasis(interval, problem.degree, {end, end});
  };
  const auto x = around(problem.region.x, problem.sides.left), y = around(problem.region.y, problem.sides.bottom);
  const auto sides = side_grids(problem, x, y);
  const bool plate = problem.is_plate();
  const auto fixed = fixed_coefficients(sides, static_cast<std::size_t>(x.size()) * y.size(), plate);
  Lifting result{std::vector<double>(fixed.on.size()), corner_notes(sides)};
  for (std::size_t k = 0; k < result.coefficients.size(); ++k)
    result.coefficients[k] = fixed.mean(static_cast<std::ptrdiff_t>(k));
  const auto given = [&](const SideGrid& s) { return s.side->value ? plate && s.side->normal ? 2 : 1 : 0; };
  if (std::ranges::any_of(result.coefficients, [](double c) { return c != 0; }))
    blend_sides(x.unconstrained(), y.unconstrained(),
                {given(sides[0]), given(sides[1]), given(sides[2]), given(sides[3])}, result.coefficients);
  for (const auto& s : sides) {
    if (plate && s.side->normal && !s.side->value) add_slopes(s, fixed, result.coefficients);
    if (s.along->is_periodic()) add_seam_notes(s, result.notes);
  }
  return result;
}

}  // namespace batten
