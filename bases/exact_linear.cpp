// SPDX-License-Identifier: MIT
#include <batten/bases/exact_linear.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <string>

namespace batten {
namespace {

void require_shape(bool holds, const char* function, int found, int expected) {
  if (!holds)
    throw InvalidInput(std::string(function) + ": sizes must fit, found " + std::to_string(found) + " against " +
                       std::to_string(expected));
}

/// row i += factor * row j, from column `from` on.
void add_row(RationalMatrix& a, int i, const Rational& factor, int j, int from = 0) {
  for (int k = from; k < a.columns(); ++k)
    if (a(j, k) != 0) a(i, k) += factor * a(j, k);
}

void swap_rows(RationalMatrix& a, int i, int j) {
  if (i == j) return;
  for (int k = 0; k < a.columns(); ++k) std::swap(a(i, k), a(j, k));
}

void swap_columns(RationalMatrix& a, int i, int j) {
  if (i == j) return;
  for (int k = 0; k < a.rows(); ++k) std::swap(a(k, i), a(k, j));
}

/// The first row from `from` on that is not zero in a column; rows() when there is none.
int row_with_entry(const RationalMatrix& a, int from, int column) {
  int row = from;
  while (row < a.rows() && a(row, column) == 0) ++row;
  return row;
}

/// A similar matrix that is zero below the first subdiagonal.
void reduce_to_hessenberg(RationalMatrix& a) {
  for (int c = 0; c + 2 < a.rows(); ++c) {
    const int pivot = row_with_entry(a, c + 1, c);
    if (pivot == a.rows()) continue;
    swap_rows(a, pivot, c + 1);
    swap_columns(a, pivot, c + 1);
    for (int i = c + 2; i < a.rows(); ++i) {
      if (a(i, c) == 0) continue;
      const Rational factor = a(i, c) / a(c + 1, c);
      add_row(a, i, -factor, c + 1, c);
      for (int k = 0; k < a.rows(); ++k)  // the inverse operation on columns
        if (a(k, i) != 0) a(k, c + 1) += factor * a(k, i);
    }
  }
}

void drop_leading_zeros(std::vector<Rational>& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

}  // namespace

RationalMatrix::RationalMatrix(int rows, int columns)
    : rows_(rows), columns_(columns), entries_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)) {}

RationalMatrix RationalMatrix::identity(int size) {
  RationalMatrix result(size, size);
  for (int i = 0; i < size; ++i) result(i, i) = 1;
  return result;
}

RationalMatrix operator*(const RationalMatrix& a, const RationalMatrix& b) {
  require_shape(a.columns() == b.rows(), "RationalMatrix product", a.columns(), b.rows());
  RationalMatrix result(a.rows(), b.columns());
  for (int i = 0; i < a.rows(); ++i)
    for (int k = 0; k < a.columns(); ++k) {
      if (a(i, k) == 0) continue;
      for (int j = 0; j < b.columns(); ++j)
        if (b(k, j) != 0) result(i, j) += a(i, k) * b(k, j);
    }
  return result;
}

std::vector<Rational> operator*(const RationalMatrix& a, const std::vector<Rational>& v) {
  require_shape(a.columns() == static_cast<int>(v.size()), "RationalMatrix times vector", a.columns(),
                static_cast<int>(v.size()));
  std::vector<Rational> result(static_cast<std::size_t>(a.rows()));
  for (int i = 0; i < a.rows(); ++i)
    for (int k = 0; k < a.columns(); ++k)
      if (a(i, k) != 0) result[static_cast<std::size_t>(i)] += a(i, k) * v[static_cast<std::size_t>(k)];
  return result;
}

RationalMatrix stacked(const RationalMatrix& a, const RationalMatrix& b) {
  require_shape(a.columns() == b.columns(), "stacked", a.columns(), b.columns());
  RationalMatrix result(a.rows() + b.rows(), a.columns());
  for (int i = 0; i < result.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) result(i, j) = i < a.rows() ? a(i, j) : b(i - a.rows(), j);
  return result;
}

Eigen::MatrixXd to_double(const RationalMatrix& a) {
  Eigen::MatrixXd result(a.rows(), a.columns());
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) result(i, j) = static_cast<double>(a(i, j));
  return result;
}

