// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/operator.h>
#include <batten/fem/pair_weights.h>
#include <batten/fem/point_kernels.h>
#include <batten/fem/symmetric_stencil.h>

#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace batten {

/// What is measured at a point of a spline p: its value, or a derivative in normalised coordinates, or the coefficient
/// of p on a finer grid whose Greville abscissae are the point.
enum class Measured : unsigned char { Value, SlopeX, SlopeY, Coefficient };

/// Positions of measurements in cells of the finest level, ordered by cell row and then by cell column.
struct GridPoints {
  std::vector<double> x, y;
  std::vector<Measured> kind;  ///< empty: all are values
  double spacing = 1;          ///< of the knots of the finer grid of coefficients, in cells
  std::size_t size() const { return x.size(); }
  bool have_slopes() const;
  bool have_coefficients() const;
  /// True if there are measurements and none sees a constant.
  bool are_slopes() const;
};

/// The indices of points in the order that GridPoints asks for, by cell row, cell column and index.
std::vector<std::size_t> cell_order(const GridPoints& points, const SplineSpace& space);

/// values[order[0]], values[order[1]], ...
template <typename T>
std::vector<T> reordered(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> result(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) result[i] = values[order[i]];
  return result;
}

/// The data part B^T W B = Σ_i w_i b_i b_i^T of a least-squares fit on one level; b_i holds the values of the basis
/// functions at point i, or their derivatives where those are measured. Pairs of rows at one point may have weights
/// beside the diagonal, and Σ_i w_i b_i b_i^T stands for B^T W B with these too.
///
/// Few points are applied one by one; where points outnumber the coefficients, or crowd as those of finer grids do,
/// their sum is stored as a symmetric stencil of (2d+1)² entries for each coefficient. Both add fixed blocks of rows in
/// a fixed order: same bits for every thread count.
class DataTerm {
public:
  /// `stored` forces the stencil form. The points are kept by reference and must outlive this object.
  DataTerm(const SplineSpace& space, const GridPoints& points, bool stored = false);

  std::size_t size() const { return points_->size(); }
  bool is_stored() const { return stored_; }
  /// True if there are measurements and none sees a constant.
  bool are_slopes() const { return points_->are_slopes(); }

  /// The weights w_i, in the order of the points. Throws InvalidInput if rows of a pair are not at one point.
  void set_weights(std::span<const double> weights) { set_weights(PairWeights(weights)); }
  void set_weights(PairWeights weights);
  /// The weights of the finer level's term, from its stencil: R^T (Σ_i w_i b_i b_i^T) R. Both terms must be stored;
  /// weights() is empty afterwards. Does nothing if the finer term has not changed since.
  void set_from_finer(const DataTerm& finer, const TensorSum& restriction);
  const PairWeights& weights() const { return weights_; }

  /// out_i = Σ_j b_i[j] c_j: the measurements of the spline.
  void values(std::span<const double> c, std::span<double> out) const;
  /// c += Σ_i v_i b_i. On a periodic space, c holds nothing at images before and after; the same is true of add_normal.
  void add_adjoint(std::span<const double> v, std::span<double> c) const;
  /// How much the measurements change where each is pulled with force 1 against springs of compliance `inverse`. Values
  /// nearby all pull alike: comp_i = Σ_j b_i · diag(inverse) b_j. Forces on derivatives do not add up, as the sum of
  /// dipoles that lie densely has no effect inside: comp_i = b_i · diag(inverse) b_i (measured: with absolute values in
  /// the sum instead, three times as many iterations).
  std::vector<double> compliance(std::span<const double> inverse) const;
  /// The diagonal of a matrix that is at least Σ_i w_i b_i b_i^T: B^T w of values, which are not negative and sum to 1;
  /// of derivatives |B|^T W |B| 1, or sums of the absolute entries of the stencil. W of pairs is lumped first.
  std::vector<double> lumped() const;
  /// out += factor Σ_i w_i b_i (b_i · c)
  void add_normal(double factor, std::span<const double> c, std::span<double> out) const;
  /// The same for the rows of a range, upwards: row j is complete after the call for j. Reads rows j - d .. j + d of c,
  /// at the first row of the range too, and adds to rows j .. j + d of out, as far as they belong to the range. Image
  /// by image.
  void add_normal_row(int j, RowRange range, double factor, std::span<const double> c, std::span<double> out) const;

  /// b_i of one point.
  PointRow row(std::size_t point) const;
  /// All b_i, each a column of size() numbers of the space; 0 at images.
  Eigen::SparseMatrix<double> columns() const;
  /// Points whose cell row is r: first_point(r) .. first_point(r + 1) - 1.
  std::size_t first_point(int cell_row) const { return row_start_[static_cast<std::size_t>(cell_row)]; }
  /// Σ_i w_i b_i b_i^T, in the stencil form only.
  const SymmetricStencil& stencil() const { return stencil_; }

private:
  template <typename Work>
  void for_rows(int begin, int end, Work&& work) const;
  void accumulate_cell_row(int cell_row);
  void add_pairs(std::span<const std::size_t> points, CellSum& sum) const;
  PointRow absolute_row(std::size_t point) const;
  void add_absolute_adjoint(std::span<const double> v, std::span<double> c) const;
  PointGrid grid() const { return {space_.x.size(), space_.x.degree() + 1}; }

  SplineSpace space_;
  const GridPoints* points_;
  bool stored_;
  std::vector<std::size_t> row_start_;
  PairWeights weights_;
  bool are_paired_ = false;     // also where a stencil is all that is known of them
  int revision_ = 0;            // counts the changes of weights
  int finer_revision_ = 0;      // that the stencil was made from, 0: from weights
  std::vector<PointRow> rows_;  // point form
  SymmetricStencil stencil_;    // stencil form
};

}  // namespace batten
