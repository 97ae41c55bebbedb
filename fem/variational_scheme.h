// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/energy_levels.h>
#include <batten/fem/sparse_cholesky.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace batten {

/// What fixes S_k beyond E_{k+1} S_k = U_k E_k, which leaves a function of the null space free in every column.
struct NullSpaceRule {
  /// Coarse places j, as many as the null space has dimensions, where M_k S_k p = p. Empty: weighted moments,
  /// w_{k+1} S_k = w_k with w the integrals against the functions of the null space, so that S_k p_k has the mean (for
  /// bending also the first moments) of p_k and S_k reproduces the null space. The source's w_{k+1} S_k = 4 w_k with
  /// w = 1, 2, 4 on corners, edges and inside is the same in units of a quarter cell [Warren & Weimer 2001,
  /// sec. 6.4.3].
  std::vector<int> interpolated = {};
};

/// S_k, exact: E_{k+1} S_k = U_k E_k by sparse factorisation, one solve for each vector, column or row.
///
/// S_k p is the vector of least energy among all with its own measurements M_k S_k p; its Lagrange multipliers are
/// E_k p.
class VariationalScheme {
public:
  /// S_k of levels k and k + 1. Throws InvalidInput if there is no step k, if M_k does not map the null space of
  /// E_{k+1} into that of E_k, or if the rule does not fix the null space.
  VariationalScheme(const EnergyLevels& levels, int k, const NullSpaceRule& rule = {});

  int rows() const { return static_cast<int>(E_.rows()); }
  int columns() const { return static_cast<int>(right_.cols()); }
  /// S_k p.
  Eigen::VectorXd apply(const Eigen::VectorXd& p) const;
  /// S_k^T q.
  Eigen::VectorXd apply_transposed(const Eigen::VectorXd& q) const;
  /// The limit's share of one coarse coefficient, and the subdivision rule of one fine coefficient.
  Eigen::VectorXd column(int j) const { return apply(Eigen::VectorXd::Unit(columns(), j)); }
  Eigen::VectorXd row(int i) const { return apply_transposed(Eigen::VectorXd::Unit(rows(), i)); }
  /// All of it, rows() x columns(): for small levels.
  Eigen::MatrixXd matrix() const;

private:
  Eigen::VectorXd solve(Eigen::VectorXd f) const;

  Eigen::SparseMatrix<double> E_;                 // E_{k+1}
  Eigen::SparseMatrix<double> right_;             // U_k E_k
  Eigen::MatrixXd Z_;                             // null space of E_{k+1}
  Eigen::MatrixXd functionals_;                   // of the fine coefficients, and ...
  Eigen::MatrixXd targets_;                       // ... of the coarse ones, which they must equal
  Eigen::MatrixXd inverse_;                       // of functionals_ Z_
  std::vector<int> free_;                         // fine coefficients that are not held at 0 to make E_{k+1} invertible
  std::shared_ptr<const SparseCholesky> factor_;  // of E_{k+1} on free_
};

/// p_0, p_1 = S_0 p_0, ..., p_K on all levels.
std::vector<Eigen::VectorXd> subdivided(const std::vector<VariationalScheme>& schemes, const Eigen::VectorXd& p0);

/// M_0 M_1 ... M_{k-1} p_k on level 0: as k grows that of the limit, N_0 p_0 of the source, and p_0^T E_0 N_0 p_0 is
/// the energy of the limit [Warren & Weimer 2001, theorem 6.4].
Eigen::VectorXd measured_on_coarsest(const EnergyLevels& levels, int k, Eigen::VectorXd p);

/// Rows, as many as the columns of Z, on which Z is well conditioned: by complete pivoting.
std::vector<int> unisolvent_rows(const Eigen::MatrixXd& Z);

/// The rows and columns `kept` of a symmetric matrix, lower triangle.
Eigen::SparseMatrix<double> lower_submatrix(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& kept);

}  // namespace batten
