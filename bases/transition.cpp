// SPDX-License-Identifier: MIT
#include <batten/bases/index_box.h>
#include <batten/bases/transition.h>

#include <algorithm>
#include <set>

namespace batten {
namespace {

/// Exponents where s is not zero.
template <int D>
std::vector<Index<D>> exponents(const LaurentPolynomial<Rational, D>& s) {
  std::vector<Index<D>> found;
  for (const Index<D>& k : indices_of(IndexBox<D>{s.first(), s.last()}))
    if (s[k] != 0) found.push_back(k);
  return found;
}

/// The j with i + e - arity j in the exponents.
template <int D>
std::vector<Index<D>> sources(const Index<D>& i, const std::vector<Index<D>>& exponents, int arity) {
  std::vector<Index<D>> found;
  for (const Index<D>& e : digits<D>(arity))
    for (const Index<D>& k : exponents) {
      Index<D> j{};
      bool whole = true;
      for (std::size_t d = 0; d < D; ++d) {
        const int multiple = i[d] + e[d] - k[d];
        j[d] = floor_quotient(multiple, arity);
        whole = whole && arity * j[d] == multiple;
      }
      if (whole) found.push_back(j);
    }
  return found;
}

template <int D>
std::vector<Index<D>> simplex_at(const Index<D>& corner, int order) {
  IndexBox<D> box{corner, corner};
  for (int& last : box.last) last += order;
  std::vector<Index<D>> simplex;
  for (const Index<D>& j : indices_of(box)) {
    int degree = 0;
    for (std::size_t d = 0; d < D; ++d) degree += j[d] - corner[d];
    if (degree <= order) simplex.push_back(j);
  }
  return simplex;
}

template <int D>
std::vector<Index<D>> closure(const std::vector<Index<D>>& start, const std::vector<Index<D>>& exponents, int arity) {
  std::set<Index<D>> window(start.begin(), start.end());
  std::vector<Index<D>> open = start;
  while (!open.empty()) {
    const Index<D> i = open.back();
    open.pop_back();
    for (const Index<D>& j : sources<D>(i, exponents, arity))
      if (window.insert(j).second) open.push_back(j);
  }
  return {window.begin(), window.end()};
}

/// The monomials of degree < order as rows over the window.
template <int D>
RationalMatrix monomials_on(const std::vector<Index<D>>& window, int order) {
  const auto degrees = simplex_at<D>(Index<D>{}, order - 1);
  RationalMatrix rows(static_cast<int>(degrees.size()), static_cast<int>(window.size()));
  for (int p = 0; p < rows.rows(); ++p)
    for (int i = 0; i < rows.columns(); ++i) {
      rows(p, i) = 1;
      for (std::size_t d = 0; d < D; ++d)
        for (int n = 0; n < degrees[static_cast<std::size_t>(p)][d]; ++n)
          rows(p, i) *= window[static_cast<std::size_t>(i)][d];
    }
  return rows;
}

}  // namespace

template <int D>
std::vector<Index<D>> digits(int arity) {
  IndexBox<D> box;
  box.last.fill(arity - 1);
  return indices_of(box);
}

template <int D>
bool is_invariant(const std::vector<Index<D>>& window, const LaurentPolynomial<Rational, D>& s, int arity) {
  const std::set<Index<D>> members(window.begin(), window.end());
  const auto powers = exponents(s);
  return std::all_of(window.begin(), window.end(), [&](const Index<D>& i) {
    const auto needed = sources<D>(i, powers, arity);
    return std::all_of(needed.begin(), needed.end(), [&](const Index<D>& j) { return members.contains(j); });
  });
}

template <int D>
bool holds_differences(const std::vector<Index<D>>& window, int order) {
  const std::set<Index<D>> members(window.begin(), window.end());
  return std::any_of(window.begin(), window.end(), [&](const Index<D>& corner) {
    const auto simplex = simplex_at<D>(corner, order);
    return std::all_of(simplex.begin(), simplex.end(), [&](const Index<D>& j) { return members.contains(j); });
  });
}

template <int D>
std::vector<Index<D>> transition_window(const LaurentPolynomial<Rational, D>& s, int arity, int order) {
  const auto powers = exponents(s);
  IndexBox<D> corners;  // those from which the simplex lies near the indices that any window has
  for (std::size_t d = 0; d < D; ++d) {
    corners.first[d] = floor_quotient(-s.last()[d], arity - 1) - 1;
    corners.last[d] = -floor_quotient(s.first()[d], arity - 1) + 1;
  }
  std::vector<Index<D>> best;
  for (const Index<D>& corner : indices_of(corners)) {
    auto window = closure<D>(simplex_at<D>(corner, order), powers, arity);
    if (best.empty() || window.size() < best.size()) best = std::move(window);
  }
  return best;
}

template <int D>
std::vector<RationalMatrix> transition_matrices(const LaurentPolynomial<Rational, D>& s, int arity,
                                                const std::vector<Index<D>>& window, int order) {
  const EchelonForm polynomials = echelon_form(monomials_on<D>(window, order));
  const auto& pivots = polynomials.pivots;
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(window.size()); ++i)
    if (!std::binary_search(pivots.begin(), pivots.end(), i)) kept.push_back(i);
  std::vector<RationalMatrix> matrices;
  for (const Index<D>& e : digits<D>(arity)) {
    const auto entry = [&](int i, int j) {
      Index<D> k = window[static_cast<std::size_t>(i)];
      for (std::size_t d = 0; d < D; ++d) k[d] += e[d] - arity * window[static_cast<std::size_t>(j)][d];
      return s[k];
    };
    RationalMatrix a(static_cast<int>(kept.size()), static_cast<int>(kept.size()));
    for (int i = 0; i < a.rows(); ++i)
      for (int j = 0; j < a.rows(); ++j) {
        const int row = kept[static_cast<std::size_t>(i)], column = kept[static_cast<std::size_t>(j)];
        a(i, j) = entry(row, column);
        for (int b = 0; b < polynomials.rows.rows(); ++b)
          a(i, j) -= polynomials.rows(b, row) * entry(pivots[static_cast<std::size_t>(b)], column);
      }
    matrices.push_back(std::move(a));
  }
  return matrices;
}

template std::vector<Index<1>> digits<1>(int);
template std::vector<Index<2>> digits<2>(int);
template bool is_invariant(const std::vector<Index<1>>&, const Mask<Rational>&, int);
template bool is_invariant(const std::vector<Index<2>>&, const Mask2<Rational>&, int);
template bool holds_differences<1>(const std::vector<Index<1>>&, int);
template bool holds_differences<2>(const std::vector<Index<2>>&, int);
template std::vector<Index<1>> transition_window(const Mask<Rational>&, int, int);
template std::vector<Index<2>> transition_window(const Mask2<Rational>&, int, int);
template std::vector<RationalMatrix> transition_matrices(const Mask<Rational>&, int, const std::vector<Index<1>>&, int);
template std::vector<RationalMatrix> transition_matrices(const Mask2<Rational>&, int, const std::vector<Index<2>>&,
                                                         int);

}  // namespace batten
