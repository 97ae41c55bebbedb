// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/side_data.h>
#include <batten/fem/varying_energy.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace batten {
namespace {

double longer_side(const Rectangle& region) { return std::max(region.x.length(), region.y.length()); }

/// The energy of the problem where all coefficients are constant, in the hierarchy's normalised coordinates.
std::optional<Energy> constant_energy(const BoundaryProblem& problem, const Field& mass) {
  const auto all_constant = [&](std::initializer_list<const Field*> fields) {
    return std::all_of(fields.begin(), fields.end(), [](const Field* f) { return f->is_constant(); });
  };
  const auto value = [](const Field& f) { return f(0, 0); };
  const double length = longer_side(problem.region);
  if (const auto* c = std::get_if<Conduction>(&problem.material)) {
    if (!all_constant({&c->k, &c->c, &mass})) return {};
    return Energy::conduction(value(c->k), value(c->c) + value(mass)).scaled(length);
  }
  const auto& p = std::get<KirchhoffPlate>(problem.material);
  if (!all_constant({&p.rigidity, &p.foundation, &p.tension, &mass})) return {};
  return Energy::plate({value(p.rigidity), p.poisson_ratio, value(p.tension), value(p.foundation) + value(mass)})
      .scaled(length);
}

SymmetricStencil varying_energy(const BoundaryProblem& problem, const Field& mass) {
  auto terms = energy_terms(problem);
  if (!mass.is_zero()) terms.push_back({mass, 1, {0, 0}, {0, 0}, "density", true});
  return varying_stencil(terms, problem.region, problem.degree);
}

Hierarchy hierarchy_of(const BoundaryProblem& problem, const std::optional<Energy>& constant, const Operator& whole) {
  const SpaceEnds ends = side_conditions(problem);
  if (constant) return Hierarchy(*constant, problem.region, problem.degree, {}, ends);
  const auto space = finest_space(problem.region, problem.degree, {}, ends);
  return Hierarchy(whole.stencil()->galerkin(subspace_restriction(space)), problem.region, problem.degree, {}, ends);
}

GridPoints in_cells(const BoundarySystem::Constraints& constraints, const Rectangle& region) {
  GridPoints points;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    points.x.push_back(region.x.to_cells(constraints.x[i]));
    points.y.push_back(region.y.to_cells(constraints.y[i]));
  }
  return points;
}

/// Springs so stiff that a step of the method of multipliers gains four digits: 10^4 / (b · D^-1 b), where D, the
/// smoother's diagonal, exceeds A and b holds the values of the functions at the point. Stiffer ones would turn the
/// rounding of displacements into forces.
std::vector<double> spring_weights(const Hierarchy& hierarchy, const DataTerm& data) {
  constexpr double stiffness = 1e4;
  const auto& level = hierarchy.finest();
  const auto diagonal = level.energy.diagonal();
  std::vector<double> weights;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const PointRow row = data.row(i);
    double give = 0;
    for (int b = 0; b <= hierarchy.degree(); ++b)
      for (int a = 0; a <= hierarchy.degree(); ++a) {
        const double value = row.x[static_cast<std::size_t>(a)] * row.y[static_cast<std::size_t>(b)];
        const auto k = level.space.original(row.first_x + a, row.first_y + b);
        if (value != 0) give += value * value / (level.bound * diagonal[k]);
      }
    if (!(give > 0))
      throw InvalidInput("solve_boundary_problem: expected supports away from sides that are fixed already");
    weights.push_back(stiffness / give);
  }
  return weights;
}

}  // namespace

BoundarySystem::BoundarySystem(const BoundaryProblem& problem, const Field& mass, const Constraints& constraints)
    : whole_space_(finest_space(problem.region, problem.degree)),
      constant_energy_(constant_energy(problem, mass)),
      whole_energy_(constant_energy_ ? Operator(*constant_energy_, whole_space_)
                                     : Operator(varying_energy(problem, mass), whole_space_)),
      hierarchy_(hierarchy_of(problem, constant_energy_, whole_energy_)),
      points_(in_cells(constraints, problem.region)),
      order_(cell_order(points_, space())),
      multigrid_((points_ = {reordered(points_.x, order_), reordered(points_.y, order_)}, hierarchy_), points_) {
  multigrid_.set(1, spring_weights(hierarchy_, multigrid_.data()));
}

std::vector<double> BoundarySystem::apply(std::span<const double> v) const {
  std::vector<double> result(v.size());
  hierarchy_.finest().energy.apply(v, result);
  return result;
}

std::vector<double> BoundarySystem::apply_whole(std::span<const double> whole, std::vector<double> memory) const {
  if (constant_energy_) return apply_by_differences(*constant_energy_, whole_space_, whole, std::move(memory));
  std::vector<double> result = std::move(memory);
  result.resize(whole.size());
  whole_energy_.apply(whole, result);
  return result;
}

std::vector<double> BoundarySystem::restricted(std::span<const double> whole, std::vector<double> memory) const {
  std::vector<double> result = std::move(memory);
  result.resize(whole.size());
  subspace_restriction(space()).apply(whole, result);
  fold_images(space(), result);
  return result;
}

std::vector<double> BoundarySystem::whole(std::span<const double> v) const {
  std::vector<double> result(v.begin(), v.end());
  to_unconstrained(space(), result);
  return result;
}

Operator whole_energy(const BoundaryProblem& problem) {
  if (const auto energy = constant_energy(problem, 0))
    return Operator(*energy, finest_space(problem.region, problem.degree));
  return Operator(varying_energy(problem, 0), finest_space(problem.region, problem.degree));
}

Operator restricted_energy(const BoundaryProblem& problem, const Operator& whole) {
  const auto space = finest_space(problem.region, problem.degree, {}, side_conditions(problem));
  if (const auto* stencil = whole.stencil()) return Operator(stencil->galerkin(subspace_restriction(space)), space);
  return Operator(constant_energy(problem, 0).value(), space);
}

}  // namespace batten
