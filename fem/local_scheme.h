// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/measurement.h>
#include <batten/fem/spline_level.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace batten {

/// The interpolating form made local: the fine coefficients around a coarse cell are those of the least-energy function
/// on a patch of r layers of coarse cells with the measurements in the patch, free at the patch's border.
///
/// Measurements hold exactly, M Ψ_r = I, and functions without energy are reproduced, both for every r; the error
/// falls exponentially with r [Owhadi 2017]. Unlike there, rows are localised instead of columns: a cut-off column
/// does not reproduce constants. Rules whose patches have the same cells, coefficients and measurements are found and
/// stored once: a uniform rectangle has as many as kinds of corners and edges, whatever its size.
class LocalScheme {
public:
  /// From measurements at the cells of `coarse` to coefficients of `fine`, whose coarser() it is; layers >= 1. Time is
  /// linear in the number of coarse cells. Throws InvalidInput as measurement_matrix and private_functions do.
  LocalScheme(const SplineLevel& coarse, const SplineLevel& fine, Measurement kind, int layers);

  /// M, one row for each measurement.
  const MeasurementMatrix& measurements() const { return measurements_; }
  int rows() const { return static_cast<int>(measurements_.M.cols()); }
  int columns() const { return static_cast<int>(measurements_.M.rows()); }
  /// Ψ_r m, in linear time; all threads, the same bits for every thread count. Throws InvalidInput if m does not fit.
  Eigen::VectorXd apply(const Eigen::VectorXd& m) const;
  /// Ψ_r, for small levels.
  Eigen::MatrixXd matrix() const;
  /// Ψ_r as stored entries: each row has those of its rule, private rows those of the rules that they balance.
  Eigen::SparseMatrix<double, Eigen::RowMajor> sparse_matrix() const;
  /// Different rules stored: each serves all coefficients around a cell.
  int rules() const { return static_cast<int>(rules_.size()); }
  /// Numbers stored in them.
  std::size_t stored_weights() const;

private:
  friend class LocalSchemeBuilder;
  /// Of the coefficients around a coarse cell: their places and those of the measurements, relative to the cell.
  struct Rule {
    std::vector<int> functions;   ///< grid index relative to that of function (2 I, 2 J)
    std::vector<int> places;      ///< relative to place (I, J)
    std::vector<double> weights;  ///< functions x places, row after row
  };

  void apply_rule(int c, const Eigen::VectorXd& at_place, Eigen::VectorXd& q) const;
  void set_private(int r, double m, Eigen::VectorXd& q) const;

  MeasurementMatrix measurements_;
  std::vector<int> private_;   // coefficient of each measurement
  std::vector<double> pivot_;  // its weight
  std::vector<int> rule_of_;   // of each coarse cell, -1 where there are no coefficients
  std::vector<Rule> rules_;
  std::vector<int> number_, grid_;  // of the fine level's functions
  int cells_x_ = 0, cells_y_ = 0, functions_x_ = 0;
};

}  // namespace batten
