// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/even_stencil.h>
#include <batten/bases/repeated_rows.h>
#include <batten/bases/tensor_sum.h>
#include <batten/fem/difference_rows.h>
#include <batten/fem/energy.h>
#include <batten/fem/spline_space.h>
#include <batten/fem/symmetric_stencil.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// E of an energy on a spline space: c · (E c) is the energy of the spline with coefficients c. Symmetric positive
/// semidefinite. On a periodic space it takes coefficients with their images and gives forces on the originals, 0 for
/// images.
///
/// Of an energy with constant coefficients it is built from exact one-dimensional inner products, E = Σ weight ∫∫ (...)
/// ⊗ (...), and applied as a sum of Kronecker products; no matrix is stored [Warren & Weimer 2001, sec. 6.1]. Varying
/// coefficients are kept as a symmetric stencil.
class Operator {
public:
  Operator(const Energy& energy, const SplineSpace& space);
  /// Of varying coefficients, integrated image by image.
  Operator(SymmetricStencil stencil, const SplineSpace& space)
      : images_x_(space.x.images()), images_y_(space.y.images()), stencil_(std::move(stencil)) {}

  int rows() const { return products_ ? products_->output_rows() : stencil_.rows(); }
  int columns() const { return products_ ? products_->output_columns() : stencil_.columns(); }
  std::size_t size() const { return static_cast<std::size_t>(rows()) * static_cast<std::size_t>(columns()); }

  /// Row j of E c: writes columns() numbers to `out`. One thread.
  void row(int j, std::span<const double> c, double* out) const { folded_row(j, c, out, false); }
  /// The same by differences first where derivatives are of third order, whose sums of products would drown what is
  /// smooth in rounding, ε / h^6, and where coefficients vary: for residuals and the products of conjugate gradients.
  void precise_row(int j, std::span<const double> c, double* out) const { folded_row(j, c, out, true); }
  /// True if precise_row goes by differences of as high an order as the derivatives.
  bool is_by_differences() const { return by_differences_.has_value(); }
  /// The same for some columns, where the rows of c need not lie one after another: c[q] is row first_row(j) + q, and
  /// out[0] belongs to column columns.begin. Of constant coefficients, on spaces that are not periodic.
  void row(int j, const double* const* c, ColumnRange columns, double* out) const;
  /// Faster inside, but rounded as a stored matrix would be (EvenStencil): for corrections that later ones correct.
  void rough_row(int j, const double* const* c, ColumnRange columns, double* out) const;
  /// True if residuals need `row`: entries grow as fast as their sums cancel, h^-4 against 1, where derivatives are of
  /// second order.
  bool is_delicate() const { return order_ > 1; }
  int first_row(int j) const { return products_->first_row(j); }
  int band_height() const { return products_->band_height(); }

  /// out = E c by precise_row; all threads, the same bits for every thread count.
  void apply(std::span<const double> c, std::span<double> out) const;
  /// Diagonal entries E_ii, as a grid.
  RepeatedRows diagonal_rows() const;
  /// Diagonal entries E_ii.
  std::vector<double> diagonal() const;
  /// Entry of coefficients (i, j) and (k, l), image by image.
  double entry(int i, int j, int k, int l) const;
  /// Set where coefficients vary.
  const SymmetricStencil* stencil() const { return products_ ? nullptr : &stencil_; }

private:
  void part(int j, std::span<const double> c, double* out, bool precise) const;
  void folded_row(int j, std::span<const double> c, double* out, bool precise) const;
  double diagonal_entry(int i, int j) const;

  int order_ = 0;
  int images_x_ = 0, images_y_ = 0;
  std::optional<TensorSum> products_;
  std::optional<EvenStencil> inside_;             // of products_
  std::optional<TensorSum> end_rows_;             // what Gaussian curvature adds to the two first and last rows
  std::optional<DifferenceRows> by_differences_;  // of third derivatives
  SymmetricStencil stencil_;
};

/// The part of E c that comes from curvature ∫∫ 2 (p_xx p_yy - p_xy²): a sum over the sides.
/// `memory` is used for the result.
std::vector<double> apply_curvature(double curvature, const SplineSpace& space, std::span<const double> c,
                                    std::vector<double> memory = {});

}  // namespace batten
