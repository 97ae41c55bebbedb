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
    if (b.is_periodic() && (cells % 2 != 0 || cells / 2 <= 2 * b.degree())) return false;
    return cells >= least && cells / 2 + b.degree() > b.size() - b.kept();
  };
  return {can_halve(s.x) && hx < 1.5 * hy, can_halve(s.y) && hy < 1.5 * hx};
}

/// Largest eigenvalue of diag(E)^-1 E by power iteration, raised by 5 % for what the iteration has not reached.
double largest_eigenvalue(const Operator& e, const SplineSpace& space) {
  const auto diagonal = e.diagonal();
  std::mt19937_64 random(1);
  std::vector<double> v(diagonal.size()), w(v.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = diagonal[i] > 0 ? static_cast<double>(random() >> 11) * 0x1p-52 - 1 : 0;
  double eigenvalue = 0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    fill_images(space, v);
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

/// Largest eigenvalues of diag(E)^-1 E on levels of an energy with constant coefficients. They depend on the shape of
/// the cells and the ends, not on how many cells there are: a uniform level is represented by a small grid of the same
/// cells, and where all derivatives have the same order, by one of any size of cells.
class Bounds {
public:
  explicit Bounds(const Energy& energy) : energy_(energy) {
    const auto order = [](const Energy::Term& t) { return t.x_order + t.y_order; };
    const auto& terms = energy.terms();
    homogeneous_ = std::all_of(terms.begin(), terms.end(), [&](const auto& t) { return order(t) == order(terms[0]); });
  }

  double of(const SplineSpace& space) {
    if (!is_brief(space.x) || !is_brief(space.y)) return bound_of(represented(space));
    const double shape = cell_length(space.x, space.hx) / cell_length(space.y, space.hy);
    if (!homogeneous_ || known_shape_ == 0 || std::abs(shape / known_shape_ - 1) > 1e-9) {
      known_ = bound_of(represented(space));
      known_shape_ = shape;
    }
    return known_;
  }

private:
  static constexpr int sample = 24;

  /// True if a small grid can stand for this direction.
  static bool is_brief(const SplineBasis& b) { return b.interval().is_uniform() && b.interval().cells() > sample; }

  double bound_of(const SplineSpace& space) const { return largest_eigenvalue(Operator(energy_, space), space); }

  static SplineSpace represented(const SplineSpace& space) {
    SplineSpace result = space;
    if (is_brief(space.x)) {
      result.x = space.x.on(Interval(0, 1, sample), space.x.ends());
      result.hx = cell_length(space.x, space.hx);
    }
    if (is_brief(space.y)) {
      result.y = space.y.on(Interval(0, 1, sample), space.y.ends());
      result.hy = cell_length(space.y, space.hy);
    }
    return result;
  }

  const Energy& energy_;
  bool homogeneous_ = false;
  double known_shape_ = 0, known_ = 0;  // of the latest uniform level
};

/// Between periodic sides cells must stay equal, so that odd numbers of them cannot be halved.
void expect_coarse(const SplineSpace& coarsest) {
  constexpr std::size_t largest = 40'000;
  if (!coarsest.is_periodic() || coarsest.size() <= largest) return;
  throw InvalidInput(
      "Hierarchy: expected a number of cells between periodic sides that can be halved often, as 256 can; found a "
      "coarsest level of " +
      std::to_string(coarsest.x.interval().cells()) + " x " + std::to_string(coarsest.y.interval().cells()) + " cells");
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
  const SplineBasis x(region.x, degree, ends.x);
  return {x, x.on(region.y, ends.y), width / side / region.x.finest_cells(), height / side / region.y.finest_cells()};
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
  const auto space = finest_space(region, degree, normalisation, ends);
  build(space, Operator(std::move(energy), space));
}

void Hierarchy::restrict_from(int k, std::span<const double> r, std::span<double> coarse) const {
  (*this)[k].restriction->apply(r, coarse);
  fold_images((*this)[k + 1].space, coarse);
}

void Hierarchy::build(SplineSpace space, Operator energy) {
  std::optional<Bounds> bounds;
  if (energy_) bounds.emplace(*energy_);
  for (;;) {
    const double bound = bounds ? bounds->of(space) : largest_eigenvalue(energy, space);
    levels_.push_back({space, std::move(energy), bound, {}, {}});
    const auto coarsen = choose_coarsening(space);
    if (!coarsen.x && !coarsen.y) return expect_coarse(space);
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
    energy =
        energy_ ? Operator(*energy_, coarse) : Operator(level.energy.stencil()->galerkin(*level.restriction), coarse);
    space = coarse;
  }
}

}  // namespace batten
