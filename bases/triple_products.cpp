// SPDX-License-Identifier: MIT
#include <batten/bases/derivative_mask.h>
#include <batten/bases/index_box.h>
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

/// Σ_pqw a[p] b[q] c[w] x^(p - q) y^(p - w)
template <int D>
Terms<2 * D> correlation(const LaurentPolynomial<Rational, D>& a, const LaurentPolynomial<Rational, D>& b,
                         const LaurentPolynomial<Rational, D>& c) {
  Terms<2 * D> result;
  const auto b_terms = terms_of(b), c_terms = terms_of(c);
  for (const auto& [p, x] : terms_of(a))
    for (const auto& [q, y] : b_terms) {
      const Rational xy = x * y;
      for (const auto& [w, z] : c_terms) result[joined<D>(difference(p, q), difference(p, w))] += xy * z;
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

/// All integrals, by the refinement equation that they satisfy together.
template <int D>
Terms<2 * D> solved_products(const Factor<D>& n, const Factor<D>& m, const Factor<D>& l) {
  const int arity = n.scheme.arity();
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
  return product<2 * D>(correlation(difference_mask<D>(a.differences), difference_mask<D>(b.differences),
                                    difference_mask<D>(c.differences)),
                        *values);
}

/// The factors of n in x and in y where the mask is s[x, 1] s[1, y] / arity^2.
std::optional<std::array<Factor<1>, 2>> separated(const Factor<2>& n) {
  const auto& s = n.scheme.exact_mask();
  const int arity = n.scheme.arity();
  std::array<std::vector<Rational>, 2> sums;
  for (std::size_t d = 0; d < 2; ++d) sums[d].resize(static_cast<std::size_t>(s.size()[d]));
  const std::size_t row = sums[0].size();
  for (std::size_t k = 0; k < s.coefficients().size(); ++k) {
    sums[0][k % row] += s.coefficients()[k] / arity;
    sums[1][k / row] += s.coefficients()[k] / arity;
  }
  const Mask<Rational> x(s.first()[0], sums[0], s.half()[0]), y(s.first()[1], sums[1], s.half()[1]);
  if (tensor_product(x, y) != s) return std::nullopt;
  return std::array{Factor<1>{{n.scheme.name(), x, arity}, {n.derivative[0]}},
                    Factor<1>{{n.scheme.name(), y, arity}, {n.derivative[1]}}};
}

/// Products of integrals in x and in y, where all three functions are such products.
std::optional<Terms<4>> separated_products(const Factor<2>& n, const Factor<2>& m, const Factor<2>& l) {
  const auto a = separated(n), b = separated(m), c = separated(l);
  if (!a || !b || !c) return std::nullopt;
  Terms<4> result;
  const auto in_y = solved_products((*a)[1], (*b)[1], (*c)[1]);
  for (const auto& [x, of_x] : solved_products((*a)[0], (*b)[0], (*c)[0]))
    for (const auto& [y, of_y] : in_y) result.emplace(Index<4>{x[0], y[0], x[1], y[1]}, of_x * of_y);
  return result;
}

}  // namespace

template <int D>
TripleProducts<D>::TripleProducts(const Factor<D>& n, const Factor<D>& m, const Factor<D>& l) {
  require_common_grid(n, m);
  require_common_grid(n, l);
  for (const auto* factor : {&n, &m, &l}) require_affine_invariance(factor->scheme);
  if constexpr (D == 2) {
    if (auto products = separated_products(n, m, l)) {
      terms_ = std::move(*products);
      return;
    }
  }
  terms_ = solved_products(n, m, l);
}

template <int D>
Rational TripleProducts<D>::operator()(const Index<D>& i, const Index<D>& j) const {
  const auto term = terms_.find(joined<D>(i, j));
  return term == terms_.end() ? Rational(0) : term->second;
}

template class TripleProducts<1>;
template class TripleProducts<2>;

}  // namespace batten
