// SPDX-License-Identifier: MIT
#include <batten/bases/exact_linear_program.h>
#include <batten/bases/index_box.h>
#include <batten/bases/optimal_mask.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <array>

namespace batten {
namespace {

/// The residual as a linear function of the unknowns of a family: Σ factor · unknown - right, one for each orbit of its
/// indices.
struct ResidualEquations {
  MaskFamily masks, residuals;
  std::vector<ExactEquation> equations;
};

/// Coefficient k of l[x,y] s[x,y] for the s of a family.
std::vector<std::pair<int, Rational>> product_terms(const Mask2<Rational>& l, const MaskFamily& masks,
                                                    const Index<2>& k) {
  std::vector<std::pair<int, Rational>> terms;
  for (const Index<2>& i : indices_of<2>({l.first(), l.last()}))
    if (const auto unknown = masks.unknown_at({k[0] - i[0], k[1] - i[1]}); unknown && l[i] != 0)
      terms.emplace_back(*unknown, l[i]);
  return terms;
}

ResidualEquations residual_equations(int order, int size, const MaskConstraints& constraints) {
  const auto l = power(five_point_laplacian(), order);
  const auto goal = residual(Mask2<Rational>{}, order);  // -4^(1-m) l^m[x²,y²]
  const int width = std::max(size + 2 * order, 4 * order + 1);
  ResidualEquations result{
      MaskFamily(size, constraints.symmetry, constraints.shape, 3), MaskFamily(width, constraints.symmetry), {}};
  for (int u = 0; u < result.residuals.unknowns(); ++u) {
    const Index<2> k = result.residuals.orbit(u).front();
    result.equations.push_back({product_terms(l, result.masks, k), -goal[k]});
  }
  return result;
}

std::size_t parity_class(const Index<2>& i) { return static_cast<std::size_t>((i[0] & 1) + 2 * (i[1] & 1)); }

/// The unknowns: those of the mask, the bound t; then positive and negative part of each residual, what each of the
/// four sums lacks to t.
LinearProgram minimax_program(const ResidualEquations& system, const std::vector<NamedEquation>& constraints) {
  const int t = system.masks.unknowns(), residuals = system.residuals.unknowns(), parts = t + 1;
  LinearProgram program;
  program.free_unknowns = parts;
  program.costs.resize(static_cast<std::size_t>(parts + 2 * residuals + 4));
  program.costs[static_cast<std::size_t>(t)] = 1;
  std::array<ExactEquation, 4> sums;
  for (int u = 0; u < residuals; ++u) {
    const int positive = parts + 2 * u, negative = positive + 1;
    ExactEquation& equation = program.equations.emplace_back(system.equations[static_cast<std::size_t>(u)]);
    equation.terms.emplace_back(positive, Rational(-1));
    equation.terms.emplace_back(negative, Rational(1));
    std::array<int, 4> members{};
    for (const Index<2>& i : system.residuals.orbit(u)) ++members[parity_class(i)];
    for (std::size_t c = 0; c < 4; ++c) {
      if (members[c] == 0) continue;
      for (int part : {positive, negative}) sums[c].terms.emplace_back(part, Rational(members[c]));
    }
  }
  for (int c = 0; c < 4; ++c) {
    ExactEquation& sum = program.equations.emplace_back(std::move(sums[static_cast<std::size_t>(c)]));
    sum.terms.emplace_back(t, Rational(-1));
    sum.terms.emplace_back(parts + 2 * residuals + c, Rational(1));
  }
  for (const NamedEquation& constraint : constraints) program.equations.push_back(constraint.equation);
  return program;
}

/// 2 A^T W (A s - b) + C^T μ = 0 and C s = d: W counts the members of the orbits, C and d are the constraints.
std::vector<ExactEquation> normal_equations(const ResidualEquations& system,
                                            const std::vector<NamedEquation>& constraints) {
  const int unknowns = system.masks.unknowns();
  std::vector<ExactEquation> normal(static_cast<std::size_t>(unknowns));
  for (int u = 0; u < system.residuals.unknowns(); ++u) {
    const ExactEquation& row = system.equations[static_cast<std::size_t>(u)];
    const Rational weight = static_cast<int>(2 * system.residuals.orbit(u).size());
    for (const auto& [i, a] : row.terms) {
      ExactEquation& equation = normal[static_cast<std::size_t>(i)];
      for (const auto& [j, b] : row.terms) equation.terms.emplace_back(j, weight * a * b);
      equation.right += weight * a * row.right;
    }
  }
  int multiplier = unknowns;
  for (const NamedEquation& constraint : constraints) {
    for (const auto& [i, c] : constraint.equation.terms)
      normal[static_cast<std::size_t>(i)].terms.emplace_back(multiplier, c);
    normal.push_back(constraint.equation);
    ++multiplier;
  }
  return normal;
}

}  // namespace

OptimalMask optimal_mask(int order, int size, const MaskConstraints& constraints) {
  require_order("optimal_mask", order);
  const auto system = residual_equations(order, size, constraints);
  const auto found = optimum(minimax_program(system, independent_equations(system.masks, constraints)));
  const auto unknowns = static_cast<std::size_t>(system.masks.unknowns());
  return {system.masks.mask(std::span(found.values).first(unknowns)), found.cost};
}

Mask2<Rational> least_squares_mask(int order, int size, const MaskConstraints& constraints) {
  require_order("least_squares_mask", order);
  const auto system = residual_equations(order, size, constraints);
  const auto equations = normal_equations(system, independent_equations(system.masks, constraints));
  const auto solution = unique_solution(equations, static_cast<int>(equations.size()));
  if (!solution) throw SolverError("least_squares_mask: the normal equations are singular");
  return system.masks.mask(std::span(*solution).first(static_cast<std::size_t>(system.masks.unknowns())));
}

}  // namespace batten
