// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/fem/operator.h>

#include <array>
#include <cmath>

namespace batten {
namespace {

/// Factor that turns ∫∫ (∂_x^a ∂_y^b p)² in cells into normalised coordinates.
double cell_factor(const SplineSpace& s, int a, int b) { return std::pow(s.hx, 1 - 2 * a) * std::pow(s.hy, 1 - 2 * b); }

/// Σ_r factor[r] gram_r with the scales multiplied in; a single term keeps its integers.
BandedRows mixture(const std::array<BandedRows, 3>& gram, const std::array<double, 3>& factor, double& outer) {
  int used = 0, last = 0;
  for (int r = 0; r < 3; ++r)
    if (factor[static_cast<std::size_t>(r)] != 0) {
      ++used;
      last = r;
    }
  outer = 1;
  if (used == 1) {
    outer = factor[static_cast<std::size_t>(last)];
    return gram[static_cast<std::size_t>(last)];
  }
  BandedRows sum = gram[0];
  sum.scale = 1;
  for (const auto& g : gram) {
    sum.begin = std::max(sum.begin, g.begin);
    sum.end = std::min(sum.end, g.end);
  }
  for (std::size_t k = 0; k < sum.weights.size(); ++k) {
    sum.weights[k] = 0;
    for (std::size_t r = 0; r < 3; ++r) sum.weights[k] += factor[r] * gram[r].scale * gram[r].weights[k];
  }
  return sum;
}

/// One Kronecker term for each order of the derivative in y; the orders in x that go with it are mixed into one band.
TensorSum build_products(const Energy& energy, const SplineSpace& space) {
  std::array<BandedRows, 3> gram_x, gram_y;
  for (int r = 0; r < 3; ++r) {
    const auto k = static_cast<std::size_t>(r);
    gram_x[k] = space.x.inner_products(std::min(r, space.x.degree()));
    gram_y[k] = space.y.inner_products(std::min(r, space.y.degree()));
  }
  std::vector<TensorSum::Term> terms;
  for (int b = 0; b < 3; ++b) {
    std::array<double, 3> factor{};
    bool used = false;
    for (const auto& t : energy.terms()) {
      if (t.y_order != b) continue;
      factor[static_cast<std::size_t>(t.x_order)] += t.weight * cell_factor(space, t.x_order, b);
      used = true;
    }
    if (!used) continue;
    TensorSum::Term term;
    term.x = mixture(gram_x, factor, term.factor);
    term.y = gram_y[static_cast<std::size_t>(b)];
    terms.push_back(std::move(term));
  }
  return TensorSum(std::move(terms));
}

BandedRows derivative_rows(const SplineBasis& basis, int order) {
  return SplineBasis(basis.interval(), basis.degree() - order).inner_products(0);
}

std::vector<double> differentiated(std::vector<double> c, SplineBasis x, SplineBasis y, int x_order, int y_order) {
  const auto apply = [&](const BandedRows& rows_y, const BandedRows& rows_x) {
    const TensorSum difference({{1., rows_y, rows_x}});
    std::vector<double> result(difference.output_size());
    difference.apply(c, result);
    c = std::move(result);
  };
  for (; x_order > 0; --x_order) {
    apply(identity_rows(y.size()), x.differences());
    x = SplineBasis(x.interval(), x.degree() - 1);
  }
  for (; y_order > 0; --y_order) {
    apply(y.differences(), identity_rows(x.size()));
    y = SplineBasis(y.interval(), y.degree() - 1);
  }
  return c;
}

}  // namespace

Operator::Operator(const Energy& energy, const SplineSpace& space) : products_(build_products(energy, space)) {}

std::vector<double> Operator::diagonal() const {
  const int nx = products_.output_columns(), ny = products_.output_rows();
  std::vector<double> result(products_.output_size());
  for (const auto& term : products_.terms())
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        result[static_cast<std::size_t>(j) * nx + i] += term.factor * term.y(j, j) * term.x(i, i);
  return result;
}

double Operator::entry(int i, int j, int k, int l) const {
  double sum = 0;
  for (const auto& term : products_.terms()) sum += term.factor * (term.y(j, l) * term.x(i, k));
  return sum;
}

double evaluate_energy(const Energy& energy, const SplineSpace& space, std::span<const double> coefficients) {
  double sum = 0;
  for (const auto& t : energy.terms()) {
    const auto derivative =
        differentiated({coefficients.begin(), coefficients.end()}, space.x, space.y, t.x_order, t.y_order);
    const TensorSum mass({{1., derivative_rows(space.y, t.y_order), derivative_rows(space.x, t.x_order)}});
    const int n = mass.output_columns();
    const double square = sum_blocks(RowBlocks(mass.output_rows(), n), [&](int begin, int end) {
      std::vector<double> row(static_cast<std::size_t>(n));
      double partial = 0;
      for (int j = begin; j < end; ++j) {
        mass.row(j, derivative.data(), row.data());
        for (int i = 0; i < n; ++i)
          partial += row[static_cast<std::size_t>(i)] * derivative[static_cast<std::size_t>(j) * n + i];
      }
      return partial;
    });
    sum += t.weight * cell_factor(space, t.x_order, t.y_order) * square;
  }
  return sum;
}

}  // namespace batten
