// SPDX-License-Identifier: MIT
#include <batten/bases/mask_matrix.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

template <Coefficient T, int D>
std::string shape(const MaskMatrix<T, D>& a) {
  return std::to_string(a.rows()) + " x " + std::to_string(a.columns());
}

template <Coefficient T, int D>
void require_same_shape(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b) {
  if (a.rows() != b.rows() || a.columns() != b.columns())
    throw InvalidInput("MaskMatrix: summands must have the same shape, found " + shape(a) + " and " + shape(b));
}

template <Coefficient T, int D, std::invocable<int, int> Work>
void for_entries(const MaskMatrix<T, D>& a, Work&& work) {
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) work(i, j);
}

}  // namespace

template <Coefficient T, int D>
MaskMatrix<T, D>::MaskMatrix(int rows, int columns)
    : MaskMatrix(rows, columns,
                 std::vector<Entry>(rows < 0 || columns < 0 ? 0 : static_cast<std::size_t>(rows * columns))) {}

template <Coefficient T, int D>
MaskMatrix<T, D>::MaskMatrix(int rows, int columns, std::vector<Entry> entries)
    : rows_(rows), columns_(columns), entries_(std::move(entries)) {
  if (rows < 0 || columns < 0 || entries_.size() != static_cast<std::size_t>(rows * columns))
    throw InvalidInput("MaskMatrix: there must be rows x columns entries, found " + std::to_string(entries_.size()) +
                       " for " + shape(*this));
}

template <Coefficient T, int D>
MaskMatrix<T, D> operator+(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b) {
  require_same_shape(a, b);
  auto sum = a;
  for_entries(a, [&](int i, int j) { sum(i, j) += b(i, j); });
  return sum;
}

template <Coefficient T, int D>
MaskMatrix<T, D> operator-(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b) {
  require_same_shape(a, b);
  auto difference = a;
  for_entries(a, [&](int i, int j) { difference(i, j) -= b(i, j); });
  return difference;
}

template <Coefficient T, int D>
MaskMatrix<T, D> operator*(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b) {
  if (a.columns() != b.rows())
    throw InvalidInput("MaskMatrix: in a product the columns of the left must be the rows of the right, found " +
                       shape(a) + " and " + shape(b));
  MaskMatrix<T, D> product(a.rows(), b.columns());
  for_entries(product, [&](int i, int j) {
    for (int k = 0; k < a.columns(); ++k) product(i, j) += a(i, k) * b(k, j);
  });
  return product;
}

template <Coefficient T, int D>
MaskMatrix<T, D> operator*(const LaurentPolynomial<T, D>& s, const MaskMatrix<T, D>& a) {
  auto product = a;
  for_entries(a, [&](int i, int j) { product(i, j) *= s; });
  return product;
}

template <Coefficient T, int D>
std::vector<LaurentPolynomial<T, D>> applied(const MaskMatrix<T, D>& a, const std::vector<LaurentPolynomial<T, D>>& v) {
  const auto product = a * MaskMatrix<T, D>(static_cast<int>(v.size()), 1, v);
  std::vector<LaurentPolynomial<T, D>> column;
  for (int i = 0; i < product.rows(); ++i) column.push_back(product(i, 0));
  return column;
}

template <Coefficient T, int D>
MaskMatrix<T, D> upsampled(const MaskMatrix<T, D>& a, int n) {
  auto result = a;
  for_entries(a, [&](int i, int j) { result(i, j) = upsampled(a(i, j), n); });
  return result;
}

template <Coefficient T, int D>
MaskMatrix<T, D> transposed(const MaskMatrix<T, D>& a) {
  MaskMatrix<T, D> result(a.columns(), a.rows());
  for_entries(a, [&](int i, int j) { result(j, i) = a(i, j); });
  return result;
}

template <Coefficient T, int D>
MaskMatrix<T, D> identity_mask_matrix(int size) {
  MaskMatrix<T, D> result(size, size);
  for (int i = 0; i < size; ++i) result(i, i) = LaurentPolynomial<T, D>::constant(T(1));
  return result;
}

