// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/rational_elimination.h>

#include <span>
#include <vector>

namespace batten {

/// Minimise Σ_j costs[j] x_j under the equations, where x_j may have any sign for j < free_unknowns and x_j >= 0 for
/// the others. There are as many unknowns as costs.
struct LinearProgram {
  std::vector<Rational> costs;
  int free_unknowns = 0;
  std::vector<ExactEquation> equations;
};

/// A solution with a proof that it is one: prices y_i of the equations with A^T y <= costs, equality for free unknowns,
/// and the same Σ_i right_i y_i = cost, so that no other choice costs less.
struct LinearOptimum {
  std::vector<Rational> values;
  std::vector<Rational> prices;
  Rational cost;
};

/// The optimum, exact: Clp finds in doubles which unknowns are zero, the others follow from the equations in exact
/// numbers, and so do the prices. Of several optima the one that Clp meets.
///
/// Throws InvalidInput when an equation names an unknown that does not exist, SolverError when the equations contradict
/// each other, costs have no lower bound, or rounding has misled Clp: what it found is not optimal in exact numbers.
LinearOptimum optimum(const LinearProgram& program);

/// The values at which Clp ends, exact as far as the equations go: they satisfy them, while signs and optimality hold
/// up to Clp's rounding. For bounds that any choice gives. Throws as optimum() does, but not for rounding that left the
/// values short of the optimum.
std::vector<Rational> nearly_optimal_values(const LinearProgram& program);

/// Whether values satisfy the equations and signs, prices the inequalities, and both give `cost`.
bool is_proved(const LinearOptimum& found, const LinearProgram& program);

}  // namespace batten
