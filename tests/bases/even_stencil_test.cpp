// SPDX-License-Identifier: MIT
#include <batten/bases/even_stencil.h>
#include <batten/bases/spline_basis.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace batten {
namespace {

TensorSum bending(const SplineBasis& x, const SplineBasis& y) {
  const int d = x.degree(), m = d > 1 ? 2 : 1;
  return TensorSum({{1., y.inner_products(m), x.inner_products(0)},
                    {2., y.inner_products(1), x.inner_products(1)},
                    {1., y.inner_products(0), x.inner_products(m)}});
}

TEST(EvenStencil, agrees_with_the_tensor_sum_to_rounding) {
  for (int degree = 1; degree <= 5; ++degree)
    for (const auto end : {EndCondition::Free, EndCondition::Zero}) {
      const SplineBasis x(Interval(0, 1, 700), degree, {end, end}), y(Interval(0, 1, 40), degree, {end, end});
      const auto sum = bending(x, y);
      const auto even = EvenStencil::inside(sum);
      ASSERT_TRUE(even);
      EXPECT_GE(even->rows().end - even->rows().begin, 40 - 3 * degree);
      const auto c = test::random_vector(sum.input_size(), 1);
      std::vector<double> exact(static_cast<std::size_t>(x.size())), found(exact.size());
      for (int j = even->rows().begin; j < even->rows().end; ++j) {
        sum.row(j, c.data(), exact.data());
        std::vector<const double*> rows;
        for (int p = -degree; p <= degree; ++p) rows.push_back(c.data() + (j + p) * x.size());
        for (const auto& [from, to] : {std::pair{0, 3}, {3, 650}, {650, x.size()}})
          even->row(rows.data(), {from, to}, found.data() + from);
        for (std::size_t i = 0; i < exact.size(); ++i) ASSERT_NEAR(found[i], exact[i], 1e-11) << degree;
      }
    }
}

TEST(EvenStencil, does_not_stand_for_refinement_or_odd_sums) {
  const SplineBasis x(Interval(0, 1, 40), 3);
  const auto r = x.coarser().refinement(x);
  EXPECT_FALSE(EvenStencil::inside(TensorSum({{1., r, r}})));
  EXPECT_FALSE(EvenStencil::inside(TensorSum({{1., x.inner_products(0, 1), x.inner_products(0)}})));
}

}  // namespace
}  // namespace batten
