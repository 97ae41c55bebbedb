// SPDX-License-Identifier: MIT
#include <batten/bases/spline_basis.h>
#include <batten/domains/errors.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace batten {
namespace {

constexpr EndConditions closed = {EndCondition::Periodic, EndCondition::Periodic};

/// Coefficients of a periodic spline: random ones, repeated at the images.
std::vector<double> periodic_coefficients(const SplineBasis& basis) {
  auto c = test::random_vector(static_cast<std::size_t>(basis.size()), 3);
  for (int i = 0; i < basis.size(); ++i)
    c[static_cast<std::size_t>(i)] = c[static_cast<std::size_t>(basis.original(i))];
  return c;
}

double value(const SplineBasis& basis, const std::vector<double>& c, double t, int order) {
  const auto local = basis.at(t, order);
  double sum = 0;
  for (int a = 0; a <= basis.degree(); ++a)
    sum += local.values[static_cast<std::size_t>(a)] * c[static_cast<std::size_t>(local.first + a)];
  return sum;
}

class PeriodicSplines : public testing::TestWithParam<int> {
protected:
  SplineBasis basis(int cells) const { return SplineBasis(Interval(0, 1, cells), GetParam(), closed); }
};

TEST_P(PeriodicSplines, have_derivatives_that_meet_at_the_seam) {
  const auto b = basis(13);
  const auto c = periodic_coefficients(b);
  for (int r = 0; r < b.degree(); ++r) EXPECT_NEAR(value(b, c, 0, r), value(b, c, 13, r), 1e-12);
}

TEST_P(PeriodicSplines, are_shifted_copies_of_one_function) {
  const auto b = basis(13);
  std::vector<double> one(static_cast<std::size_t>(b.size())), next(one.size());
  for (int i = 0; i < b.size(); ++i) {
    one[static_cast<std::size_t>(i)] = b.original(i) == 0;
    next[static_cast<std::size_t>(i)] = b.original(i) == 1;
  }
  for (int s = 0; s < 130; ++s)
    EXPECT_NEAR(value(b, one, s / 10., 0), value(b, next, std::fmod(s / 10. + 1, 13), 0), 1e-13);
}

TEST_P(PeriodicSplines, are_nested_and_halve_as_the_subdivision_mask_says) {
  for (int cells : {22, 32, 80}) test::expect_refinement_represents(basis(cells).coarser(), basis(cells));
  // images of a periodic spline repeat on the finer level too
  const auto coarse = basis(12), fine = basis(24);
  const auto c = periodic_coefficients(coarse);
  const auto r = coarse.refinement(fine);
  for (int i = 0; i < fine.size(); ++i) {
    double here = 0, there = 0;
    for (int j = 0; j < coarse.size(); ++j) {
      here += r(i, j) * c[static_cast<std::size_t>(j)];
      there += r(fine.original(i), j) * c[static_cast<std::size_t>(j)];
    }
    EXPECT_NEAR(here, there, 1e-15);
  }
}

TEST_P(PeriodicSplines, have_the_same_integrals_around_the_circle) {
  const auto b = basis(30);
  for (int r : {0, 1, 2}) {
    if (r > b.degree()) continue;
    const auto m = b.inner_products(r);
    const auto around = [&](int i, int j) {  // image by image
      double sum = 0;
      for (int p = 0; p < b.size(); ++p)
        for (int q = 0; q < b.size(); ++q)
          if (b.original(p) == i && b.original(q) == j) sum += m(p, q);
      return sum;
    };
    for (int i : {0, 1, 7, 29})
      for (int k = -6; k <= 6; ++k)
        EXPECT_NEAR(around(i, (i + k + 30) % 30), around(15, 15 + k), 1e-13) << i << " " << k;
  }
}

TEST_P(PeriodicSplines, become_splines_of_the_whole_basis) {
  const auto b = basis(12), all = b.unconstrained();
  const auto c = periodic_coefficients(b);
  auto whole = c;
  b.to_unconstrained(whole.data(), 1);
  for (int s = 0; s <= 60; ++s) EXPECT_NEAR(value(b, c, s / 5., 0), value(all, whole, s / 5., 0), 1e-14);
  // restriction is the transpose
  const auto t = b.subspace_restriction();
  const auto load = test::random_vector(static_cast<std::size_t>(b.size()), 4);
  double in_whole = 0, in_subspace = 0;
  for (int i = 0; i < b.size(); ++i) {
    in_whole += load[static_cast<std::size_t>(i)] * whole[static_cast<std::size_t>(i)];
    for (int j = 0; j < b.size(); ++j)
      in_subspace += c[static_cast<std::size_t>(i)] * t(i, j) * load[static_cast<std::size_t>(j)];
  }
  EXPECT_NEAR(in_whole, in_subspace, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Degrees, PeriodicSplines, testing::Values(1, 2, 3, 4, 5));

TEST(PeriodicSplines, keep_the_cubic_end_that_knot_insertion_gives) {
  const auto a = periodic_end(3);
  using Row = std::vector<Rational>;
  EXPECT_EQ(a[0], (Row{Rational(1, 6), Rational(2, 3), Rational(1, 6)}));  // the values of N at the end
  EXPECT_EQ(a[1], (Row{0, Rational(2, 3), Rational(1, 3)}));
  EXPECT_EQ(a[2], (Row{0, 0, 1}));
}

TEST(PeriodicSplines, need_two_ends_and_equal_cells) {
  EXPECT_THROW(SplineBasis(Interval(0, 1, 12), 3, {EndCondition::Periodic, EndCondition::Free}), InvalidInput);
  EXPECT_THROW(SplineBasis(Interval(0, 1, 12), 3, {EndCondition::Zero, EndCondition::Periodic}), InvalidInput);
  EXPECT_THROW(SplineBasis(Interval(0, 1, 6), 3, closed), InvalidInput);
  EXPECT_THROW(SplineBasis(Interval(0, 1, 25).coarser(), 3, closed), InvalidInput);
}

}  // namespace
}  // namespace batten