EchelonForm echelon_form(RationalMatrix a) {
  std::vector<int> pivots;
  for (int c = 0; c < a.columns() && static_cast<int>(pivots.size()) < a.rows(); ++c) {
    const int top = static_cast<int>(pivots.size()), pivot = row_with_entry(a, top, c);
    if (pivot == a.rows()) continue;
    swap_rows(a, pivot, top);
    const Rational scale = 1 / a(top, c);
    for (int k = c; k < a.columns(); ++k) a(top, k) *= scale;
    for (int i = 0; i < a.rows(); ++i)
      if (i != top && a(i, c) != 0) add_row(a, i, Rational(-a(i, c)), top, c);
    pivots.push_back(c);
  }
  RationalMatrix rows(static_cast<int>(pivots.size()), a.columns());
  for (int i = 0; i < rows.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) rows(i, j) = a(i, j);
  return {std::move(rows), std::move(pivots)};
}

std::vector<std::vector<Rational>> null_space(const RationalMatrix& a) {
  const EchelonForm form = echelon_form(a);
  std::vector<std::vector<Rational>> basis;
  for (int free = 0; free < a.columns(); ++free) {
    if (std::binary_search(form.pivots.begin(), form.pivots.end(), free)) continue;
    std::vector<Rational> v(static_cast<std::size_t>(a.columns()));
    v[static_cast<std::size_t>(free)] = 1;
    for (int i = 0; i < form.rows.rows(); ++i)
      v[static_cast<std::size_t>(form.pivots[static_cast<std::size_t>(i)])] = -form.rows(i, free);
    basis.push_back(std::move(v));
  }
  return basis;
}

std::vector<Rational> characteristic_polynomial(RationalMatrix a) {
  require_shape(a.rows() == a.columns(), "characteristic_polynomial", a.rows(), a.columns());
  reduce_to_hessenberg(a);
  // p_k, of the leading k x k block: p_k = (λ - h_kk) p_(k-1) - Σ_i h_ik (h_(i+1)i ... h_k(k-1)) p_(i-1)
  std::vector<std::vector<Rational>> p = {{1}};
  for (int k = 0; k < a.rows(); ++k) {
    std::vector<Rational> next(static_cast<std::size_t>(k) + 2);
    for (std::size_t j = 0; j <= static_cast<std::size_t>(k); ++j) next[j + 1] = p.back()[j];
    Rational below = 1;
    for (int i = k; i >= 0 && below != 0; --i) {
      const Rational factor = below * a(i, k);
      const auto& earlier = p[static_cast<std::size_t>(i)];
      for (std::size_t j = 0; factor != 0 && j < earlier.size(); ++j) next[j] -= factor * earlier[j];
      if (i > 0) below *= a(i, i - 1);
    }
    p.push_back(std::move(next));
  }
  return p.back();
}

bool has_root_not_inside(std::vector<Rational> p, const Rational& radius) {
  drop_leading_zeros(p);
  if (p.empty()) throw InvalidInput("has_root_not_inside: the polynomial must not be zero");
  p.erase(p.begin(), std::find_if(p.begin(), p.end(), [](const Rational& c) { return c != 0; }));  // roots at zero
  Rational scale = 1;
  for (Rational& c : p) {
    c *= scale;
    scale *= radius;
  }
  // Schur's transform: p has all roots in |z| < 1 when and only when |p_0| < |p_d| and (p - (p_0/p_d) p*)/z has.
  while (p.size() > 1) {
    const Rational ratio = p.front() / p.back();
    if (abs(ratio) >= 1) return true;
    std::vector<Rational> next(p.size() - 1);
    for (std::size_t i = 1; i < p.size(); ++i) next[i - 1] = p[i] - ratio * p[p.size() - 1 - i];
    const Rational lead = next.back();
    for (Rational& c : next) c /= lead;
    p = std::move(next);
  }
  return false;
}

std::vector<Rational> without_root(std::vector<Rational> p, const Rational& root, int times) {
  for (int n = 0; n < times && p.size() > 1; ++n) {
    std::vector<Rational> quotient(p.size() - 1);
    Rational carry = 0;
    for (std::size_t i = p.size() - 1; i > 0; --i) quotient[i - 1] = carry = p[i] + root * carry;
    if (p[0] + root * carry != 0) break;
    p = std::move(quotient);
  }
  return p;
}

}  // namespace batten
