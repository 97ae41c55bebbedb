// SPDX-License-Identifier: MIT
#include <batten/bases/tensor_sum.h>
#include <batten/domains/errors.h>

#include "../support/laws.h"
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

namespace batten {
namespace {

using test::dense;
using test::random_vector;

SplineBasis basis(int cells, int degree) { return {Interval(0, 1, cells), degree}; }

/// (Y ⊗ X) v by dense matrices.
Eigen::MatrixXd expected(const TensorSum& t, const std::vector<double>& v) {
  const Eigen::Map<const Eigen::MatrixXd> grid(v.data(), t.input_columns(), t.input_rows());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(t.output_columns(), t.output_rows());
  for (const auto& term : t.terms()) sum += term.factor * dense(term.x) * grid * dense(term.y).transpose();
  return sum;
}

void expect_equals_dense(const TensorSum& t) {
  const auto v = random_vector(t.input_size(), 5);
  const auto result = test::applied(t, v);
  const Eigen::Map<const Eigen::MatrixXd> found(result.data(), t.output_columns(), t.output_rows());
  const Eigen::MatrixXd e = expected(t, v);
  EXPECT_LT((found - e).cwiseAbs().maxCoeff(), 1e-13 * (1 + e.cwiseAbs().maxCoeff()) * 10);
}

TEST(TensorSum, applies_every_kind_of_banded_rows_like_dense_matrices) {
  for (int degree : {2, 3})
    for (int nx : {2, 9, 70, 1100}) {
      const auto x = basis(nx, degree), y = basis(21, degree);
      expect_equals_dense(TensorSum({{2., y.inner_products(0), x.inner_products(1)}}));
      expect_equals_dense(
          TensorSum({{2., y.inner_products(0), x.inner_products(2)}, {-1., y.inner_products(1), x.inner_products(1)}}));
      expect_equals_dense(TensorSum({{2., y.inner_products(0), x.inner_products(2)},
                                     {0.5, y.inner_products(1), x.inner_products(1)},
                                     {3., y.inner_products(2), x.inner_products(0)}}));
      const auto rx = x.coarser().refinement(x), ry = y.coarser().refinement(y);
      expect_equals_dense(TensorSum({{1., ry, rx}}));
      expect_equals_dense(TensorSum({{1., transposed(ry), transposed(rx)}}));
      expect_equals_dense(TensorSum({{1., y.samples(1), x.samples(0)}}));
      expect_equals_dense(TensorSum({{1., identity_rows(y.size()), x.differences()}}));
    }
}

TEST(TensorSum, gives_the_same_bits_for_every_number_of_threads) {
  const auto b = basis(300, 3);
  const TensorSum t({{1., b.inner_products(0), b.inner_products(2)}, {2., b.inner_products(1), b.inner_products(1)}});
  const auto v = random_vector(t.input_size(), 8);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = test::applied(t, v);
  omp_set_num_threads(3);
  const auto three = test::applied(t, v);
  omp_set_num_threads(before);
  EXPECT_EQ(one, three);
}

TEST(TensorSum, refuses_terms_of_different_shapes) {
  const auto a = basis(10, 3), b = basis(11, 3);
  EXPECT_THROW(TensorSum({}), InvalidInput);
  EXPECT_THROW(
      TensorSum({{1., a.inner_products(0), a.inner_products(0)}, {1., b.inner_products(0), a.inner_products(0)}}),
      InvalidInput);
}

}  // namespace
}  // namespace batten
