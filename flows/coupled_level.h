// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/sparse_cholesky.h>
#include <batten/flows/coupled_data.h>

#include <Eigen/Dense>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// The coupled system A of ψ and φ on one level and its direct solution.
class CoupledLevel {
public:
  /// `data`: in stencils, kept by reference. `unseen`: columns of coefficients on this level, those of ψ first, which A
  /// sees not or hardly. As many coefficients as there are columns are held at 0, so that A is definite.
  CoupledLevel(const CoupledParts& parts, int level, const CoupledData& data, double lambda,
               const Eigen::MatrixXd& unseen);

  std::size_t size() const { return is_held_.size(); }
  /// Replaces b by a solution of A x = b.
  void solve(std::span<double> b) const;

private:
  struct Part;
  void add_part(const Part& part, std::vector<Eigen::Triplet<double>>& entries) const;
  void add_cross(std::vector<Eigen::Triplet<double>>& entries) const;
  std::size_t half() const { return psi_.size(); }

  SplineSpace psi_, phi_;
  const CoupledData& data_;
  std::vector<bool> is_held_;
  std::optional<SparseCholesky> factorised_;
};

}  // namespace batten
