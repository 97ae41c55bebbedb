// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/measurement.h>
#include <batten/fem/sparse_cholesky.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace batten {

/// Variables in which measurements hold by themselves: q = J m + Z f for M q = m, f the coefficients that are not
/// private to a measurement. Row j of M gives its private coefficient, q_p = (m_j - Σ M_ja q_a) / M_jp.
struct FreeCoefficients {
  Eigen::SparseMatrix<double> J, Z;
  std::vector<int> free;  ///< coefficients in f
};
FreeCoefficients free_coefficients(const MeasurementMatrix::Matrix& M);

/// The interpolating form, exact: Ψ m is the vector q of least energy q · E q among all with M q = m. M Ψ = I.
///
/// Its range is that of the bell form S where that is defined with the same M: Ψ (M S) = S. Energies split, with
/// M w = 0: E(Ψ m + w) = E(Ψ m) + E(w) [Warren & Weimer 2001, theorem 6.5]. One sparse factorisation of Z^T E Z.
class LeastEnergy {
public:
  /// E symmetric, both triangles. Throws InvalidInput if a measurement has no private coefficient, SolverError if the
  /// measurements do not fix the null space of E.
  LeastEnergy(const Eigen::SparseMatrix<double>& E, const MeasurementMatrix::Matrix& M);

  int rows() const { return static_cast<int>(variables_.J.rows()); }
  int columns() const { return static_cast<int>(variables_.J.cols()); }
  /// Ψ m.
  Eigen::VectorXd apply(const Eigen::VectorXd& m) const;
  /// Ψ, for small levels.
  Eigen::MatrixXd matrix() const;

private:
  FreeCoefficients variables_;
  Eigen::SparseMatrix<double> coupling_;  // Z^T E J
  std::shared_ptr<const SparseCholesky> factor_;
};

}  // namespace batten
