// SPDX-License-Identifier: MIT
#include <batten/bases/exact_linear_program.h>
#include <batten/domains/errors.h>

#include <Clp_C_Interface.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace batten {
namespace {

constexpr int basic_status = 1;  // of Clp_getColumnStatus

int unknowns_of(const LinearProgram& program) { return static_cast<int>(program.costs.size()); }
int equations_of(const LinearProgram& program) { return static_cast<int>(program.equations.size()); }

/// A column of the equations: factors by equation.
using Column = std::vector<std::pair<int, Rational>>;

std::vector<Column> columns_of(const LinearProgram& program) {
  std::vector<Column> columns(program.costs.size());
  for (int i = 0; i < equations_of(program); ++i)
    for (const auto& [unknown, factor] : program.equations[static_cast<std::size_t>(i)].terms) {
      if (unknown < 0 || unknown >= unknowns_of(program))
        throw InvalidInput("optimum: unknowns are numbered 0 .. " + std::to_string(unknowns_of(program) - 1) +
                           ", found " + std::to_string(unknown));
      auto& column = columns[static_cast<std::size_t>(unknown)];
      if (!column.empty() && column.back().first == i)
        column.back().second += factor;
      else
        column.emplace_back(i, factor);
    }
  return columns;
}

/// The program in doubles.
class ClpModel {
public:
  ClpModel(const LinearProgram& program, const std::vector<Column>& columns) : model_(Clp_newModel()) {
    std::vector<CoinBigIndex> starts{0};
    std::vector<int> rows;
    std::vector<double> factors, costs, lower, right;
    for (const Column& column : columns) {
      for (const auto& [row, factor] : column) {
        rows.push_back(row);
        factors.push_back(factor.convert_to<double>());
      }
      starts.push_back(static_cast<CoinBigIndex>(rows.size()));
      const bool is_free = static_cast<int>(lower.size()) < program.free_unknowns;
      lower.push_back(is_free ? -std::numeric_limits<double>::max() : 0);
    }
    for (const Rational& cost : program.costs) costs.push_back(cost.convert_to<double>());
    for (const ExactEquation& equation : program.equations) right.push_back(equation.right.convert_to<double>());
    Clp_setLogLevel(model_.get(), 0);
    Clp_setPrimalTolerance(model_.get(), tolerance);
    Clp_setDualTolerance(model_.get(), tolerance);
    Clp_loadProblem(model_.get(), unknowns_of(program), equations_of(program), starts.data(), rows.data(),
                    factors.data(), lower.data(), nullptr, costs.data(), right.data(), right.data());
  }

  void solve() {
    Clp_initialSolve(model_.get());
    const int status = Clp_status(model_.get());
    if (status == 1) throw SolverError("optimum: no choice of the unknowns satisfies all equations and signs");
    if (status == 2) throw SolverError("optimum: the costs must have a lower bound, found none");
    if (status != 0) throw SolverError("optimum: Clp found no optimum, its status is " + std::to_string(status));
  }

