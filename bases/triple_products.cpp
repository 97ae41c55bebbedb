// SPDX-License-Identifier: MIT
#include <batten/bases/derivative_mask.h>
#include <batten/bases/triple_products.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

template <int D>
Index<2 * D> joined(const Index<D>& i, const Index<D>& j) {
  Index<2 * D> both{};
  for (std::size_t d = 0; d < D; ++d) {
    both[d] = i[d];
    both[D + d] = j[d];
  }
  return both;
}

template <int D>
Index<D> difference(const Index<D>& i, const Index<D>& j) {
  Index<D> result = i;
  for (std::size_t d = 0; d < D; ++d) result[d] -= j[d];
  return result;
}

/// Σ_pqw a[p] b[q] c[w] x^(p - q) y^(p - w)
template <int D>
Terms<2 * D> correlation(const LaurentPolynomial<Rational, D>& a, const LaurentPolynomial<Rational, D>& b,
                         const LaurentPolynomial<Rational, D>& c) {
  Terms<2 * D> result;
  const auto b_terms = terms_of(b), c_terms = terms_of(c);
  for (const auto& [p, x] : terms_of(a))
    for (const auto& [q, y] : b_terms) {
      const Rational xy = x * y;
      for (const auto& [w, z] : c_terms) result[joined<D>(difference<D>(p, q), difference<D>(p, w))] += xy * z;
    }
  std::erase_if(result, [](const auto& term) { return term.second == 0; });
  return result;
}

template <int D>
Index<2 * D> unit(std::size_t d) {
  Index<2 * D> result{};
  result[d] = 1;
  return result;
}

/// (-1)^(|b| + |c|) (∂_i + ∂_j)^a ∂_i^b ∂_j^c
template <int D>
Terms<2 * D> derivative_of(const Index<D>& a, const Index<D>& b, const Index<D>& c) {
  constexpr int E = 2 * D;
  Terms<E> P = {{joined<D>(b, c), Rational((total(b) + total(c)) % 2 ? -1 : 1)}};
  for (std::size_t d = 0; d < D; ++d)
    for (int k = 0; k < a[d]; ++k) P = product<E>(P, {{unit<D>(d), Rational(1)}, {unit<D>(D + d), Rational(1)}});
  return P;
}

template <int D>
void require_common_grid(const Factor<D>& n, const Factor<D>& other) {
  if (n.scheme.arity() != other.scheme.arity())
    throw InvalidInput("TripleProducts: the schemes must have the same arity, found " +
                       std::to_string(n.scheme.arity()) + " and " + std::to_string(other.scheme.arity()));
  if (n.scheme.exact_mask().half() != other.scheme.exact_mask().half())
    throw InvalidInput("TripleProducts: the masks must have the same half shifts, found others in " +
                       other.scheme.name() + " than in " + n.scheme.name());
}

}  // namespace

template <int D>
TripleProducts<D>::TripleProducts(const Factor<D>& n, const Factor<D>& m, const Factor<D>& l) {
  const int arity = n.scheme.arity();
  require_common_grid(n, m);
  require_common_grid(n, l);
  for (const auto* factor : {&n, &m, &l}) require_affine_invariance(factor->scheme);
  const auto a = derivative_mask(n.scheme.exact_mask(), arity, n.derivative);
  const auto b = derivative_mask(m.scheme.exact_mask(), arity, m.derivative);
  const auto c = derivative_mask(l.scheme.exact_mask(), arity, l.derivative);
  const auto mask = correlation(Rational(1, integer_power(arity, D)) * a.mask, b.mask, c.mask);
  const auto values =
      integer_values(RefinementEquation<2 * D>{mask, arity, derivative_of<D>(a.remaining, b.remaining, c.remaining)});
  if (!values)
    throw InvalidInput(
        "TripleProducts: the integral of the product of these derivatives must exist, found that it does not for " +
        n.scheme.name() + ", " + m.scheme.name() + " and " + l.scheme.name());
  terms_ = product<2 * D>(correlation(difference_mask<D>(a.differences), difference_mask<D>(b.differences),
                                      difference_mask<D>(c.differences)),
                          *values);
}

template <int D>
Rational TripleProducts<D>::operator()(const Index<D>& i, const Index<D>& j) const {
  const auto term = terms_.find(joined<D>(i, j));
  return term == terms_.end() ? Rational(0) : term->second;
}

template class TripleProducts<1>;
template class TripleProducts<2>;

}  // namespace batten
