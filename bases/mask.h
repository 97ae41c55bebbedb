// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/rational.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace batten {

/// What a mask may be made of: exact rationals, or doubles.
template <class T>
concept Coefficient = std::same_as<T, Rational> || std::same_as<T, double>;

/// A point of Z^D, x first.
template <int D>
using Index = std::array<int, static_cast<std::size_t>(D)>;

/// A finite Laurent polynomial Σ_i c[i] x^(i + half/2), i in Z^D, in D = 1 or 2 variables; half is 0 or 1 in each. Half
/// powers are real shifts, as in the staggered difference d[x] = x^(-1/2) - x^(1/2) [Warren & Weimer 2001, sec. 5.3].
///
/// Stored on the smallest box first() .. last() that holds all non-zero coefficients, x fastest; zero is the empty box.
/// A value: operations return new polynomials.
template <Coefficient T, int D>
class LaurentPolynomial {
public:
  static constexpr int dimension = D;

  /// Zero.
  LaurentPolynomial() = default;
  /// Coefficient of first + k, k in the box of the given size, at coefficients[k_x + size_x k_y]. Throws InvalidInput
  /// when the count or the sizes do not fit, a coefficient is not finite, or half is not 0 or 1.
  LaurentPolynomial(const Index<D>& first, const Index<D>& size, std::vector<T> coefficients,
                    const Index<D>& half = {});
  /// Σ_k coefficients[k] x^(first + k + half/2).
  template <int N = D>
  requires(N == 1) LaurentPolynomial(int first, std::vector<T> coefficients, int half = 0)
      // braces: the size is taken before the coefficients move
      : LaurentPolynomial{Index<1>{first}, Index<1>{static_cast<int>(coefficients.size())}, std::move(coefficients),
                          Index<1>{half}} {}
  /// c x^(exponent + half/2); a constant for exponent 0.
  static LaurentPolynomial monomial(const Index<D>& exponent, const T& c = T(1), const Index<D>& half = {}) {
    Index<D> one;
    one.fill(1);
    return {exponent, one, {c}, half};
  }
  static LaurentPolynomial constant(const T& c) { return monomial(Index<D>{}, c); }

  const Index<D>& first() const { return first_; }
  /// One less than first() for zero.
  Index<D> last() const;
  const Index<D>& size() const { return size_; }
  /// Exponents are i + half()/2.
  const Index<D>& half() const { return half_; }
  bool is_zero() const { return coefficients_.empty(); }
  /// All of first() .. last(), x fastest.
  std::span<const T> coefficients() const { return coefficients_; }
  /// c[i], zero outside the box.
  T operator[](const Index<D>& i) const;
  template <int N = D>
  requires(N == 1) T operator[](int i) const { return (*this)[Index<1>{i}]; }

  /// Sums throw InvalidInput when the powers of one side are shifted by a half against those of the other. Zero has no
  /// shift.
  LaurentPolynomial& operator+=(const LaurentPolynomial& other) { return add(other, T(1)); }
  LaurentPolynomial& operator-=(const LaurentPolynomial& other) { return add(other, T(-1)); }
  LaurentPolynomial& operator*=(const LaurentPolynomial& other) { return *this = product(other); }
  LaurentPolynomial& operator*=(const T& factor);

  friend LaurentPolynomial operator+(LaurentPolynomial a, const LaurentPolynomial& b) { return a += b; }
  friend LaurentPolynomial operator-(LaurentPolynomial a, const LaurentPolynomial& b) { return a -= b; }
  friend LaurentPolynomial operator-(LaurentPolynomial a) { return a *= T(-1); }
  friend LaurentPolynomial operator*(const LaurentPolynomial& a, const LaurentPolynomial& b) { return a.product(b); }
  friend LaurentPolynomial operator*(const T& factor, LaurentPolynomial a) { return a *= factor; }
  friend LaurentPolynomial operator*(LaurentPolynomial a, const T& factor) { return a *= factor; }
  friend bool operator==(const LaurentPolynomial&, const LaurentPolynomial&) = default;

private:
  LaurentPolynomial& add(const LaurentPolynomial& other, const T& factor);
  LaurentPolynomial product(const LaurentPolynomial& other) const;
  void trim();

  Index<D> first_{};
  Index<D> size_{};
  Index<D> half_{};
  std::vector<T> coefficients_;
};

template <Coefficient T>
using Mask = LaurentPolynomial<T, 1>;
template <Coefficient T>
using Mask2 = LaurentPolynomial<T, 2>;

// What follows exists for T = Rational and double, D = 1 and 2. Exact division is in mask_division.h, values and
// derivatives in mask_values.h, reading and writing in mask_text.h, matrices in mask_matrix.h.

/// s[x^n] (s[x^n, y^n]), n >= 1.
template <Coefficient T, int D>
LaurentPolynomial<T, D> upsampled(const LaurentPolynomial<T, D>& s, int n);
/// s[1/x] (s[1/x, 1/y]).
template <Coefficient T, int D>
LaurentPolynomial<T, D> reflected(const LaurentPolynomial<T, D>& s);
/// x^by s[x].
template <Coefficient T, int D>
LaurentPolynomial<T, D> shifted(const LaurentPolynomial<T, D>& s, const Index<D>& by);
/// s times the power of x, possibly a half one, that makes the smallest and largest exponents opposite.
template <Coefficient T, int D>
LaurentPolynomial<T, D> centred(const LaurentPolynomial<T, D>& s);
/// s[x]^n, n >= 0.
template <Coefficient T, int D>
LaurentPolynomial<T, D> power(const LaurentPolynomial<T, D>& s, int n);
/// The polynomial with c[e] = s[arity e + residue]; the rule of the new points of one kind. Indices as stored: a half
/// shift of s is dropped.
template <Coefficient T, int D>
LaurentPolynomial<T, D> coset(const LaurentPolynomial<T, D>& s, const Index<D>& residue, int arity = 2);
template <Coefficient T>
Mask<T> coset(const Mask<T>& s, int residue, int arity = 2) {
  return coset(s, Index<1>{residue}, arity);
}
/// The product over i of s[x^(arity^i)], i = 0 .. steps - 1: the mask of so many rounds at once, one for none.
template <Coefficient T, int D>
LaurentPolynomial<T, D> iterated(const LaurentPolynomial<T, D>& s, int steps, int arity = 2);

/// s[y, x].
template <Coefficient T>
Mask2<T> swapped(const Mask2<T>& s);
/// a[x] b[y].
template <Coefficient T>
Mask2<T> tensor_product(const Mask<T>& a, const Mask<T>& b);

/// Each coefficient rounded once.
template <int D>
LaurentPolynomial<double, D> to_double(const LaurentPolynomial<Rational, D>& s);

}  // namespace batten
