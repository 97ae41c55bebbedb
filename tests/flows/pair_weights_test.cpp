// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/flows/coupled_problem.h>
#include <batten/flows/extended_problem.h>
#include <batten/flows/flow_data.h>

#include "../support/observations.h"
#include "../support/pairs.h"
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace batten {
namespace {

using Vector = std::vector<double>;

VectorObservations random_vectors(std::size_t count, const Rectangle& region) {
  test::Random random(3);
  VectorObservations o;
  for (std::size_t i = 0; i < count; ++i) {
    o.x.push_back(region.x.lower() + region.x.length() * random());
    o.y.push_back(region.y.lower() + region.y.length() * random());
    o.u.push_back(random());
    o.v.push_back(random());
  }
  return o;
}

Vector random_forces(std::size_t count, unsigned seed) {
  test::Random random(seed);
  Vector v(count);
  for (double& f : v) f = random.normal();
  return v;
}

/// The problem that fit_flow solves.
struct Flow {
  FlowOptions options;
  FlowData data;
  std::unique_ptr<PenalisedProblem> problem;

  Flow(FlowModel model, const FlowSides& sides, std::size_t vectors, int cells)
      : Flow({.model = model, .ratio = 2, .sides = sides}, test::unit_square(cells, cells), vectors) {}
  Flow(FlowOptions of, const Rectangle& region, std::size_t vectors) : options(std::move(of)) {
    const FlowSides& sides = options.sides;
    data = prepare_flow(random_vectors(vectors, region), region, options, false);
    FitOptions scalar;
    scalar.energy = energy_of(options.model);
    scalar.aspect = geometry_of(options).aspect(region);
    std::vector<ExtraFunction> functions;
    if (options.model == FlowModel::General) {
      auto both = std::make_unique<CoupledProblem>(data, region, scalar, options);
      for (const bool is_potential : {false, true})
        for (const SideFunction& f : side_functions(sides, {is_potential, true}))
          functions.push_back(both->extra_function(f, is_potential));
      problem = std::move(both);
    } else {
      const FlowPart part{options.model == FlowModel::Irrotational, false};
      auto one = std::make_unique<FitProblem>(data.rows, region, scalar, side_conditions(sides, part));
      for (const SideFunction& f : side_functions(sides, part)) functions.push_back(extra_function(f, *one));
      problem = std::move(one);
    }
    if (!functions.empty())
      problem = std::make_unique<ExtendedProblem>(std::move(problem), std::move(functions), options.limits, nullptr);
  }

  /// Coefficients that keep the conditions at the sides: a few steps of a solution with scalar weights.
  Vector coefficients(unsigned seed) const {
    problem->set(1e-9);
    const Vector ones(problem->size(), 1.);
    Vector c(problem->unknowns());
    problem->solve(problem->right_side(ones, random_forces(problem->size(), seed)), c, {.most_iterations = 4}, 0);
    return c;
  }
};

const std::vector<FlowModel> models = {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational, FlowModel::General};

/// Free; a channel, whose flux is an unknown of its own; periodic, with a mean flow; both; without slip.
std::vector<FlowSides> sides_of(FlowModel model) {
  using enum FlowSide;
  std::vector<FlowSides> result = {
      {}, {Free, Free, Wall, Wall}, {Periodic, Periodic, Free, Free}, {Periodic, Periodic, Wall, Wall}};
  if (model != FlowModel::Irrotational) result.push_back({Free, Free, NoSlip, Wall});
  return result;
}

PairWeights pairs_for(const Flow& flow, double decades) {
  const std::size_t pairs = flow.problem->size() / 2;
  return test::random_pairs(pairs, 0.5 / static_cast<double>(pairs), decades, 17);
}

// a · A b = λ a · E b + (B a) · W (B b)
void expect_its_matrix(const Flow& flow) {
  constexpr double lambda = 1e-7;
  const Vector a = flow.coefficients(1), b = flow.coefficients(2);
  const PairWeights weights = pairs_for(flow, 6);
  flow.problem->set(lambda, weights.diagonal, weights.beside);
  Vector image(a.size()), energy(a.size());
  const double own_a = flow.problem->apply(a, image), own_b = flow.problem->apply(b, image);
  flow.problem->apply_energy(b, energy);
  const Vector at_a = flow.problem->values(a), at_b = flow.problem->values(b);
  double expected = lambda * dot(a, energy);
  for (std::size_t k = 0; k < weights.beside.size(); ++k) {
    const std::size_t i = 2 * k, j = i + 1;
    expected += weights.diagonal[i] * at_a[i] * at_b[i] + weights.diagonal[j] * at_a[j] * at_b[j] +
                weights.beside[k] * (at_a[i] * at_b[j] + at_a[j] * at_b[i]);
  }
  // ψ and φ cancel in the rows to a few digits, A adds their parts one by one
  EXPECT_NEAR(dot(a, image), expected, 1e-9 * std::sqrt(own_a * own_b));
}

/// The error of the solution for A c, in the norm of A relative to c.
double error_of_solution(const Flow& flow, const Vector& c, const IterationLimits& limits) {
  Vector right(c.size()), found(c.size()), image(c.size());
  const double size = flow.problem->apply(c, right);
  const auto result = flow.problem->solve(right, found, limits, 0);
  EXPECT_LT(result.iterations, limits.most_iterations);
  for (std::size_t i = 0; i < c.size(); ++i) found[i] -= c[i];
  return std::sqrt(std::abs(flow.problem->apply(found, image)) / size);
}

// Few vectors are applied one by one, many are kept in stencils.
TEST(PairWeights, give_the_matrix_of_a_flow) {
  for (const FlowModel model : models)
    for (const FlowSides& sides : sides_of(model))
      for (const std::size_t vectors : {60, 600}) {
        SCOPED_TRACE("model " + std::to_string(static_cast<int>(model)) + ", " + std::to_string(vectors) + " vectors");
        expect_its_matrix(Flow(model, sides, vectors, 16));
      }
}

// Where ψ and φ have different parts in the rows: from 40 to 68 degrees they differ by up to twice.
TEST(PairWeights, give_the_matrix_of_a_flow_on_the_sphere) {
  const Rectangle region{Interval(0, 30, 16), Interval(40, 68, 14)};
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::General})
    for (const std::size_t vectors : {60, 600}) {
      const Flow flow({.model = model, .geographic = true}, region, vectors);
      expect_its_matrix(flow);
      const PairWeights weights = pairs_for(flow, 3);
      const Vector c = flow.coefficients(1);
      flow.problem->set(1e-6, weights.diagonal, weights.beside);
      EXPECT_LT(error_of_solution(flow, c, {.accuracy = 1e-8, .most_iterations = 100}), 1e-6);
    }
}

