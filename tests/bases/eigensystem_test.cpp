// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace batten {
namespace {

constexpr double tolerance = 8 * 2.3e-16;  // a few roundings

TEST(Eigensystem, of_a_symmetric_matrix_is_ascending_and_orthonormal_and_reads_the_lower_triangle) {
  const Eigen::Matrix2d A{{2, 77}, {1, 2}};  // (1, -1) and (1, 1)
  const SymmetricEigensystem system = symmetric_eigensystem(A);
  EXPECT_NEAR(system.values[0], 1, tolerance);
  EXPECT_NEAR(system.values[1], 3, tolerance);
  EXPECT_NEAR(system.vectors(0, 0) * system.vectors(1, 0), -0.5, tolerance);
  EXPECT_NEAR(system.vectors(0, 1) * system.vectors(1, 1), 0.5, tolerance);
  EXPECT_NEAR(symmetric_eigenvalues(A)[0], 1, tolerance);
  EXPECT_NEAR(symmetric_eigenvalues(A)[1], 3, tolerance);
}

TEST(Eigensystem, of_a_rotation_is_a_conjugate_pair) {
  const Eigen::Matrix2d A{{0, -1}, {1, 0}};
  const Eigensystem system = eigensystem(A);
  for (Eigen::Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::abs(system.values[k] - std::complex<double>(0, k == 0 ? 1 : -1)), 0, tolerance);
    EXPECT_NEAR(std::abs(eigenvalues(A)[k] - system.values[k]), 0, tolerance);
    const Eigen::Vector2cd v = system.vectors.col(k);
    EXPECT_NEAR((A.cast<std::complex<double>>() * v - system.values[k] * v).norm(), 0, tolerance);
    EXPECT_NEAR(v.norm(), 1, tolerance);
  }
}

}  // namespace
}  // namespace batten
