// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace batten {
namespace {

constexpr int coarsest_cells = 8;         // a side with fewer cells than twice this is not halved further ...
constexpr std::size_t direct_size = 600;  // ... unless the whole level is still too large for a direct solve

double cell_length(const SplineBasis& basis, double h) { return basis.interval().regular_cell() * h; }

struct Coarsening {
  bool x = false, y = false;
};

Coarsening choose_coarsening(const SplineSpace& s) {
  const double hx = cell_length(s.x, s.hx), hy = cell_length(s.y, s.hy);
  const int least = s.size() > direct_size ? 2 : 2 * coarsest_cells;
  const auto can_halve = [&](const SplineBasis& b) {
    const int cells = b.interval().cells();
    return cells >= least && cells / 2 + b.degree() > b.ends().removed();
  };
  return {can_halve(s.x) && hx < 1.5 * hy, can_halve(s.y) && hy < 1.5 * hx};
}

/// Largest eigenvalue of diag(E)^-1 E by power iteration, raised by 5 % for what the iteration has not reached.
double largest_eigenvalue(const Operator& e) {
  const auto diagonal = e.diagonal();
  std::mt19937_64 random(1);
  std::vector<double> v(diagonal.size()), w(v.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = diagonal[i] > 0 ? static_cast<double>(random() >> 11) * 0x1p-52 - 1 : 0;
  double eigenvalue = 0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    e.apply(v, w);
    double square = 0, before = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      before += v[i] * v[i] * diagonal[i];
      w[i] /= diagonal[i] > 0 ? diagonal[i] : 1;
      square += w[i] * w[i] * diagonal[i];
    }
    eigenvalue = std::sqrt(square / before);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = w[i] / eigenvalue;
  }
  return 1.05 * eigenvalue;
}

/// The bound depends on the shape of the cells and the ends, not on how many cells there are: a uniform level is
/// represented by a small grid of the same cells.
SplineSpace representative(const SplineSpace& space) {
  constexpr int sample = 24;
  const auto brief = [&](const SplineBasis& b) {
    const auto points = b.interval().breakpoints();
    const bool uniform = points.back() - points[points.size() - 2] == b.interval().regular_cell();
    return uniform && b.interval().cells() > sample;
  };
  SplineSpace result = space;
  if (brief(space.x)) {
    result.x = SplineBasis(Interval(0, 1, sample), space.x.degree(), space.x.ends());
    result.hx = cell_length(space.x, space.hx);
  }
  if (brief(space.y)) {
    result.y = SplineBasis(Interval(0, 1, sample), space.y.degree(), space.y.ends());
    result.hy = cell_length(space.y, space.hy);
  }
  return result;
}

}  // namespace

SplineSpace finest_space(const Rectangle& region, int degree, const Normalisation& normalisation,
                         const SpaceEnds& ends) {
  if (degree < 1 || degree > SplineBasis::max_degree)
    throw InvalidInput("Hierarchy: expected degree 1 to 5, found " + std::to_string(degree));
  if (region.x.cells() < 2 || region.y.cells() < 2)
    throw InvalidInput("Hierarchy: expected at least 2 x 2 cells, found " + std::to_string(region.x.cells()) + " x " +
                       std::to_string(region.y.cells()));
  const double width = region.x.length(), height = region.y.length() * normalisation.aspect;
  const double side = std::max(width, height);
  return {SplineBasis(region.x, degree, ends.x), SplineBasis(region.y, degree, ends.y),
          width / side / region.x.finest_cells(), height / side / region.y.finest_cells()};
}

Hierarchy::Hierarchy(const Energy& energy, const Rectangle& region, int degree, const Normalisation& normalisation,
                     const SpaceEnds& ends)
    : energy_(energy), region_(region) {
  if (degree < energy.order())
    throw InvalidInput("Hierarchy: expected a degree of at least " + std::to_string(energy.order()) +
                       ", the order of the energy, found " + std::to_string(degree));
  const auto space = finest_space(region, degree, normalisation, ends);
  build(space, Operator(energy, space));
}

Hierarchy::Hierarchy(SymmetricStencil energy, const Rectangle& region, int degree, const Normalisation& normalisation,
                     const SpaceEnds& ends)
    : region_(region) {
  build(finest_space(region, degree, normalisation, ends), Operator(std::move(energy)));
}

void Hierarchy::build(SplineSpace space, Operator energy) {
  for (;;) {
    const double bound =
        energy_ ? largest_eigenvalue(Operator(*energy_, representative(space))) : largest_eigenvalue(energy);
    levels_.push_back({space, std::move(energy), bound, {}, {}});
    const auto coarsen = choose_coarsening(space);
    if (!coarsen.x && !coarsen.y) return;
    SplineSpace coarse = space;
    BandedRows rx = identity_rows(space.x.size()), ry = identity_rows(space.y.size());
    if (coarsen.x) {
      coarse.x = space.x.coarser();
      rx = coarse.x.refinement(space.x);
    }
    if (coarsen.y) {
      coarse.y = space.y.coarser();
      ry = coarse.y.refinement(space.y);
    }
    auto& level = levels_.back();
    level.refinement.emplace(std::vector<TensorSum::Term>{{1., ry, rx}});
    level.restriction.emplace(std::vector<TensorSum::Term>{{1., transposed(ry), transposed(rx)}});
    energy = energy_ ? Operator(*energy_, coarse) : Operator(level.energy.stencil()->galerkin(*level.restriction));
    space = coarse;
  }
}

}  // namespace batten
