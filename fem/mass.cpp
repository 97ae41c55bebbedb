// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/mass.h>
#include <batten/fem/side_data.h>
#include <batten/fem/varying_energy.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

TensorSum products(double factor, const SplineSpace& space) {
  return TensorSum({{factor, space.y.inner_products(0), space.x.inner_products(0)}});
}

std::variant<TensorSum, SymmetricStencil> finest_matrix(const BoundaryProblem& problem, const Field& density) {
  const auto space = finest_space(problem.region, problem.degree, {}, side_conditions(problem));
  if (!density.is_constant())
    return varying_stencil({{density, 1, {0, 0}, {0, 0}, "a density"}}, problem.region, problem.degree)
        .galerkin(subspace_restriction(space));
  const double value = density(0, 0);
  if (!(value > 0) || !std::isfinite(value))
    throw InvalidInput("Mass: expected a density > 0, found " + number_text(value, 6));
  return products(value * problem.region.x.finest_cell_length() * problem.region.y.finest_cell_length(), space);
}

}  // namespace

Mass::Mass(const BoundaryProblem& problem, const Field& density)
    : Mass(finest_space(problem.region, problem.degree, {}, side_conditions(problem)),
           finest_matrix(problem, density)) {}

Mass Mass::coarser(const Hierarchy::Level& finer, const Hierarchy::Level& coarse) const {
  if (const auto* stencil = std::get_if<SymmetricStencil>(&matrix_))
    return Mass(coarse.space, stencil->galerkin(finer.restriction.value()));
  return Mass(coarse.space, products(std::get<TensorSum>(matrix_).terms().front().factor, coarse.space));
}

void Mass::apply(std::span<const double> v, std::span<double> out) const {
  if (const auto* tensor = std::get_if<TensorSum>(&matrix_)) {
    tensor->apply(v, out);
  } else {
    std::fill(out.begin(), out.end(), 0.);
    std::get<SymmetricStencil>(matrix_).add_product(1, v, out);
  }
  fold_images(space_, out);
}

MassInverse::Factor::Factor(const SplineBasis& basis, double unit) : size(basis.size()), degree(basis.degree()) {
  const BandedRows mass = basis.inner_products(0);
  const int width = degree + 1;
  rows.assign(static_cast<std::size_t>(size * width), 0.);
  // around a circle all rows are alike
  const int middle = size / 2;
  const auto of_mass = [&](int i, int j) {
    if (basis.is_removed(i) || basis.is_removed(j)) return 0.;
    return unit * (basis.is_periodic() ? mass(middle, middle + j - i) : mass(i, j));
  };
  const auto entry = [&](int i, int j) -> double& {
    return rows[static_cast<std::size_t>(i * width + j - i + degree)];
  };
  for (int i = 0; i < size; ++i) {
    const int first = std::max(0, i - degree);
    double pivot = of_mass(i, i);
    for (int j = first; j < i; ++j) {
      double sum = of_mass(i, j);  // L_ij D_jj
      for (int k = std::max(first, j - degree); k < j; ++k) sum -= entry(i, k) * entry(j, k);
      entry(i, j) = sum;
    }
    for (int j = first; j < i; ++j) {
      const double product = entry(i, j);
      entry(i, j) *= entry(j, j);
      pivot -= product * entry(i, j);
    }
    entry(i, i) = basis.is_removed(i) ? 0 : 1 / pivot;
  }
}

void MassInverse::Factor::solve(double* b, std::ptrdiff_t stride, int lanes) const {
  const auto weights = [&](int i) { return rows.data() + static_cast<std::ptrdiff_t>(i) * (degree + 1) + degree; };
  const auto subtract = [&](double weight, int from, int to) {
    if (weight == 0) return;
    const double* in = b + from * stride;
    double* out = b + to * stride;
    for (int l = 0; l < lanes; ++l) out[l] -= weight * in[l];
  };
  for (int i = 0; i < size; ++i)
    for (int j = std::max(0, i - degree); j < i; ++j) subtract(weights(i)[j - i], j, i);
  for (int i = 0; i < size; ++i)
    for (int l = 0; l < lanes; ++l) b[i * stride + l] *= weights(i)[0];
  for (int i = size - 1; i >= 0; --i)
    for (int j = std::max(0, i - degree); j < i; ++j) subtract(weights(i)[j - i], i, j);
}

MassInverse::MassInverse(const SplineSpace& space, const Rectangle& region)
    : space_(space), x_(space.x, region.x.finest_cell_length()), y_(space.y, region.y.finest_cell_length()) {}

void MassInverse::apply(std::span<double> b) const {
  constexpr int lanes = 64;
  const std::ptrdiff_t nx = x_.size;
  for_blocks(RowBlocks(x_.size, y_.size, lanes), [&](int begin, int end) {
    for (int i = begin; i < end; i += lanes) y_.solve(b.data() + i, nx, std::min(lanes, end - i));
  });
  for_blocks(RowBlocks(y_.size, x_.size), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) x_.solve(b.data() + j * nx, 1, 1);
  });
  fill_images(space_, b);
}

}  // namespace batten
