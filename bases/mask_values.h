// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <complex>
#include <type_traits>

namespace batten {

template <class T, int D>
using Coordinates = std::array<T, static_cast<std::size_t>(D)>;

/// s at a point. Throws InvalidInput when a negative power meets zero, or a half power a number whose root is not at
/// hand: negative, or rational and not 1.
template <Coefficient T, int D>
T evaluate(const LaurentPolynomial<T, D>& s, const Coordinates<T, D>& point);
template <Coefficient T>
T evaluate(const Mask<T>& s, const std::type_identity_t<T>& point) {
  return evaluate(s, std::array<T, 1>{point});
}

/// s at a complex point, principal root for half powers. s at e^(-iω) is its Fourier series.
template <int D>
std::complex<double> evaluate(const LaurentPolynomial<double, D>& s, const Coordinates<std::complex<double>, D>& point);
inline std::complex<double> evaluate(const Mask<double>& s, std::complex<double> point) {
  return evaluate(s, std::array<std::complex<double>, 1>{point});
}

/// ∂^order s, a Laurent polynomial; the order is not negative.
template <Coefficient T, int D>
LaurentPolynomial<T, D> derivative(const LaurentPolynomial<T, D>& s, const Index<D>& order);
template <Coefficient T>
Mask<T> derivative(const Mask<T>& s, int order = 1) {
  return derivative(s, Index<1>{order});
}

/// s at 1: the sum of the coefficients.
template <Coefficient T, int D>
T sum(const LaurentPolynomial<T, D>& s);
/// Σ |c[i]|.
template <Coefficient T, int D>
T absolute_sum(const LaurentPolynomial<T, D>& s);

}  // namespace batten
