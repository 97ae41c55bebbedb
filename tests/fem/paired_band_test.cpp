// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/paired_band.h>

#include "../support/observations.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace batten {
namespace {

using Quad = long double;
using Rows = std::vector<std::vector<Quad>>;

/// Gauss' elimination with pivots.
std::vector<Quad> dense_solution(Rows a, std::vector<Quad> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t j = i; j < n; ++j)
      if (std::abs(a[j][i]) > std::abs(a[pivot][i])) pivot = j;
    std::swap(a[i], a[pivot]);
    std::swap(b[i], b[pivot]);
    for (std::size_t j = i + 1; j < n; ++j) {
      const Quad factor = a[j][i] / a[i][i];
      for (std::size_t k = i; k < n; ++k) a[j][k] -= factor * a[i][k];
      b[j] -= factor * b[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

/// The equations [W, Q; Qᵀ, -R] of values and second derivatives of a strip over cells of these widths, for each of
/// `reach` components, whose values at a knot are coupled as well.
struct StripSystem {
  StripSystem(const std::vector<double>& widths, const std::vector<double>& weights, std::size_t dimension)
      : pairs(dimension * weights.size()), band(pairs, dimension), dense(2 * pairs, std::vector<Quad>(2 * pairs)) {
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (std::size_t k = 0; k < dimension; ++k) {
        const std::size_t p = i * dimension + k;
        add(p, p, {weights[i], 0, 0, i == 0 || i + 1 == weights.size() ? -1. : 0.});
        for (std::size_t j = k + 1; j < dimension; ++j) add(p, i * dimension + j, {weights[i] / 3, 0, 0, 0});
      }
    for (std::size_t cell = 0; cell < widths.size(); ++cell)
      for (std::size_t k = 0; k < dimension; ++k) {
        const double h = widths[cell], left = cell > 0, right = cell + 1 < widths.size();
        const std::size_t p = cell * dimension + k, q = p + dimension;
        add(p, p, {0, -left / h, -left / h, -left * h / 3});
        add(q, q, {0, -right / h, -right / h, -right * h / 3});
        add(p, q, {0, left / h, right / h, -left * right * h / 6});
      }
  }
  /// Adds to the block of pairs p <= q: rows of q, columns of p.
  void add(std::size_t p, std::size_t q, const PairedBand::Block& b) {
    PairedBand::Block& sum = band.at(p, q - p);
    sum = {sum.vv + b.vv, sum.vb + b.vb, sum.bv + b.bv, sum.bb + b.bb};
    const Quad entries[2][2] = {{sum.vv, sum.vb}, {sum.bv, sum.bb}};
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t c = 0; c < 2; ++c) dense[2 * q + r][2 * p + c] = dense[2 * p + c][2 * q + r] = entries[r][c];
  }

  std::size_t pairs;
  PairedBand band;
  Rows dense;
};

/// The largest error of the solution in the energy norm of values and bends, relative.
double error(std::size_t dimension, double most_weight, double most_width, unsigned seed) {
  test::Random random(seed);
  constexpr std::size_t knots = 24;
  std::vector<double> widths, weights;
  for (std::size_t i = 0; i < knots; ++i) weights.push_back(std::pow(most_weight, 2 * random() - 1));
  for (std::size_t i = 0; i + 1 < knots; ++i) widths.push_back(std::pow(most_width, random() - 0.5));
  StripSystem system(widths, weights, dimension);
  std::vector<double> right(2 * system.pairs);
  for (std::size_t p = 0; p < system.pairs; ++p) right[2 * p] = weights[p / dimension] * random.normal();
  const auto expected = dense_solution(system.dense, {right.begin(), right.end()});
  system.band.factor();
  const auto found = system.band.solved(right);
  Quad wrong = 0, all = 0;
  for (std::size_t p = 0; p < system.pairs; ++p) {
    const std::size_t i = p / dimension;
    const Quad bend = (i > 0 ? widths[i - 1] : 0) + (i + 1 < knots ? widths[i] : 0);
    for (const auto& [row, weight] : {std::pair{2 * p, Quad(weights[i])}, {2 * p + 1, bend / 3}}) {
      wrong += weight * (found[row] - expected[row]) * (found[row] - expected[row]);
      all += weight * expected[row] * expected[row];
    }
  }
  return static_cast<double>(std::sqrt(wrong / all));
}

// Neighbouring cells whose widths differ by a factor r leave slopes 1/h that cancel up to 1 / r.
TEST(PairedBand, solves_strips_of_any_weights_and_widths) {
  constexpr double eps = 2.3e-16;
  for (const std::size_t dimension : {1, 2, 3})
    for (const double weights : {1., 1e6, 1e12})
      for (const double widths : {1., 1e3, 1e6})
        for (unsigned seed = 1; seed <= 4; ++seed)
          EXPECT_LT(error(dimension, weights, widths, seed), 100 * eps * widths) << dimension << " " << weights;
}

TEST(PairedBand, has_a_few_reaches) {
  EXPECT_THAT([] { PairedBand(4, 5); },
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("reach must be 1, 2, 3, 4 or 6, found 5")));
}

}  // namespace
}  // namespace batten
