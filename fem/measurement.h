// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/spline_level.h>

#include <Eigen/SparseCore>

#include <vector>

namespace batten {

/// What is measured of a spline on a level at the places of the next coarser one.
enum class Measurement {
  /// Values at the coarse Greville points, one for each coarse function: the square M of the two-scale relation. For
  /// degree 1 the values, and so the coefficients, at every second grid point, as in [Warren & Weimer 2001, sec. 6.4].
  GrevilleValues,
  /// Averages over the coarse cells: bounded for every energy. Degree 1.
  CellAverages,
  /// Values at the middle breakpoints of the coarse cells. Unbounded as levels grow finer for the membrane in two
  /// dimensions, bounded for bending.
  CentreValues
};

/// M of a step, rows are measurements: M c are those of the spline with coefficients c.
///
/// Measurements lie on a grid of places, x fastest; places outside of the domain have no row.
struct MeasurementMatrix {
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  Matrix M;
  int places_x = 0, places_y = 0;
  std::vector<int> row;    ///< of each place, -1: none
  std::vector<int> place;  ///< of each row
};

/// M from `fine` to the places of `coarse`, its coarser(). Throws InvalidInput where a place has no measurement in the
/// domain: Greville values on masks (but for degree 1 and masks of whole coarse cells), averages of a degree above 1.
MeasurementMatrix measurement_matrix(const SplineLevel& coarse, const SplineLevel& fine, Measurement kind);

/// For each row of M a function that no other row sees, the one of largest weight: it can be set so that the
/// measurement holds, whatever the others are. Throws InvalidInput where a row has none (Greville values of degree 3
/// and, on uneven cells, of degree 2).
std::vector<int> private_functions(const MeasurementMatrix::Matrix& M);

/// In one direction, for each coarse cell c, the places whose measurements are local to the cells c - layers ..
/// c + layers: the first and one past the last.
struct PlaceRange {
  int begin, end;
};
std::vector<PlaceRange> places_around(const KnotSplines& coarse, Measurement kind, int layers);

}  // namespace batten
