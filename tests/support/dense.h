// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>

#include <Eigen/Dense>

namespace batten::test {

/// The banded matrix as a dense one.
inline Eigen::MatrixXd dense(const BandedRows& m) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(m.rows, m.columns);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < m.columns; ++j) result(i, j) = m(i, j);
  return result;
}

}  // namespace batten::test
