// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/fem/sparse_cholesky.h>

#include <Eigen/Dense>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// The problems of ψ and of φ on one grid. Row i measures the slope of ψ plus factor[i] times that of φ.
struct CoupledParts {
  const FitProblem& stream;
  const FitProblem& potential;
  std::span<const double> factor;  ///< in the order of the grid
  double ratio;                    ///< of the energy of φ
};

/// The coupled system A of ψ and φ on one level, which sees the data as the finest level does: P A^-1 P^T, P the
/// refinement to the finest level.
class CoupledLevel {
public:
  /// `unseen`: columns of coefficients on this level, those of ψ first, which A sees not or hardly. As many
  /// coefficients as there are columns are held at 0, so that A is definite. The problems are kept by reference.
  CoupledLevel(const CoupledParts& parts, int level, const Eigen::MatrixXd& unseen);

  int level() const { return level_; }
  void set(double lambda, std::span<const double> weights);
  /// P A^-1 P^T r.
  std::vector<double> correction(std::span<const double> r) const;

private:
  struct Part;
  std::vector<double> cross_products(std::span<const double> weights) const;
  void add_part(const Part& part, std::vector<Eigen::Triplet<double>>& entries) const;
  void add_cross(std::span<const double> weights, std::vector<Eigen::Triplet<double>>& entries) const;
  std::size_t half() const { return psi_.size(); }

  CoupledParts parts_;
  int level_;
  SplineSpace psi_, phi_;
  DataTerm psi_data_, phi_data_;
  std::vector<bool> is_held_;
  std::optional<SparseCholesky> factorised_;
};

/// The coarsest level with at least so many cells along the longer side, but none with more than `most` coefficients of
/// each spline unless it is the coarsest.
int coupled_level(const CoupledParts& parts, double cells, std::size_t most);

}  // namespace batten
