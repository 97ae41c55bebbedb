// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/difference_form.h>
#include <batten/flows/extended_problem.h>

#include <algorithm>
#include <utility>

namespace batten {
namespace {

Eigen::Map<const Eigen::VectorXd> view(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

}  // namespace

ExtraFunction extra_function(const SideFunction& function, const FitProblem& problem) {
  const SplineSpace whole_space = problem.whole_space(), &space = problem.hierarchy().finest().space;
  const Energy& energy = problem.hierarchy().energy();
  ExtraFunction g{function.coefficients(whole_space), std::vector<double>(problem.size()),
                  std::vector<double>(space.size()), 0};
  DataTerm(whole_space, problem.points()).values(g.coefficients, g.values);
  if (function.degree() < energy.order()) return g;  // no energy at all
  const auto force = apply_by_differences(energy, whole_space, g.coefficients);
  subspace_restriction(space).apply(force, g.energy);
  fold_images(space, g.energy);
  g.own_energy = evaluate_energy(energy, whole_space, g.coefficients);
  return g;
}

ExtendedProblem::ExtendedProblem(std::unique_ptr<PenalisedProblem> inner, std::vector<ExtraFunction> functions,
                                 const IterationLimits& limits, Remake remake)
    : inner_(std::move(inner)), limits_(limits), remake_(std::move(remake)) {
  for (ExtraFunction& g : functions)
    functions_.push_back({std::move(g), {}, {}, std::vector<double>(inner_->unknowns())});
}

void ExtendedProblem::set(double lambda, std::span<const double> weights, std::span<const double> beside) {
  inner_->set(lambda, weights, beside);
  PairWeights w(weights, beside);
  if (lambda == lambda_ && w == weights_) return;
  lambda_ = 0;  // until all is set: a solution may fail
  const std::vector<double> ones(beside.empty() ? 0 : size(), 1.);
  for (Function& g : functions_) {
    g.weighted = g.values;
    w.multiply(g.weighted);
    g.column = beside.empty() ? inner_->right_side(weights, g.values) : inner_->right_side(ones, g.weighted);
    combine(lambda, g.energy, 1, g.column);
    inner_->solve(g.column, g.nearest, limits_, 0);
  }
  lambda_ = lambda;
  weights_ = std::move(w);
  set_schur();
}

void ExtendedProblem::set_schur() {
  const auto count = static_cast<Eigen::Index>(functions_.size());
  Eigen::MatrixXd schur(count, count);
  products_.resize(count, count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index l = 0; l < count; ++l) {
      const Function &g = functions_[static_cast<std::size_t>(k)], &f = functions_[static_cast<std::size_t>(l)];
      double sum = k == l ? lambda_ * g.own_energy : 0;
      for (std::size_t i = 0; i < size(); ++i) sum += g.weighted[i] * f.values[i];
      products_(k, l) = sum;
      schur(k, l) = sum - (dot(g.nearest, f.column) + dot(f.nearest, g.column)) / 2;
    }
  schur_.compute(schur);
}

double ExtendedProblem::apply(std::span<const double> c, std::span<double> out) const {
  const std::size_t n = inner_->unknowns();
  const Eigen::VectorXd q = view(c.subspan(n));
  inner_->apply(c.first(n), out.first(n));
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    combine(q[static_cast<Eigen::Index>(k)], functions_[k].column, 1, out.first(n));
    out[n + k] = dot(functions_[k].column, c.first(n)) + products_.row(static_cast<Eigen::Index>(k)).dot(q);
  }
  return dot(c, out);
}

void ExtendedProblem::apply_energy(std::span<const double> c, std::span<double> out) const {
  const std::size_t n = inner_->unknowns();
  inner_->apply_energy(c.first(n), out.first(n));
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const Function& g = functions_[k];
    combine(c[n + k], g.energy, 1, out.first(n));
    out[n + k] = dot(g.energy, c.first(n)) + g.own_energy * c[n + k];
  }
}

IterationResult ExtendedProblem::solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                                       double scale) const {
  const std::size_t n = inner_->unknowns();
  const auto inside = c.first(n);
  const auto b_inside = b.first(n);
  Eigen::VectorXd right = view(b.subspan(n));
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    combine(c[n + k], functions_[k].nearest, 1, inside);
    right[static_cast<Eigen::Index>(k)] -= dot(functions_[k].nearest, b_inside);
  }
  const auto result = inner_->solve(b_inside, inside, limits, scale);
  const Eigen::VectorXd q = schur_.solve(right);
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    c[n + k] = q[static_cast<Eigen::Index>(k)];
    combine(-c[n + k], functions_[k].nearest, 1, inside);
  }
  return result;
}

std::vector<double> ExtendedProblem::right_side(std::span<const double> weights, std::span<const double> values) const {
  auto b = inner_->right_side(weights, values);
  for (const Function& g : functions_) {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += weights[i] * values[i] * g.values[i];
    b.push_back(sum);
  }
  return b;
}

std::vector<double> ExtendedProblem::values(std::span<const double> c) const {
  auto result = inner_->values(c.first(inner_->unknowns()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    combine(c[inner_->unknowns() + k], functions_[k].values, 1, result);
  return result;
}

std::vector<double> ExtendedProblem::whole(std::span<const double> c) const {
  auto result = inner_->whole(c.first(inner_->unknowns()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    combine(c[inner_->unknowns() + k], functions_[k].coefficients, 1, result);
  return result;
}

}  // namespace batten