template class MaskMatrix<Rational, 1>;
template class MaskMatrix<Rational, 2>;
template class MaskMatrix<double, 1>;
template class MaskMatrix<double, 2>;
template MaskMatrix<Rational, 1> operator+(const MaskMatrix<Rational, 1>&, const MaskMatrix<Rational, 1>&);
template MaskMatrix<Rational, 1> operator-(const MaskMatrix<Rational, 1>&, const MaskMatrix<Rational, 1>&);
template MaskMatrix<Rational, 1> operator*(const MaskMatrix<Rational, 1>&, const MaskMatrix<Rational, 1>&);
template MaskMatrix<Rational, 1> operator*(const LaurentPolynomial<Rational, 1>&, const MaskMatrix<Rational, 1>&);
template std::vector<LaurentPolynomial<Rational, 1>> applied(const MaskMatrix<Rational, 1>&,
                                                             const std::vector<LaurentPolynomial<Rational, 1>>&);
template MaskMatrix<Rational, 1> upsampled(const MaskMatrix<Rational, 1>&, int);
template MaskMatrix<Rational, 1> transposed(const MaskMatrix<Rational, 1>&);
template MaskMatrix<Rational, 1> identity_mask_matrix<Rational, 1>(int);
template MaskMatrix<Rational, 2> operator+(const MaskMatrix<Rational, 2>&, const MaskMatrix<Rational, 2>&);
template MaskMatrix<Rational, 2> operator-(const MaskMatrix<Rational, 2>&, const MaskMatrix<Rational, 2>&);
template MaskMatrix<Rational, 2> operator*(const MaskMatrix<Rational, 2>&, const MaskMatrix<Rational, 2>&);
template MaskMatrix<Rational, 2> operator*(const LaurentPolynomial<Rational, 2>&, const MaskMatrix<Rational, 2>&);
template std::vector<LaurentPolynomial<Rational, 2>> applied(const MaskMatrix<Rational, 2>&,
                                                             const std::vector<LaurentPolynomial<Rational, 2>>&);
template MaskMatrix<Rational, 2> upsampled(const MaskMatrix<Rational, 2>&, int);
template MaskMatrix<Rational, 2> transposed(const MaskMatrix<Rational, 2>&);
template MaskMatrix<Rational, 2> identity_mask_matrix<Rational, 2>(int);
template MaskMatrix<double, 1> operator+(const MaskMatrix<double, 1>&, const MaskMatrix<double, 1>&);
template MaskMatrix<double, 1> operator-(const MaskMatrix<double, 1>&, const MaskMatrix<double, 1>&);
template MaskMatrix<double, 1> operator*(const MaskMatrix<double, 1>&, const MaskMatrix<double, 1>&);
template MaskMatrix<double, 1> operator*(const LaurentPolynomial<double, 1>&, const MaskMatrix<double, 1>&);
template std::vector<LaurentPolynomial<double, 1>> applied(const MaskMatrix<double, 1>&,
                                                           const std::vector<LaurentPolynomial<double, 1>>&);
template MaskMatrix<double, 1> upsampled(const MaskMatrix<double, 1>&, int);
template MaskMatrix<double, 1> transposed(const MaskMatrix<double, 1>&);
template MaskMatrix<double, 1> identity_mask_matrix<double, 1>(int);
template MaskMatrix<double, 2> operator+(const MaskMatrix<double, 2>&, const MaskMatrix<double, 2>&);
template MaskMatrix<double, 2> operator-(const MaskMatrix<double, 2>&, const MaskMatrix<double, 2>&);
template MaskMatrix<double, 2> operator*(const MaskMatrix<double, 2>&, const MaskMatrix<double, 2>&);
template MaskMatrix<double, 2> operator*(const LaurentPolynomial<double, 2>&, const MaskMatrix<double, 2>&);
template std::vector<LaurentPolynomial<double, 2>> applied(const MaskMatrix<double, 2>&,
                                                           const std::vector<LaurentPolynomial<double, 2>>&);
template MaskMatrix<double, 2> upsampled(const MaskMatrix<double, 2>&, int);
template MaskMatrix<double, 2> transposed(const MaskMatrix<double, 2>&);
template MaskMatrix<double, 2> identity_mask_matrix<double, 2>(int);

}  // namespace batten
