// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

namespace batten {

/// A matrix of Laurent polynomials, as in (t_ij) of [Warren & Weimer 2001, th. 3.10] and (s_ij) of vector schemes.
///
/// An entry's powers may be shifted by a half against another's, where products and sums still agree.
template <Coefficient T, int D>
class MaskMatrix {
public:
  using Entry = LaurentPolynomial<T, D>;

  /// Zeros.
  MaskMatrix(int rows, int columns);
  /// entries[column + columns * row]. Throws InvalidInput unless there are rows * columns of them.
  MaskMatrix(int rows, int columns, std::vector<Entry> entries);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const Entry& operator()(int i, int j) const { return entries_[place(i, j)]; }
  Entry& operator()(int i, int j) { return entries_[place(i, j)]; }

  friend bool operator==(const MaskMatrix&, const MaskMatrix&) = default;

private:
  std::size_t place(int i, int j) const { return static_cast<std::size_t>(i * columns_ + j); }

  int rows_, columns_;
  std::vector<Entry> entries_;
};

// Shapes that do not fit throw InvalidInput.

template <Coefficient T, int D>
MaskMatrix<T, D> operator+(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b);
template <Coefficient T, int D>
MaskMatrix<T, D> operator-(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b);
template <Coefficient T, int D>
MaskMatrix<T, D> operator*(const MaskMatrix<T, D>& a, const MaskMatrix<T, D>& b);
/// Each entry times s.
template <Coefficient T, int D>
MaskMatrix<T, D> operator*(const LaurentPolynomial<T, D>& s, const MaskMatrix<T, D>& a);
/// a v, v a column of polynomials.
template <Coefficient T, int D>
std::vector<LaurentPolynomial<T, D>> applied(const MaskMatrix<T, D>& a, const std::vector<LaurentPolynomial<T, D>>& v);

/// Each entry at x^n.
template <Coefficient T, int D>
MaskMatrix<T, D> upsampled(const MaskMatrix<T, D>& a, int n);
template <Coefficient T, int D>
MaskMatrix<T, D> transposed(const MaskMatrix<T, D>& a);
template <Coefficient T, int D>
MaskMatrix<T, D> identity_mask_matrix(int size);

}  // namespace batten
