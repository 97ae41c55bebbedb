// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/rational.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace batten {

/// A small dense matrix of exact numbers.
class RationalMatrix {
public:
  /// Zeros.
  RationalMatrix(int rows, int columns);
  static RationalMatrix identity(int size);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const Rational& operator()(int i, int j) const { return entries_[place(i, j)]; }
  Rational& operator()(int i, int j) { return entries_[place(i, j)]; }
  friend bool operator==(const RationalMatrix&, const RationalMatrix&) = default;

private:
  std::size_t place(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(j);
  }

  int rows_, columns_;
  std::vector<Rational> entries_;
};

// Shapes that do not fit throw InvalidInput.

RationalMatrix operator*(const RationalMatrix& a, const RationalMatrix& b);
std::vector<Rational> operator*(const RationalMatrix& a, const std::vector<Rational>& v);
/// The rows of a above those of b.
RationalMatrix stacked(const RationalMatrix& a, const RationalMatrix& b);
/// Each entry rounded once.
Eigen::MatrixXd to_double(const RationalMatrix& a);

/// The reduced row echelon form without its zero rows: the columns `pivots` of `rows` are the identity.
struct EchelonForm {
  RationalMatrix rows;
  std::vector<int> pivots;
};
EchelonForm echelon_form(RationalMatrix a);
/// A basis of {v : a v = 0}, a vector each.
std::vector<std::vector<Rational>> null_space(const RationalMatrix& a);
/// det(λ - a), the coefficient of λ^i at i.
std::vector<Rational> characteristic_polynomial(RationalMatrix a);

/// Whether Σ_i p[i] λ^i has a root |λ| >= radius, exactly: the test of [Schur 1917] fails when and only when it has.
/// The radius is positive; a constant has no root. Throws InvalidInput when p is zero.
bool has_root_not_inside(std::vector<Rational> p, const Rational& radius);
/// p with the root divided out at most `times` times.
std::vector<Rational> without_root(std::vector<Rational> p, const Rational& root, int times);

}  // namespace batten
