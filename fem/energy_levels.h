// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/measurement.h>
#include <batten/fem/spline_level.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace batten {

/// The levels of finite-element spaces that a variational scheme is derived from, the coarsest first, as in the source:
/// level k has the energy E_k, step k leads from level k to level k + 1.
///
/// Two operators, never one name: R_k refines the finite-element basis, N_{k+1} R_k = N_k, so E_k = R_k^T E_{k+1} R_k;
/// the scheme S_k solves E_{k+1} S_k = U_k E_k, U_k = M_k^T, M_k a measurement of fine coefficients at coarse places.
/// S_k exists where M_k maps the null space of E_{k+1} into that of E_k [Warren & Weimer 2001, sec. 6.2.3].
struct EnergyLevels {
  struct Level {
    Eigen::SparseMatrix<double> E;  ///< symmetric, both triangles
    Eigen::MatrixXd null_space;     ///< Z, a basis of the null space in columns
    Eigen::MatrixXd weights;        ///< w, rows ∫ z N of the functions z of null_space; no rows where not defined
  };
  struct Step {
    Eigen::SparseMatrix<double> R;  ///< n_{k+1} x n_k; empty where the spaces are not nested
    Eigen::SparseMatrix<double> M;  ///< n_k x n_{k+1}
  };
  std::vector<Level> levels;
  std::vector<Step> steps;

  int finest() const { return static_cast<int>(steps.size()); }
};

/// The spline levels of a domain, the coarsest first; `steps` coarsenings. Throws InvalidInput where the domain is too
/// small for so many.
std::vector<SplineLevel> spline_levels(const VariationalDomain& domain, int steps);

/// Energies, refinements and Greville values M_k of spline levels. The weights are w_k = ∫ z N_k over the domain, so
/// that w_{k+1} R_k = w_k.
EnergyLevels energy_levels(const std::vector<SplineLevel>& levels);

/// The levels of natural cubic splines on [0, cells] as the source has them: E_k = 8^k D^T D with the second
/// differences D of 2^k cells + 1 coefficients, M_k every second coefficient [Warren & Weimer 2001, eq. 6.14, 6.16].
///
/// E_k is the energy of quadratic splines with knots half-way between the grid points. On the half-line its rows are
/// those of nested spaces; on an interval these spaces are not nested, there is no R and there are no weights: fix the
/// null space by interpolation at the ends.
EnergyLevels natural_cubic_levels(int cells, int steps);

}  // namespace batten
