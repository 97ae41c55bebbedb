// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/least_energy.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace batten {

/// A function q split into minimisers of energy and what they lack, q = q_0 + r_0 + ... + r_{K-1}: q_k has the least
/// energy of all functions with the measurements v_k of q on level k, and r_k = q_{k+1} - q_k. All parts are orthogonal
/// in the energy [Warren & Weimer 2001, sec. 6.3.3].
///
/// Measurements are nested: v_K are the coefficients of q, v_k = M_k v_{k+1}. Where the source keeps as many numbers of
/// r_k as level k + 1 has, here details are the free coefficients of r_k's measurements, which M_k takes to 0: all of
/// an analysis together has as many numbers as q.
class Multiresolution {
public:
  struct Analysis {
    Eigen::VectorXd coarse;                ///< v_0
    std::vector<Eigen::VectorXd> details;  ///< of r_0 .. r_{K-1}
  };

  /// E of the finest level, symmetric, both triangles; M_0 .. M_{K-1}, K >= 1. One factorisation of the finest size for
  /// each level. Throws InvalidInput if the sizes do not fit or if a measurement M_0 or M_k ... M_{K-1} has no private
  /// coefficient, SolverError if M_0's do not fix the null space of E.
  Multiresolution(const Eigen::SparseMatrix<double>& E, const std::vector<MeasurementMatrix::Matrix>& M);

  int levels() const { return static_cast<int>(steps_.size()); }
  Analysis analyse(const Eigen::VectorXd& q) const;
  /// The q of an analysis: lossless up to rounding.
  Eigen::VectorXd synthesise(const Analysis& analysis) const;
  /// Coefficients of q_k on the finest level, 0 <= k <= levels().
  Eigen::VectorXd approximation(const Analysis& analysis, int k) const;
  /// Energies of q_0, r_0, ..., r_{K-1}; their sum is that of q.
  std::vector<double> energies(const Analysis& analysis) const;

private:
  struct Step {
    MeasurementMatrix::Matrix M;
    FreeCoefficients variables;
    LeastEnergy least;  // from v_k to coefficients of the finest level
  };
  Eigen::VectorXd measurements(Eigen::VectorXd q, int k) const;
  Eigen::VectorXd finer(const Eigen::VectorXd& v, const Eigen::VectorXd& detail, int k) const;
  double energy(const Eigen::VectorXd& v, int k) const;

  Eigen::SparseMatrix<double> E_;
  std::vector<Step> steps_;
};

/// The analysis without the details whose size is below the threshold, and how many numbers other than 0 are left.
struct Compression {
  Multiresolution::Analysis kept;
  std::size_t numbers = 0;
  double energy_error = 0;  ///< energy of what was left out, exact: parts of different levels are orthogonal
};
Compression compress(const Multiresolution& multiresolution, const Multiresolution::Analysis& analysis,
                     double threshold);

}  // namespace batten
