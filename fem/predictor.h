// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/least_energy.h>
#include <batten/fem/local_scheme.h>
#include <batten/fem/spline_level.h>

#include <Eigen/Core>

#include <variant>
#include <vector>

namespace batten {

/// Predicts finer solutions: coarse coefficients -> their measurements at the coarse places -> the least-energy finer
/// coefficients, q_{k+1} = Ψ_k M_k R_k q_k.
///
/// R_k q_k is the same function with the same measurements and energy, and q_{k+1} is the least of those: in exact form
/// energies never rise. Cell averages are nested from level to level, so that all levels keep those of q_0.
class Predictor {
public:
  struct Options {
    Measurement kind = Measurement::CellAverages;
    int layers = 4;          ///< of the local rules; 0: exact, one sparse factorisation for each level
    bool smoothing = false;  ///< one sweep after each step, see smoothing_sweep
  };
  struct Prediction {
    std::vector<Eigen::VectorXd> coefficients;  ///< of all levels, the coarsest first
    std::vector<double> energies;
  };

  /// For spline levels, the coarsest first. Throws InvalidInput as measurement_matrix and private_functions do.
  Predictor(const std::vector<SplineLevel>& levels, const Options& options);

  int steps() const { return static_cast<int>(steps_.size()); }
  /// From coefficients on level k to level k + 1. In local form without smoothing: linear time, all threads.
  Eigen::VectorXd predict(int k, const Eigen::VectorXd& q) const;
  /// All levels from q_0 on. Throws InvalidInput if q_0 is not of the coarsest level.
  Prediction run(const Eigen::VectorXd& q0) const;

private:
  struct Step {
    Eigen::SparseMatrix<double> R;
    MeasurementMatrix::Matrix M;
    std::variant<LeastEnergy, LocalScheme> scheme;
    Eigen::SparseMatrix<double> E;  // with smoothing only
    FreeCoefficients variables;
  };
  std::vector<SplineLevel> levels_;
  std::vector<Step> steps_;
};

/// A forward and a backward Gauss-Seidel sweep that lowers q · E q and keeps M q: coefficient after coefficient of
/// `variables` is set to its best value, private coefficients following.
void smoothing_sweep(const Eigen::SparseMatrix<double>& E, const FreeCoefficients& variables, Eigen::VectorXd& q);

}  // namespace batten
