// SPDX-License-Identifier: MIT
#include <batten/bases/derivative_mask.h>
#include <batten/bases/inner_products.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

template <int D>
std::string order_text(const Index<D>& order) {
  std::string text = "∂^(" + std::to_string(order[0]);
  for (std::size_t d = 1; d < D; ++d) text += ", " + std::to_string(order[d]);
  return text + ")";
}

/// Σ_j s[j] j^power, half shifts counted.
template <int D>
Rational mask_moment(const LaurentPolynomial<Rational, D>& s, const Index<D>& power) {
  const auto row = static_cast<std::size_t>(s.size()[0]);
  Rational sum = 0;
  for (std::size_t k = 0; k < s.coefficients().size(); ++k) {
    Rational term = s.coefficients()[k];
    for (std::size_t d = 0; d < D; ++d) {
      const int step = static_cast<int>(d == 0 ? k % row : k / row);
      const Rational j(2 * (s.first()[d] + step) + s.half()[d], 2);
      for (int n = 0; n < power[d]; ++n) term *= j;
    }
    sum += term;
  }
  return sum;
}

Rational binomial(int n, int k) {
  Rational result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

/// Calls work for all l with 0 <= l <= k in each direction, k last.
template <int D, std::invocable<const Index<D>&> Work>
void for_smaller(const Index<D>& k, Work&& work) {
  Index<D> l{};
  for (int y = 0; y <= (D == 1 ? 0 : k[D - 1]); ++y)
    for (int x = 0; x <= k[0]; ++x) {
      l[D - 1] = y;  // overwritten in one dimension
      l[0] = x;
      work(l);
    }
}

/// M_k from M_l, l < k: (arity^(D + |k|) - arity^D) M_k = Σ_l binomial(k, l) (Σ_j s[j] j^(k - l)) M_l.
template <int D>
Rational next_moment(const Index<D>& k, int arity, const Terms<D>& of_mask, const Terms<D>& M) {
  Rational sum = 0;
  for_smaller<D>(k, [&](const Index<D>& l) {
    if (l == k) return;
    Rational term = M.at(l);
    Index<D> rest = k;
    for (std::size_t d = 0; d < D; ++d) {
      term *= binomial(k[d], l[d]);
      rest[d] -= l[d];
    }
    sum += term * of_mask.at(rest);
  });
  return sum / (integer_power(arity, D + total(k)) - integer_power(arity, D));
}

}  // namespace

template <int D>
SubdivisionScheme<D> unit_cell_scheme(int arity) {
  Index<D> size;
  size.fill(arity);
  const auto count = static_cast<std::size_t>(D == 1 ? arity : arity * arity);
  return {"unit cell", LaurentPolynomial<Rational, D>(Index<D>{}, size, std::vector<Rational>(count, Rational(1))),
          arity};
}

template <int D>
LaurentPolynomial<Rational, D> inner_products(const Factor<D>& n, const Factor<D>& m) {
  const int arity = n.scheme.arity();
  if (m.scheme.arity() != arity)
    throw InvalidInput("inner_products: the schemes must have the same arity, found " + std::to_string(arity) +
                       " and " + std::to_string(m.scheme.arity()));
  require_affine_invariance(n.scheme);
  require_affine_invariance(m.scheme);
  Index<D> order = n.derivative;
  for (std::size_t d = 0; d < D; ++d) order[d] += m.derivative[d];
  const auto mask = Rational(1, integer_power(arity, D)) * n.scheme.exact_mask() * reflected(m.scheme.exact_mask());
  const auto values = integer_grid_values(mask, arity, order, Limit::TwoSided);
  if (!values)
    throw InvalidInput("inner_products: ∫ " + order_text<D>(n.derivative) + " n " + order_text<D>(m.derivative) +
                       " m must exist, found that it does not for " + n.scheme.name() + " and " + m.scheme.name());
  return Rational(total(m.derivative) % 2 ? -1 : 1) * *values;
}

template <int D>
LaurentPolynomial<Rational, D> cell_integrals(const Factor<D>& n) {
  return inner_products(n, Factor<D>{unit_cell_scheme<D>(n.scheme.arity())});
}

template <int D>
Rational moment(const SubdivisionScheme<D>& scheme, const Index<D>& power) {
  for (int k : power)
    if (k < 0) throw InvalidInput("moment: powers must not be negative, found " + std::to_string(k));
  const auto& s = scheme.exact_mask();
  Terms<D> of_mask, M;
  for_smaller<D>(power, [&](const Index<D>& k) { of_mask[k] = mask_moment(s, k); });
  for_smaller<D>(power, [&](const Index<D>& k) {
    M[k] = k == Index<D>{} ? Rational(1) : next_moment<D>(k, scheme.arity(), of_mask, M);
  });
  return M[power];
}

Mask<Rational> area_form(const Scheme& scheme) { return inner_products<1>({scheme}, {scheme, {1}}); }

template <Coefficient T>
T enclosed_area(const Scheme& scheme, std::span<const T> x, std::span<const T> y) {
  if (x.size() != y.size() || x.empty())
    throw InvalidInput("enclosed_area: as many x as y are needed, at least one, found " + std::to_string(x.size()) +
                       " and " + std::to_string(y.size()));
  const auto e = area_form(scheme);
  const int size = static_cast<int>(x.size());
  T area(0);
  for (int i = e.first()[0]; i <= e.last()[0]; ++i) {
    T products(0);
    for (int j = 0; j < size; ++j) {
      const int k = ((j + i) % size + size) % size;
      products += x[static_cast<std::size_t>(j)] * y[static_cast<std::size_t>(k)];
    }
    area += static_cast<T>(e[i]) * products;
  }
  return area;
}

template Scheme unit_cell_scheme<1>(int);
template Scheme2 unit_cell_scheme<2>(int);
template Mask<Rational> inner_products(const Factor<1>&, const Factor<1>&);
template Mask2<Rational> inner_products(const Factor<2>&, const Factor<2>&);
template Mask<Rational> cell_integrals(const Factor<1>&);
template Mask2<Rational> cell_integrals(const Factor<2>&);
template Rational moment(const Scheme&, const Index<1>&);
template Rational moment(const Scheme2&, const Index<2>&);
template Rational enclosed_area(const Scheme&, std::span<const Rational>, std::span<const Rational>);
template double enclosed_area(const Scheme&, std::span<const double>, std::span<const double>);

}  // namespace batten
