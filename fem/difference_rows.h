// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>
#include <batten/bases/spline_ends.h>
#include <batten/fem/energy.h>

#include <span>
#include <vector>

namespace batten {

struct SplineSpace;

/// Rows of E c by differences first: each term weight ∫∫ (∂_x^a ∂_y^b p)² is D^T M D with D the differences of a and b
/// neighbouring coefficients and M the inner products of splines of lower degree. As much work as the rows of
/// TensorSum, but rounding comes in the form D^T e: it weighs ε / h^m in the energy norm where derivatives are of order
/// m, as that of storing c does, while the rounding of TensorSum weighs ε / h^2m. For energies without Gaussian
/// curvature. Between periodic sides, rows and columns hold the integrals image by image.
class DifferenceRows {
public:
  DifferenceRows(const Energy& energy, const SplineSpace& space);

  /// Row j of E c: as many numbers to `out` as there are columns. Allocates nothing; one thread.
  void row(int j, const double* c, double* out) const;

  /// Some columns of the result, from .. to - 1, and those of c that they take in.
  struct Piece {
    int from, to;
    int first, inputs;
  };
  /// One direction and order r: `slopes[k]` of the k-th differences, k < r, and D^T M / scale, rows by
  /// 2 degree + 1 - r columns.
  struct Direction {
    std::vector<std::vector<double>> slopes;
    BandedRows weights;
    double scale = 1;
  };

private:
  struct Term {
    double factor;
    int x_order, y_order;
  };
  void copy_row(int row, const Piece& piece, const double* c, double* to) const;

  EndConditions x_ends_, y_ends_;
  int columns_, rows_;
  std::vector<Term> terms_;       // by y_order
  std::vector<Direction> x_, y_;  // by the order
};

}  // namespace batten
