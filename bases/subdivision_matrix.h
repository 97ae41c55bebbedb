// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/subdivision_rules.h>

#include <Eigen/SparseCore>

namespace batten {

/// The two-slanted matrix S of the step from level - 1 to level for n old points, S_ij = s[i - arity j] with the row of
/// the first new point first, as many rows as subdivided() gives points [Warren & Weimer 2001, eq. 1.11]. Throws
/// InvalidInput when n < 1, level < 1, or there is no new point.
Eigen::SparseMatrix<double> subdivision_matrix(const Scheme& scheme, int n, Ends ends, int level = 1);

struct GridSize {
  int x = 0;
  int y = 0;
};

/// The same for values on a grid, x fastest; both axes have the same ends.
Eigen::SparseMatrix<double> subdivision_matrix(const Scheme2& scheme, const GridSize& size, Ends ends, int level = 1);

}  // namespace batten
