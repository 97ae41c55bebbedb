// SPDX-License-Identifier: MIT
#include <batten/fem/difference_form.h>
#include <batten/fem/hierarchy.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

const std::vector<Energy> energies = {
    Energy::conduction(1.3, 0.4),
    Energy::plate({.rigidity = 2, .poisson_ratio = 0.3, .tension = 0.7, .foundation = 0.2})};

TEST(DifferenceForm, is_the_operator) {
  for (const auto& energy : energies)
    for (int degree = energy.order(); degree <= 5; ++degree) {
      const auto space = finest_space({Interval(0, 1, 19), Interval(0, 0.7, 12)}, degree);
      const auto c = test::random_vector(space.size(), 5);
      const auto a = apply_by_differences(energy, space, c), b = test::applied(Operator(energy, space), c);
      double largest = 0, error = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(b[i]));
        error = std::max(error, std::abs(a[i] - b[i]));
      }
      EXPECT_LT(error, 1e-13 * largest) << "degree " << degree;
    }
}

/// Entry (i, j) of E c for the thin plate in long double, from the integer inner products.
long double plate_entry(const SplineSpace& space, const std::vector<double>& c, int i, int j) {
  long double sum = 0;
  for (int r = 0; r <= 2; ++r) {
    const BandedRows x = space.x.inner_products(2 - r), y = space.y.inner_products(r);
    long double term = 0;
    for (int q = -3; q <= 3; ++q)
      for (int p = -3; p <= 3; ++p)
        term += static_cast<long double>(std::round(x(i, i + p) / x.scale)) * std::round(y(j, j + q) / y.scale) *
                c[static_cast<std::size_t>((j + q) * space.x.size() + i + p)];
    const long double denominators = static_cast<long double>(std::round(1 / x.scale)) * std::round(1 / y.scale);
    sum += (r == 1 ? 2 : 1) * term / denominators;
  }
  return sum / (static_cast<long double>(space.hx) * space.hy);
}

TEST(DifferenceForm, keeps_the_digits_of_smooth_functions_on_fine_grids) {
  const auto space = finest_space({Interval(0, 1, 1024), Interval(0, 1, 1024)}, 3);
  std::vector<double> c(space.size());
  for (int j = 0; j < space.y.size(); ++j)
    for (int i = 0; i < space.x.size(); ++i)
      c[static_cast<std::size_t>(j * space.x.size() + i)] = std::sin(0.003 * i) * std::cos(0.002 * j);
  const auto e = apply_by_differences(Energy::thin_plate(), space, c);
  const auto sums = test::applied(Operator(Energy::thin_plate(), space), c);
  long double error = 0, error_of_sums = 0;
  for (int k = 100; k < 900; k += 7) {
    const auto i = static_cast<std::size_t>(k * space.x.size() + k + 50);
    const long double exact = plate_entry(space, c, k + 50, k);
    error = std::max(error, std::abs(e[i] - exact));
    error_of_sums = std::max(error_of_sums, std::abs(sums[i] - exact));
  }
  EXPECT_LT(error, 0.05 * error_of_sums);
}

}  // namespace
}  // namespace batten
