// SPDX-License-Identifier: MIT
#include <batten/fem/null_projection.h>
#include <batten/fem/null_space.h>

#include <algorithm>

namespace batten {
namespace {

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;

ConstVector view(std::span<const double> v) { return {v.data(), static_cast<Eigen::Index>(v.size())}; }
Vector view(std::span<double> v) { return {v.data(), static_cast<Eigen::Index>(v.size())}; }

}  // namespace

NullProjection::NullProjection(const SplineSpace& space, const DataTerm& data, int degree) {
  const auto &x = space.x.interval(), &y = space.y.interval();
  const double x0 = x.lower() + x.length() / 2, y0 = y.lower() + y.length() / 2;
  std::vector<LinearFunction> functions;
  if (!data.are_slopes()) functions.push_back({1, 0, 0, x0, y0});
  if (degree >= 1) functions.insert(functions.end(), {{0, 1 / x.length(), 0, x0, y0}, {0, 0, 1 / y.length(), x0, y0}});
  std::vector<QuadraticFunction> squares;
  if (degree == 2) {
    const double length = std::max(x.length(), y.length());
    squares = {{{0, 0, 0, 1, 0, 0}, x0, y0, length}, {{0, 0, 0, 0, 1, 0}, x0, y0, length}};
    squares.push_back({{0, 0, 0, 0, 0, 1}, x0, y0, length});
  }
  const auto n = static_cast<Eigen::Index>(space.size()),
             m = static_cast<Eigen::Index>(functions.size() + squares.size());
  functions_ = products_ = Eigen::MatrixXd::Zero(n, m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const std::span<double> coefficients(functions_.col(k).data(), space.size());
    const auto f = static_cast<std::size_t>(k);
    f < functions.size() ? functions[f].add_to(space, coefficients)
                         : squares[f - functions.size()].add_to(space, coefficients);
    data.add_normal(1, coefficients, {products_.col(k).data(), space.size()});
  }
  const Eigen::MatrixXd gram = functions_.transpose() * products_;
  inverse_ = gram.completeOrthogonalDecomposition().pseudoInverse();
}

void NullProjection::project(std::span<double> c) const {
  const Eigen::VectorXd amount = inverse_ * (products_.transpose() * view(c));
  view(c) -= functions_ * amount;
}

void NullProjection::project_transposed(std::span<double> r) const {
  const Eigen::VectorXd amount = inverse_ * (functions_.transpose() * view(r));
  view(r) -= products_ * amount;
}

void NullProjection::set_component(std::span<const double> b, std::span<double> c) const {
  const Eigen::VectorXd amount = inverse_ * (functions_.transpose() * view(b) - products_.transpose() * view(c));
  view(c) += functions_ * amount;
}

}  // namespace batten