// Beside a λ of 1e-13 and weights of 1e6 the energy is lost in the rounding of the data's part, whatever its form.
TEST(PairWeights, are_solved_for_in_every_flow) {
  for (const FlowModel model : models)
    for (const FlowSides& sides : sides_of(model))
      for (const std::size_t vectors : {60, 600}) {
        const Flow flow(model, sides, vectors, 16);
        const Vector c = flow.coefficients(1);
        for (const auto& [lambda, decades] : {std::pair{1e-3, 6.}, {1e-8, 6.}, {1e-13, 1.}}) {
          const PairWeights weights = pairs_for(flow, decades);
          flow.problem->set(lambda, weights.diagonal, weights.beside);
          EXPECT_LT(error_of_solution(flow, c, {.accuracy = 1e-8, .most_iterations = 100}), 1e-6)
              << "model " << static_cast<int>(model) << ", " << vectors << " vectors, lambda " << lambda;
        }
      }
}

/// The eigenvalues of the blocks alone, as weights along the axes.
Vector turned_back(const PairWeights& weights) {
  Vector result;
  for (std::size_t k = 0; k < weights.beside.size(); ++k) {
    const double a = weights.diagonal[2 * k], b = weights.diagonal[2 * k + 1];
    const double half = std::hypot((a - b) / 2, weights.beside[k]), larger = (a + b) / 2 + half;
    result.insert(result.end(), {larger, (a * b - weights.beside[k] * weights.beside[k]) / larger});
  }
  return result;
}

// One half more and three are what other directions of the same weights may cost.
TEST(PairWeights, need_as_many_iterations_as_weights_along_the_axes) {
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::General})
    for (const std::size_t vectors : {100, 1500}) {
      const Flow flow(model, {}, vectors, 48);
      const Vector ones(flow.problem->size(), 1.);
      const auto right = flow.problem->right_side(ones, random_forces(flow.problem->size(), 5));
      const auto iterations = [&] {
        Vector c(flow.problem->unknowns());
        return flow.problem->solve(right, c, {.accuracy = 1e-8}, 0).iterations;
      };
      for (const double lambda : {1e-3, 1e-7}) {
        const PairWeights weights = pairs_for(flow, 3);
        flow.problem->set(lambda, turned_back(weights));
        const int along = iterations();
        flow.problem->set(lambda, weights.diagonal, weights.beside);
        EXPECT_LE(iterations(), 1.5 * along + 3) << "model " << static_cast<int>(model) << ", lambda " << lambda;
      }
    }
}

}  // namespace
}  // namespace batten
