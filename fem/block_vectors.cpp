// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/fem/block_vectors.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace batten {
namespace {

constexpr Eigen::Index block_rows = 2048;       // of matrices
constexpr Eigen::Index vector_block = 1 << 14;  // of vectors

Eigen::Index blocks_of(Eigen::Index rows, Eigen::Index height) { return (rows + height - 1) / height; }

/// Calls work(block, first row, rows).
template <typename Work>
void for_row_blocks(Eigen::Index rows, Eigen::Index height, Work&& work) {
  const Eigen::Index blocks = blocks_of(rows, height);
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (Eigen::Index b = 0; b < blocks; ++b) {
    const Eigen::Index first = b * height;
    work(b, first, std::min(height, rows - first));
  }
}

/// out += A B, in the same order for every number of threads: Eigen's fast product takes one thread within the parallel
/// region of several blocks, and all threads outside of it.
template <typename Out, typename Left, typename Right>
void add_product(bool several_blocks, Out&& out, const Left& a, const Right& b) {
  if (several_blocks)
    out.noalias() += a * b;
  else
    out += a.lazyProduct(b);
}

}  // namespace

double dot(std::span<const double> a, std::span<const double> b) {
  const auto rows = static_cast<Eigen::Index>(a.size());
  std::vector<double> partial(static_cast<std::size_t>(blocks_of(rows, vector_block)));
  for_row_blocks(rows, vector_block, [&](Eigen::Index block, Eigen::Index first, Eigen::Index count) {
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (Eigen::Index i = first; i < first + count; ++i)
      sum += a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(i)];
    partial[static_cast<std::size_t>(block)] = sum;
  });
  return std::accumulate(partial.begin(), partial.end(), 0.);
}

void combine(double a, std::span<const double> x, double b, std::span<double> y) {
  const double* in = x.data();
  double* out = y.data();
  for_row_blocks(static_cast<Eigen::Index>(x.size()), vector_block,
                 [&](Eigen::Index, Eigen::Index first, Eigen::Index count) {
#pragma omp simd
                   for (Eigen::Index i = first; i < first + count; ++i) out[i] = a * in[i] + b * out[i];
                 });
}

Eigen::MatrixXd tall_products(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b) {
  std::vector<Eigen::MatrixXd> partial(static_cast<std::size_t>(blocks_of(a.rows(), block_rows)));
  for_row_blocks(a.rows(), block_rows, [&](Eigen::Index block, Eigen::Index first, Eigen::Index rows) {
    auto& product = partial[static_cast<std::size_t>(block)];
    product = Eigen::MatrixXd::Zero(a.cols(), b.cols());
    add_product(partial.size() > 1, product, a.middleRows(first, rows).transpose(), b.middleRows(first, rows));
  });
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  for (const auto& p : partial) sum += p;
  return sum;
}

void recombine(Eigen::Ref<Eigen::MatrixXd> a, const Eigen::MatrixXd& c) {
  for_row_blocks(a.rows(), block_rows, [&](Eigen::Index, Eigen::Index first, Eigen::Index rows) {
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(rows, c.cols());
    add_product(a.rows() > block_rows, product, a.middleRows(first, rows).leftCols(c.rows()), c);
    a.middleRows(first, rows).leftCols(c.cols()) = product;
  });
}

void subtract_product(Eigen::Ref<Eigen::MatrixXd> a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      const Eigen::MatrixXd& c) {
  const Eigen::MatrixXd negative = -c;
  for_row_blocks(a.rows(), block_rows, [&](Eigen::Index, Eigen::Index first, Eigen::Index rows) {
    add_product(a.rows() > block_rows, a.middleRows(first, rows), b.middleRows(first, rows), negative);
  });
}

Eigen::MatrixXd orthonormalisation(const Eigen::MatrixXd& gram) {
  constexpr double least = 1e-13;
  const Eigen::VectorXd scale =
      gram.diagonal().unaryExpr([](double d) { return d > 0 && std::isfinite(d) ? 1 / std::sqrt(d) : 0.; });
  const auto [values, vectors] = symmetric_eigensystem(scale.asDiagonal() * gram * scale.asDiagonal());
  const Eigen::Index kept = (values.array() > least * values[values.size() - 1]).count();
  return scale.asDiagonal() * vectors.rightCols(kept) * values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace batten