  bool is_basic(int unknown) const { return Clp_getColumnStatus(model_.get(), unknown) == basic_status; }
  /// The equation's own unknown, 0 by right, is among the basic ones: the equation follows from others.
  bool is_basic_equation(int i) const { return Clp_getRowStatus(model_.get(), i) == basic_status; }

private:
  static constexpr double tolerance = 1e-12;  // 1e-10 leaves masks of order 3 and size 33 short of the optimum
  struct Delete {
    void operator()(Clp_Simplex* model) const { Clp_deleteModel(model); }
  };
  std::unique_ptr<Clp_Simplex, Delete> model_;
};

/// Basic unknowns, numbered in their order; those of equations come last.
struct Basis {
  std::vector<int> unknowns, equations;
  int size() const { return static_cast<int>(unknowns.size() + equations.size()); }
};

/// The basis of the optimum in doubles.
Basis final_basis(const LinearProgram& program, const std::vector<Column>& columns) {
  ClpModel model(program, columns);
  model.solve();
  Basis basis;
  for (int j = 0; j < unknowns_of(program); ++j)
    if (model.is_basic(j)) basis.unknowns.push_back(j);
  for (int i = 0; i < equations_of(program); ++i)
    if (model.is_basic_equation(i)) basis.equations.push_back(i);
  return basis;
}

/// x with B x = right, zero for unknowns that are not basic; nothing when B is singular or an equation's own unknown is
/// not zero.
std::optional<std::vector<Rational>> basic_values(const LinearProgram& program, const std::vector<Column>& columns,
                                                  const Basis& basis) {
  std::vector<ExactEquation> equations(program.equations.size());
  for (std::size_t i = 0; i < equations.size(); ++i) equations[i].right = program.equations[i].right;
  int place = 0;
  for (int j : basis.unknowns) {
    for (const auto& [row, factor] : columns[static_cast<std::size_t>(j)])
      equations[static_cast<std::size_t>(row)].terms.emplace_back(place, factor);
    ++place;
  }
  for (int i : basis.equations) equations[static_cast<std::size_t>(i)].terms.emplace_back(place++, Rational(1));
  const auto solution = unique_solution(equations, basis.size());
  if (!solution) return std::nullopt;
  std::vector<Rational> values(program.costs.size());
  for (std::size_t k = 0; k < solution->size(); ++k)
    if (k < basis.unknowns.size())
      values[static_cast<std::size_t>(basis.unknowns[k])] = (*solution)[k];
    else if ((*solution)[k] != 0)
      return std::nullopt;
  return values;
}

/// y with B^T y = the costs of the basic unknowns.
std::optional<std::vector<Rational>> basic_prices(const LinearProgram& program, const std::vector<Column>& columns,
                                                  const Basis& basis) {
  std::vector<ExactEquation> equations;
  for (int j : basis.unknowns)
    equations.push_back({columns[static_cast<std::size_t>(j)], program.costs[static_cast<std::size_t>(j)]});
  for (int i : basis.equations) equations.push_back({{{i, Rational(1)}}, 0});
  return unique_solution(equations, equations_of(program));
}

Rational cost_of(const LinearProgram& program, const std::vector<Rational>& values) {
  Rational cost = 0;
  for (std::size_t j = 0; j < values.size(); ++j)
    if (values[j] != 0) cost += program.costs[j] * values[j];
  return cost;
}

bool satisfies_equations(const LinearProgram& program, const std::vector<Rational>& values) {
  for (const ExactEquation& equation : program.equations) {
    Rational left = 0;
    for (const auto& [unknown, factor] : equation.terms) left += factor * values[static_cast<std::size_t>(unknown)];
    if (left != equation.right) return false;
  }
  for (std::size_t j = static_cast<std::size_t>(program.free_unknowns); j < values.size(); ++j)
    if (values[j] < 0) return false;
  return true;
}

bool respects_costs(const LinearProgram& program, const std::vector<Rational>& prices) {
  const auto columns = columns_of(program);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    Rational price = 0;
    for (const auto& [row, factor] : columns[j]) price += factor * prices[static_cast<std::size_t>(row)];
    if (price > program.costs[j]) return false;
    if (static_cast<int>(j) < program.free_unknowns && price != program.costs[j]) return false;
  }
  return true;
}

}  // namespace

bool is_proved(const LinearOptimum& found, const LinearProgram& program) {
  Rational bound = 0;
  for (std::size_t i = 0; i < program.equations.size(); ++i) bound += program.equations[i].right * found.prices[i];
  return bound == found.cost && cost_of(program, found.values) == found.cost &&
         satisfies_equations(program, found.values) && respects_costs(program, found.prices);
}

std::vector<Rational> nearly_optimal_values(const LinearProgram& program) {
  const auto columns = columns_of(program);
  const auto values = basic_values(program, columns, final_basis(program, columns));
  if (!values) throw SolverError("optimum: the basis that Clp found is singular in exact numbers");
  return *values;
}

LinearOptimum optimum(const LinearProgram& program) {
  const auto columns = columns_of(program);
  const Basis basis = final_basis(program, columns);
  const auto values = basic_values(program, columns, basis);
  const auto prices = basic_prices(program, columns, basis);
  if (!values || !prices) throw SolverError("optimum: the basis that Clp found is singular in exact numbers");
  const LinearOptimum found{*values, *prices, cost_of(program, *values)};
  if (!is_proved(found, program))
    throw SolverError("optimum: the basis that Clp found is not optimal in exact numbers");
  return found;
}

}  // namespace batten
