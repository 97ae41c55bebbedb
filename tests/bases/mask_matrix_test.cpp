// SPDX-License-Identifier: MIT
#include <batten/bases/mask_matrix.h>
#include <batten/bases/mask_text.h>
#include <batten/domains/errors.h>

#include <gtest/gtest.h>

namespace batten {
namespace {

using Q = Rational;
using M2 = Mask2<Rational>;
using Matrix = MaskMatrix<Rational, 2>;

const M2 one = M2::constant(1), x = M2::monomial({1, 0}), y = M2::monomial({0, 1});

TEST(MaskMatrix, carries_the_differences_of_the_zwart_powell_scheme) {
  // [Warren & Weimer 2001, sec. 3.3.1]: {d[x]; d[y]} s = (t_ij) {d[x^2]; d[y^2]}, d[x] = 1 - x
  const M2 s = Q(1, 4) * (one + x) * (one + y) * (one + x * y) * (x + y);
  const M2 common = Q(1, 4) * (x + y) * (one + x * y);
  const Matrix T(2, 2, {(one + y) * common, M2(), M2(), (one + x) * common});
  const Matrix d(2, 1, {one - x, one - y});
  EXPECT_EQ(s * d, T * upsampled(d, 2));
}

TEST(MaskMatrix, carries_the_second_differences_of_the_zwart_powell_scheme) {
  // [Warren & Weimer 2001, eq. 3.16], as repaired in the reference
  const M2 s = Q(1, 4) * (one + x) * (one + y) * (one + x * y) * (x + y), dx = one - x, dy = one - y;
  const M2 t00 = Q(1, 2) * (one + x * y + x * y * y + y * y * y), t01 = Q(1, 2) * (-one + x + y - x * y);
  const M2 t11 = Q(1, 2) * (x + y + x * y * y + x * x * y);
  const M2 t21 = Q(1, 2) * (-one - x * y + x * y * y + y * y * y), t22 = Q(1, 2) * (one + x + y + x * y);
  const Matrix T(3, 3, {t00, t01, M2(), M2(), t11, M2(), M2(), t21, t22});
  const Matrix d(3, 1, {dx * dx, dx * dy, dy * dy});
  EXPECT_EQ(Q(2) * one * s * d, T * upsampled(d, 2));
}

TEST(MaskMatrix, refuses_shapes_that_do_not_fit) {
  EXPECT_THROW(Matrix(2, 2, {one}), InvalidInput);
  EXPECT_THROW(Matrix(-1, 2), InvalidInput);
  EXPECT_THROW(Matrix(2, 2) * Matrix(1, 2), InvalidInput);
  EXPECT_THROW(Matrix(2, 2) + Matrix(2, 1), InvalidInput);
  EXPECT_THROW(applied(Matrix(2, 2), std::vector<M2>{one}), InvalidInput);
}

TEST(MaskMatrix, of_the_identity_changes_nothing) {
  const auto I = identity_mask_matrix<Rational, 2>(2);
  const Matrix a(2, 2, {one, x, y, x * y});
  EXPECT_EQ(I * a, a);
  EXPECT_EQ(a * I, a);
  EXPECT_EQ(transposed(transposed(a)), a);
  EXPECT_EQ(transposed(a)(0, 1), y);
  EXPECT_EQ(applied(a, {one, one}), (std::vector<M2>{one + x, y + x * y}));
}

}  // namespace
}  // namespace batten
