// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace batten {

/// Multigrid for a stored matrix and any transfers P: coarse matrices are P^T A P, the coarsest is solved directly.
///
/// The smoother is that of the library, Chebyshev polynomials of the fourth kind with the diagonal, as many steps
/// before as after. Matrices may be semidefinite, as those of free bodies are, and P may have a null space.
class GalerkinMultigrid {
public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  enum class Cycle { V, W };  ///< W: levels but the finest and the coarsest are visited twice by the next finer one

  /// A symmetric positive semidefinite, Z a basis of its null space in columns; transfers from level i + 1 to level i,
  /// level 0 being A's; steps >= 1.
  GalerkinMultigrid(const Matrix& A, const Eigen::MatrixXd& Z, std::vector<Matrix> transfers, int steps);

  /// An approximate inverse applied to r, symmetric, in the complement of the null space: there rounding would grow, as
  /// nothing resists it.
  Eigen::VectorXd precondition(const Eigen::VectorXd& r, Cycle cycle) const;

  struct Solution {
    Eigen::VectorXd x;
    int iterations = 0;
  };
  /// Conjugate gradients from 0 until sqrt(r · B r) is `accuracy` of its first value; b in the range of A.
  Solution solve(const Eigen::VectorXd& b, Cycle cycle, double accuracy) const;

  const Matrix& matrix() const { return levels_.front().A; }
  /// Nonzeros of all levels' matrices over those of the finest.
  double operator_complexity() const;
  /// Multiplications of an iteration by entries of matrices and transfers, over the nonzeros of the finest matrix.
  double work(Cycle cycle) const;

private:
  struct Level {
    Matrix A, P;                       // P from the next coarser level, empty on the coarsest
    Matrix restriction;                // P^T
    Eigen::VectorXd inverse_diagonal;  // of M = ρ diag(A) >= A
  };
  Eigen::VectorXd cycle(std::size_t k, const Eigen::VectorXd& b, Cycle kind) const;
  Eigen::VectorXd without_null_space(const Eigen::VectorXd& v) const;
  bool visits_twice(std::size_t k, Cycle kind) const;

  std::vector<Level> levels_;
  Eigen::MatrixXd null_space_;  // orthonormal
  Eigen::MatrixXd coarsest_inverse_;
  int steps_;
};

}  // namespace batten
