// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace batten {

// Eigen's decompositions, compiled once: each source that names one compiles ten seconds longer.

/// A v_k = λ_k v_k of a symmetric matrix, λ ascending, the columns of `vectors` orthonormal.
struct SymmetricEigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Reads the lower triangle.
SymmetricEigensystem symmetric_eigensystem(const Eigen::MatrixXd& A);

/// The same without vectors.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

/// A v_k = λ_k v_k of any square matrix, the columns of `vectors` of size 1.
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

Eigensystem eigensystem(const Eigen::MatrixXd& A);

/// The same without vectors.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

}  // namespace batten
