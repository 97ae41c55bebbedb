// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/smoother.h>
#include <batten/flows/coupled_data.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// Chebyshev smoothing of the coupled system of ψ and φ on one level, A = λ (E, ratio E) + Σ_i w_i b_i b_i^T, as that
/// of Smoother for one spline: by a matrix M >= A, the diagonal of the energy plus lumped data or plus the data as they
/// are.
class CoupledSmoother {
public:
  /// The problems and the data are kept by reference.
  CoupledSmoother(const CoupledParts& parts, int level, const CoupledData& data, double lambda);

  /// Of the data as they are now.
  void set(Smoother::Kind kind, const PairWeights& weights);
  std::size_t size() const { return diagonal_.size(); }
  /// How much the rows give way when the energy's diagonal alone resists.
  std::vector<double> compliance() const;

  struct Work {
    std::vector<double> x, r, z, t;
    explicit Work(std::size_t size) : x(size), r(size), z(size), t(size) {}
  };
  /// work.x = p(A) b and work.r = b - A x. b may be work.r.
  void smooth_first(int degree, std::span<const double> b, Work& work) const;
  /// Adds the correction in work.z to x, then smooths; r is left unfinished.
  void smooth_last(int degree, Work& work) const;

private:
  struct Step {
    double keep, gain;
  };
  std::vector<Step> steps(int degree) const;
  void advance(const Step& step, Work& work) const;
  void subtract_product(Work& work) const;
  void precondition(std::span<const double> r, std::span<double> out) const;
  void multiply_inverse_diagonal(std::span<double> v) const;

  CoupledParts parts_;
  int level_;
  const CoupledData* data_;
  double lambda_;
  std::vector<double> diagonal_;  // of the energies, bounds included, without λ
  std::vector<double> inverse_;   // of M's diagonal, or of its energy's
  Eigen::SparseMatrix<double> columns_;
  std::optional<SparseCholesky> factor_;  // of W^-1 + B D^-1 B^T, data-aware only
};

}  // namespace batten
