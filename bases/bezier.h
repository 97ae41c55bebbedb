// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace batten {

/// b_i(x) = C(m, i) (1 - x)^(m-i) x^i, i = 0 .. m, of degree m >= 0 [Warren & Weimer 2001, eq. 1.2]; non-negative on
/// [0, 1], sum 1, the largest of b_i at i/m.
Eigen::RowVectorXd bernstein_basis(int degree, double x);

/// Σ_i b_i(x) p_i, one point in each row, at least one [Warren & Weimer 2001, eq. 1.1], by de Casteljau's algorithm.
Eigen::RowVectorXd bezier_point(const Eigen::MatrixXd& polygon, double x);

/// The maps that take the polygon of a Bezier curve of degree m on [0, 1] to those of its halves, exact up to m = 53:
/// left(i, j) = C(i, j) / 2^i, right(i, j) = C(m-i, j-i) / 2^(m-i). The last row of the left is the first one of the
/// right [Warren & Weimer 2001, sec. 1.2.4]. For iterated_maps() they are the maps whose limit is the curve; they
/// contract the edges of polygons.
struct CasteljauMaps {
  Eigen::MatrixXd left, right;
};
/// Throws InvalidInput unless 0 <= degree <= 53.
CasteljauMaps casteljau_maps(int degree);

/// The polygons of both halves by midpoints, in O(m^2) steps [Warren & Weimer 2001, eq. 1.5]. Throws InvalidInput when
/// there is no point.
CasteljauMaps casteljau_halves(const Eigen::MatrixXd& polygon);

}  // namespace batten
