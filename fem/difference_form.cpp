// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/difference_form.h>

#include <utility>

namespace batten {
namespace {

using Vector = std::vector<double>;

struct Grid {
  int columns = 0, rows = 0;
  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

/// Calls work(j) for all rows of the grid.
template <typename Work>
void for_rows(const Grid& grid, Work&& work) {
  for_blocks(RowBlocks(grid.rows, grid.columns), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) work(static_cast<std::ptrdiff_t>(j));
  });
}

Vector x_differences(const Vector& c, Grid from, const Vector& slope) {
  const Grid to{from.columns - 1, from.rows};
  Vector result(to.size());
  for_rows(to, [&](std::ptrdiff_t j) {
    const double* in = c.data() + j * from.columns;
    double* out = result.data() + j * to.columns;
    for (int i = 0; i < to.columns; ++i) out[i] = slope[static_cast<std::size_t>(i)] * (in[i + 1] - in[i]);
  });
  return result;
}

Vector y_differences(const Vector& c, Grid from, const Vector& slope) {
  const Grid to{from.columns, from.rows - 1};
  Vector result(to.size());
  for_rows(to, [&](std::ptrdiff_t j) {
    const double* in = c.data() + j * from.columns;
    double* out = result.data() + j * to.columns;
    for (int i = 0; i < to.columns; ++i) out[i] = slope[static_cast<std::size_t>(j)] * (in[i + from.columns] - in[i]);
  });
  return result;
}

/// The transposed differences: out_i = slope_{i-1} g_{i-1} - slope_i g_i.
Vector x_differences_transposed(const Vector& g, Grid from, const Vector& slope) {
  const Grid to{from.columns + 1, from.rows};
  Vector result(to.size());
  for_rows(to, [&](std::ptrdiff_t j) {
    const double* in = g.data() + j * from.columns;
    double* out = result.data() + j * to.columns;
    const auto weighted = [&](int i) {
      return i < 0 || i >= from.columns ? 0. : slope[static_cast<std::size_t>(i)] * in[i];
    };
    for (int i = 0; i < to.columns; ++i) out[i] = weighted(i - 1) - weighted(i);
  });
  return result;
}

Vector y_differences_transposed(const Vector& g, Grid from, const Vector& slope) {
  const Grid to{from.columns, from.rows + 1};
  Vector result(to.size());
  for_rows(to, [&](std::ptrdiff_t j) {
    double* out = result.data() + j * to.columns;
    for (const std::ptrdiff_t k : {j - 1, j}) {
      if (k < 0 || k >= from.rows) continue;
      const double factor = (k < j ? 1 : -1) * slope[static_cast<std::size_t>(k)];
      const double* in = g.data() + k * from.columns;
      for (int i = 0; i < to.columns; ++i) out[i] += factor * in[i];
    }
  });
  return result;
}

TensorSum mass(const SplineSpace& space, int a, int b) {
  return TensorSum({{1., lowered(space.y, b).inner_products(0), lowered(space.x, a).inner_products(0)}});
}

/// D^T g for g of the shape that `differentiated` gives.
Vector differentiated_transposed(const SplineSpace& space, Vector g, int a, int b) {
  for (int k = b - 1; k >= 0; --k)
    g = y_differences_transposed(g, {space.x.size() - a, space.y.size() - k - 1},
                                 derivative_slopes(lowered(space.y, k)));
  for (int k = a - 1; k >= 0; --k)
    g = x_differences_transposed(g, {space.x.size() - k - 1, space.y.size()}, derivative_slopes(lowered(space.x, k)));
  return g;
}

}  // namespace

SplineBasis lowered(const SplineBasis& basis, int order) {
  return {basis.interval(), basis.degree() - order, basis.is_periodic() ? basis.ends() : EndConditions{}};
}

Vector derivative_slopes(const SplineBasis& basis) {
  const BandedRows rows = basis.differences();
  Vector result;
  for (int i = 0; i < rows.rows; ++i) result.push_back(rows(i, i + 1));
  return result;
}

std::vector<double> differentiated(const SplineSpace& space, std::span<const double> coefficients, int a, int b) {
  Vector c(coefficients.begin(), coefficients.end());
  for (int k = 0; k < a; ++k)
    c = x_differences(c, {space.x.size() - k, space.y.size()}, derivative_slopes(lowered(space.x, k)));
  for (int k = 0; k < b; ++k)
    c = y_differences(c, {space.x.size() - a, space.y.size() - k}, derivative_slopes(lowered(space.y, k)));
  return c;
}

std::vector<double> apply_by_differences(const Energy& energy, const SplineSpace& space,
                                         std::span<const double> coefficients) {
  Vector result = apply_curvature(energy.curvature(), space, coefficients);
  for (const auto& t : energy.terms()) {
    const Vector derivative = differentiated(space, coefficients, t.x_order, t.y_order);
    Vector g(derivative.size());
    mass(space, t.x_order, t.y_order).apply(derivative, g);
    g = differentiated_transposed(space, std::move(g), t.x_order, t.y_order);
    const double factor = t.weight * space.cell_factor(t.x_order, t.y_order);
    combine(factor, g, 1, result);
  }
  return result;
}

double evaluate_energy(const Energy& energy, const SplineSpace& space, std::span<const double> coefficients) {
  const Vector c(coefficients.begin(), coefficients.end());
  double sum = energy.curvature() == 0 ? 0 : dot(c, apply_curvature(energy.curvature(), space, c));
  for (const auto& t : energy.terms()) {
    const Vector derivative = differentiated(space, c, t.x_order, t.y_order);
    Vector product(derivative.size());
    mass(space, t.x_order, t.y_order).apply(derivative, product);
    sum += t.weight * space.cell_factor(t.x_order, t.y_order) * dot(derivative, product);
  }
  return sum;
}

}  // namespace batten
