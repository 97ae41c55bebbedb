// SPDX-License-Identifier: MIT
#include <batten/bases/sum_rules.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

template <int D>
int number_of_cosets(int arity) {
  return D == 1 ? arity : arity * arity;
}

/// The exponents of ∂^order, |order| = degree.
template <int D>
std::vector<Index<D>> orders_of_degree(int degree) {
  if constexpr (D == 1) {
    return {Index<1>{degree}};
  } else {
    std::vector<Index<2>> orders;
    for (int j = 0; j <= degree; ++j) orders.push_back({degree - j, j});
    return orders;
  }
}

Rational power_of(const Rational& x, int n) {
  Rational result = 1;
  for (int k = 0; k < n; ++k) result *= x;
  return result;
}

int residue(int i, int arity) { return ((i % arity) + arity) % arity; }

/// For each coset Σ i^order s[i] over its indices i.
template <int D>
std::vector<Rational> coset_moments(const LaurentPolynomial<Rational, D>& s, const Index<D>& order, int arity) {
  std::vector<Rational> moments(static_cast<std::size_t>(number_of_cosets<D>(arity)));
  const int row = s.size()[0];
  for (int k = 0; k < static_cast<int>(s.coefficients().size()); ++k) {
    const Index<2> at = {k % row, k / row};
    Rational term = s.coefficients()[static_cast<std::size_t>(k)];
    int coset = 0;
    for (int d = D - 1; d >= 0; --d) {
      const auto u = static_cast<std::size_t>(d);
      const int i = s.first()[u] + at[u];
      term *= power_of(i, order[u]);
      coset = arity * coset + residue(i, arity);
    }
    moments[static_cast<std::size_t>(coset)] += term;
  }
  return moments;
}

template <int D>
bool has_equal_moments(const LaurentPolynomial<Rational, D>& s, int degree, int arity) {
  for (const Index<D>& order : orders_of_degree<D>(degree)) {
    const auto moments = coset_moments(s, order, arity);
    for (const Rational& m : moments)
      if (m != moments.front()) return false;
  }
  return true;
}

/// c (c - 1) ... (c - n + 1)
Rational falling_factorial(const Rational& c, int n) {
  Rational result = 1;
  for (int k = 0; k < n; ++k) result *= c - k;
  return result;
}

/// Whether ∂^order s(1) = arity^D ∏_d τ_d (τ_d - 1) ... for all |order| = degree [Conti & Hormann 2011].
template <int D>
bool reproduces_degree(const LaurentPolynomial<Rational, D>& s, const Coordinates<Rational, D>& tau, int degree,
                       int arity) {
  for (const Index<D>& order : orders_of_degree<D>(degree)) {
    Rational expected = number_of_cosets<D>(arity);
    for (std::size_t d = 0; d < D; ++d) expected *= falling_factorial(tau[d], order[d]);
    if (sum(derivative(s, order)) != expected) return false;
  }
  return true;
}

}  // namespace

template <int D>
int sum_rule_order(const LaurentPolynomial<Rational, D>& s, int arity) {
  if (s.is_zero()) throw InvalidInput("sum_rule_order: the mask must not be zero");
  if (arity != 2 && arity != 3)
    throw InvalidInput("sum_rule_order: the arity must be 2 or 3, found " + std::to_string(arity));
  int order = 0;  // ends: no mask but zero has a zero of order beyond its size
  while (has_equal_moments(s, order, arity)) ++order;
  return order;
}

template <int D>
PolynomialDegrees<D> polynomial_degrees(const LaurentPolynomial<Rational, D>& s, int arity) {
  PolynomialDegrees<D> degrees;
  degrees.generated = sum_rule_order(s, arity) - 1;
  Coordinates<Rational, D> tau;
  for (std::size_t d = 0; d < D; ++d) {
    Index<D> first{};
    first[d] = 1;
    tau[d] = sum(derivative(s, first)) / number_of_cosets<D>(arity);
    degrees.shift[d] = tau[d] / (arity - 1);
  }
  degrees.reproduced = -1;
  while (degrees.reproduced < degrees.generated && reproduces_degree(s, tau, degrees.reproduced + 1, arity))
    ++degrees.reproduced;
  return degrees;
}

template int sum_rule_order(const Mask<Rational>&, int);
template int sum_rule_order(const Mask2<Rational>&, int);
template PolynomialDegrees<1> polynomial_degrees(const Mask<Rational>&, int);
template PolynomialDegrees<2> polynomial_degrees(const Mask2<Rational>&, int);

}  // namespace batten
