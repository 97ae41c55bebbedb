// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/difference_form.h>
#include <batten/flows/extended_problem.h>

namespace batten {
namespace {

Eigen::Map<const Eigen::VectorXd> view(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

}  // namespace

ExtendedProblem::ExtendedProblem(const FitData& data, const Rectangle& region, const FitOptions& options,
                                 const SpaceEnds& ends, const std::vector<SideFunction>& functions)
    : data_(data), options_(options), ends_(ends), inner_(data, region, options, ends) {
  const SplineSpace whole_space = finest_space(region, options.degree, {options.aspect});
  const SplineSpace& space = inner_.hierarchy().finest().space;
  const DataTerm measured(whole_space, inner_.points());
  const auto count = static_cast<Eigen::Index>(functions.size());
  energies_ = products_ = Eigen::MatrixXd::Zero(count, count);
  for (const SideFunction& f : functions) {
    Function& g = functions_.emplace_back(Function{f, f.coefficients(whole_space), {}, {}, {}, {}});
    g.values.resize(size());
    measured.values(g.coefficients, g.values);
    g.energy.resize(space.size());
    g.column.resize(space.size());
    g.nearest.resize(space.size());
    if (f.degree() < options.energy.order()) continue;  // no energy at all
    const auto force = apply_by_differences(options.energy, whole_space, g.coefficients);
    subspace_restriction(space).apply(force, g.energy);
    fold_images(space, g.energy);
    const auto k = static_cast<Eigen::Index>(functions_.size()) - 1;
    energies_(k, k) = evaluate_energy(options.energy, whole_space, g.coefficients);
  }
}

void ExtendedProblem::set(double lambda) {
  inner_.set(lambda);
  if (lambda == lambda_) return;
  lambda_ = 0;  // until all is set: a solution may fail
  for (Function& g : functions_) {
    g.column = inner_.right_side(weight(), g.values);
    combine(lambda, g.energy, 1, g.column);
    inner_.solve(g.column, g.nearest, options_.limits, 0);
  }
  lambda_ = lambda;
  set_schur();
}

void ExtendedProblem::set_schur() {
  const auto count = static_cast<Eigen::Index>(functions_.size());
  Eigen::MatrixXd schur(count, count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index l = 0; l < count; ++l) {
      const Function &g = functions_[static_cast<std::size_t>(k)], &f = functions_[static_cast<std::size_t>(l)];
      double sum = lambda_ * energies_(k, l);
      for (std::size_t i = 0; i < size(); ++i) sum += weight()[i] * g.values[i] * f.values[i];
      products_(k, l) = sum;
      schur(k, l) = sum - (dot(g.nearest, f.column) + dot(f.nearest, g.column)) / 2;
    }
  schur_.compute(schur);
}

double ExtendedProblem::apply(std::span<const double> c, std::span<double> out) const {
  const std::size_t n = inner_.unknowns();
  const Eigen::VectorXd q = view(c.subspan(n));
  inner_.apply(c.first(n), out.first(n));
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    combine(q[static_cast<Eigen::Index>(k)], functions_[k].column, 1, out.first(n));
    out[n + k] = dot(functions_[k].column, c.first(n)) + products_.row(static_cast<Eigen::Index>(k)).dot(q);
  }
  return dot(c, out);
}

IterationResult ExtendedProblem::solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                                       double scale) const {
  const std::size_t n = inner_.unknowns();
  const auto inside = c.first(n);
  const auto b_inside = b.first(n);
  Eigen::VectorXd right = view(b.subspan(n));
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    combine(c[n + k], functions_[k].nearest, 1, inside);
    right[static_cast<Eigen::Index>(k)] -= dot(functions_[k].nearest, b_inside);
  }
  const auto result = inner_.solve(b_inside, inside, limits, scale);
  const Eigen::VectorXd q = schur_.solve(right);
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    c[n + k] = q[static_cast<Eigen::Index>(k)];
    combine(-c[n + k], functions_[k].nearest, 1, inside);
  }
  return result;
}

std::vector<double> ExtendedProblem::right_side(std::span<const double> weights, std::span<const double> values) const {
  auto b = inner_.right_side(weights, values);
  for (const Function& g : functions_) {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += weights[i] * values[i] * g.values[i];
    b.push_back(sum);
  }
  return b;
}

std::vector<double> ExtendedProblem::values(std::span<const double> c) const {
  auto result = inner_.values(c.first(inner_.unknowns()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    combine(c[inner_.unknowns() + k], functions_[k].values, 1, result);
  return result;
}

std::vector<double> ExtendedProblem::whole(std::span<const double> c) const {
  auto result = inner_.whole(c.first(inner_.unknowns()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    combine(c[inner_.unknowns() + k], functions_[k].coefficients, 1, result);
  return result;
}

std::unique_ptr<PenalisedProblem> ExtendedProblem::on(const Rectangle& grid) const {
  std::vector<SideFunction> functions;
  for (const Function& g : functions_) functions.push_back(g.polynomial);
  return std::make_unique<ExtendedProblem>(data_, grid, options_, ends_, functions);
}

}  // namespace batten
