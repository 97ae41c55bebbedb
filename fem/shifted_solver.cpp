// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/shifted_solver.h>

#include <algorithm>

namespace batten {
namespace {

constexpr Eigen::Index memory = 6;

using Column = Eigen::Map<Eigen::MatrixXd>;
using ConstColumn = Eigen::Map<const Eigen::MatrixXd>;

ConstColumn view(std::span<const double> v) { return {v.data(), static_cast<Eigen::Index>(v.size()), 1}; }

}  // namespace

ShiftedSolver::ShiftedSolver(const BoundaryProblem& problem, const Field& mass,
                             const BoundarySystem::Constraints& constraints, const IterationLimits& limits)
    : system_(problem, mass, constraints),
      projection_(system_),
      limits_(limits),
      gradients_({[this](std::span<const double> v, std::span<double> out) {
                    system_.hierarchy().finest().energy.apply(v, out);
                  },
                  [this](std::vector<double>& r, std::vector<double>& z) {
                    projection_.project_transposed(r);
                    system_.multigrid().precondition(r, z);
                    projection_.project(z);
                  }}),
      s_(system_.space().size()),
      solutions_(static_cast<Eigen::Index>(s_.size()), memory),
      products_(static_cast<Eigen::Index>(s_.size()), memory) {}

void ShiftedSolver::start(std::span<const double> b) {
  std::fill(s_.begin(), s_.end(), 0.);
  if (kept_ == 0) return;
  const auto s = solutions_.leftCols(kept_), ks = products_.leftCols(kept_);
  const Eigen::MatrixXd gram = tall_products(s, ks), t = orthonormalisation((gram + gram.transpose()) / 2);
  Column out(s_.data(), static_cast<Eigen::Index>(s_.size()), 1);
  subtract_product(out, s, -t * (t.transpose() * tall_products(s, view(b))));
}

void ShiftedSolver::remember(std::span<const double> b) {
  const auto& r = gradients_.residual();
  solutions_.col(next_) = view(s_);
  products_.col(next_) = view(b) - view(r);
  next_ = (next_ + 1) % memory;
  kept_ = std::min(kept_ + 1, memory);
}

std::span<const double> ShiftedSolver::solve(std::span<const double> b, double scale) {
  start(b);
  cycles_ += gradients_.solve(b, s_, limits_, scale).iterations;
  remember(b);
  return s_;
}

std::span<const double> ShiftedSolver::balanced(std::span<const double> b) {
  const double work = dot(s_, b), energy = work - dot(s_, gradients_.residual());  // s·b, s·K s
  if (energy > 0)
    for (double& v : s_) v *= work / energy;
  return s_;
}

}  // namespace batten
