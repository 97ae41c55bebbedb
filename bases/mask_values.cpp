// SPDX-License-Identifier: MIT
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace batten {
namespace {

std::complex<double> square_root(const std::complex<double>& x) { return std::sqrt(x); }

double square_root(double x) {
  if (!(x >= 0))
    throw InvalidInput("evaluate: a half power needs a number that is not negative, found " + std::to_string(x));
  return std::sqrt(x);
}

Rational square_root(const Rational& x) {
  if (x != 1) throw InvalidInput("evaluate: a half power of a rational is rational at 1 only, found " + x.str());
  return x;
}

/// x^(n + half/2)
template <class U>
U power_of(const U& x, int n, int half) {
  if (n < 0 && x == U(0)) throw InvalidInput("evaluate: a mask with negative powers has no value at 0");
  U factor = n < 0 ? U(U(1) / x) : x, result = half ? square_root(x) : U(1);
  for (int k = std::abs(n); k > 0; k /= 2) {
    if (k % 2) result *= factor;
    factor *= factor;
  }
  return result;
}

/// Horner's rule in x along each row, then in y.
template <class U, Coefficient T, int D>
U horner(const LaurentPolynomial<T, D>& s, const Coordinates<U, D>& point) {
  if (s.is_zero()) return U(0);
  const auto row = static_cast<std::size_t>(s.size()[0]), rows = s.coefficients().size() / row;
  U value(0);
  for (std::size_t y = rows; y-- > 0;) {
    U of_row(0);
    for (std::size_t x = row; x-- > 0;) of_row = of_row * point[0] + U(s.coefficients()[x + row * y]);
    value = value * point[D - 1] + of_row;  // one row in one dimension: the value so far is 0
  }
  for (std::size_t d = 0; d < D; ++d) value *= power_of(point[d], s.first()[d], s.half()[d]);
  return value;
}

}  // namespace

template <Coefficient T, int D>
T evaluate(const LaurentPolynomial<T, D>& s, const Coordinates<T, D>& point) {
  return horner<T>(s, point);
}

template <int D>
std::complex<double> evaluate(const LaurentPolynomial<double, D>& s,
                              const Coordinates<std::complex<double>, D>& point) {
  return horner<std::complex<double>>(s, point);
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> derivative(const LaurentPolynomial<T, D>& s, const Index<D>& order) {
  for (int r : order)
    if (r < 0) throw InvalidInput("derivative: the order must not be negative, found " + std::to_string(r));
  std::vector<T> result(s.coefficients().begin(), s.coefficients().end());
  Index<D> first = s.first();
  const std::size_t row = s.is_zero() ? 1 : static_cast<std::size_t>(s.size()[0]);
  for (std::size_t d = 0; d < D; ++d)
    for (int r = 0; r < order[d]; ++r) {
      for (std::size_t k = 0; k < result.size(); ++k) {
        const int exponent = first[d] + static_cast<int>(d == 0 ? k % row : k / row);
        result[k] *= T(2 * exponent + s.half()[d]) / T(2);
      }
      --first[d];
    }
  return {first, s.size(), std::move(result), s.half()};
}

template <Coefficient T, int D>
T sum(const LaurentPolynomial<T, D>& s) {
  T total(0);
  for (const T& c : s.coefficients()) total += c;
  return total;
}

template <Coefficient T, int D>
T absolute_sum(const LaurentPolynomial<T, D>& s) {
  using std::abs;
  T total(0);
  for (const T& c : s.coefficients()) total += T(abs(c));
  return total;
}

template Rational evaluate(const Mask<Rational>&, const std::array<Rational, 1>&);
template Rational evaluate(const Mask2<Rational>&, const std::array<Rational, 2>&);
template double evaluate(const Mask<double>&, const std::array<double, 1>&);
template double evaluate(const Mask2<double>&, const std::array<double, 2>&);
template std::complex<double> evaluate(const Mask<double>&, const std::array<std::complex<double>, 1>&);
template std::complex<double> evaluate(const Mask2<double>&, const std::array<std::complex<double>, 2>&);
template Mask<Rational> derivative(const Mask<Rational>&, const Index<1>&);
template Mask2<Rational> derivative(const Mask2<Rational>&, const Index<2>&);
template Mask<double> derivative(const Mask<double>&, const Index<1>&);
template Mask2<double> derivative(const Mask2<double>&, const Index<2>&);
template Rational sum(const Mask<Rational>&);
template Rational sum(const Mask2<Rational>&);
template double sum(const Mask<double>&);
template double sum(const Mask2<double>&);
template Rational absolute_sum(const Mask<Rational>&);
template Rational absolute_sum(const Mask2<Rational>&);
template double absolute_sum(const Mask<double>&);
template double absolute_sum(const Mask2<double>&);

}  // namespace batten
