// SPDX-License-Identifier: MIT
#include <batten/bases/spline_basis.h>
#include <batten/domains/errors.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace batten {
namespace {

constexpr std::array conditions = {EndCondition::Free, EndCondition::Zero, EndCondition::Flat, EndCondition::Clamped};

/// Calls work(basis) for every degree and pair of conditions that a basis on that many cells can have.
template <typename Work>
void for_bases(int cells, Work&& work) {
  for (int degree = 1; degree <= 5; ++degree)
    for (const auto lower : conditions)
      for (const auto upper : conditions) {
        const auto has_slope = [](EndCondition c) { return c == EndCondition::Flat || c == EndCondition::Clamped; };
        if (degree < 2 && (has_slope(lower) || has_slope(upper))) continue;
        SCOPED_TRACE(testing::Message() << cells << " cells, degree " << degree << ", conditions "
                                        << static_cast<int>(lower) << " and " << static_cast<int>(upper));
        work(SplineBasis(Interval(0, 1, cells), degree, {lower, upper}));
      }
}

/// Largest |N_i^(order)(t)| over all functions.
double largest(const SplineBasis& basis, double t, int order) {
  double result = 0;
  for (double v : basis.at(t, order).values) result = std::max(result, std::abs(v));
  return result;
}

TEST(EndConditions, hold_for_every_function) {
  for_bases(9, [](const SplineBasis& b) {
    const auto expect_at = [&](double t, EndCondition c) {
      const bool has_value = c == EndCondition::Zero || c == EndCondition::Clamped;
      const bool has_slope = c == EndCondition::Flat || c == EndCondition::Clamped;
      EXPECT_LT(has_value ? largest(b, t, 0) : 0, 1e-15);
      EXPECT_LT(has_slope ? largest(b, t, 1) : 0, 1e-13);
    };
    expect_at(0, b.ends().lower);
    expect_at(9, b.ends().upper);
  });
}

TEST(EndConditions, subspaces_are_nested) {
  for (int cells : {7, 16, 40, 61})
    for_bases(cells, [](const SplineBasis& b) {
      if (b.interval().cells() / 2 > b.size() - b.kept() - b.degree())
        test::expect_refinement_represents(b.coarser(), b);
    });
}

TEST(EndConditions, inner_products_are_those_of_the_functions) {
  for_bases(30, [](const SplineBasis& b) {
    const SplineBasis all = b.unconstrained();
    const auto c = test::random_vector(static_cast<std::size_t>(b.size()), 1);
    auto whole = c;
    b.to_unconstrained(whole.data(), 1);
    const Eigen::Map<const Eigen::VectorXd> u(c.data(), b.size()), v(whole.data(), b.size());
    for (int r : {0, 1, 2})
      if (r <= b.degree()) {
        const double exact = v.dot(test::dense(all.inner_products(r)) * v);
        EXPECT_NEAR(u.dot(test::dense(b.inner_products(r)) * u), exact, 1e-12 * exact);
      }
  });
}

TEST(EndConditions, coefficients_of_the_whole_basis_give_the_same_values) {
  for_bases(12, [](const SplineBasis& b) {
    const SplineBasis all = b.unconstrained();
    const auto c = test::random_vector(static_cast<std::size_t>(b.size()), 2);
    auto whole = c;
    b.to_unconstrained(whole.data(), 1);
    for (int s = 0; s <= 60; ++s) {
      const auto mine = b.at(s / 5.), theirs = all.at(s / 5.);
      double difference = 0;
      for (int a = 0; a <= b.degree(); ++a) {
        const auto k = static_cast<std::size_t>(a), i = static_cast<std::size_t>(mine.first + a);
        difference += mine.values[k] * c[i] - theirs.values[k] * whole[i];
      }
      EXPECT_NEAR(difference, 0, 1e-14);
    }
  });
}

TEST(EndConditions, on_derivatives_need_degree_two_and_leave_a_function) {
  EXPECT_THROW(SplineBasis(Interval(0, 1, 8), 1, {EndCondition::Flat, EndCondition::Free}), InvalidInput);
  EXPECT_THROW(SplineBasis(Interval(0, 1, 2), 2, {EndCondition::Clamped, EndCondition::Clamped}), InvalidInput);
}

}  // namespace
}  // namespace batten
