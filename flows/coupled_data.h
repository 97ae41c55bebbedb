// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/flows/cross_stencil.h>

#include <Eigen/SparseCore>

#include <algorithm>
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

  const Hierarchy::Level& psi(int level) const { return stream.hierarchy()[level]; }
  const Hierarchy::Level& phi(int level) const { return potential.hierarchy()[level]; }
  int levels() const { return std::min(stream.hierarchy().size(), potential.hierarchy().size()); }
};

/// The data part B^T W B = Σ_i w_i b_i b_i^T of ψ and φ on one level, b_i = (a_i, factor_i a'_i) with the rows a_i of ψ
/// and a'_i of φ. Coefficients are those of ψ and then those of φ.
class CoupledData {
public:
  /// The problems are kept by reference.
  CoupledData(const CoupledParts& parts, int level);

  /// `stored` asks for stencils; else they are kept where rows outnumber the coefficients of one of the two.
  void set(const PairWeights& weights, bool stored);
  /// The terms of ψ and of φ exist already, with weights W and F W F, F = diag(factor); kept by reference. `finer`: the
  /// same data on the next finer level, or none.
  void share(const DataTerm& psi, const DataTerm& phi, const PairWeights& weights, const CoupledData* finer);

  std::size_t size() const { return weights_.size(); }
  bool is_stored() const { return psi().is_stored(); }
  const DataTerm& psi() const { return own_psi_ ? *own_psi_ : *shared_psi_; }
  const DataTerm& phi() const { return own_phi_ ? *own_phi_ : *shared_phi_; }
  const CrossStencil& cross() const { return cross_; }  ///< stored only

  /// out_i = b_i · c
  std::vector<double> values(std::span<const double> c) const;
  /// c += Σ_i v_i b_i
  void add_adjoint(std::span<const double> v, std::span<double> c) const;
  /// out += factor Σ_i w_i b_i (b_i · c)
  void add_normal(double factor, std::span<const double> c, std::span<double> out) const;
  /// What φ adds to the equations of ψ and ψ to those of φ.
  void add_cross(double factor, std::span<const double> c, std::span<double> out) const;
  /// DataTerm::lumped of both.
  std::vector<double> lumped() const;
  /// b_i · diag(inverse) b_i
  std::vector<double> compliance(std::span<const double> inverse) const;
  /// b_i in columns
  Eigen::SparseMatrix<double> columns() const;

private:
  void set_cross(const PairWeights& weights, const CoupledData* finer);
  void multiply_cross(double factor, std::vector<double>& of_psi, std::vector<double>& of_phi) const;

  CoupledParts parts_;
  int level_;
  std::optional<DataTerm> own_psi_, own_phi_;
  const DataTerm *shared_psi_ = nullptr, *shared_phi_ = nullptr;
  PairWeights weights_;
  CrossStencil cross_;
};

/// The halves of vectors of ψ and φ.
inline std::span<const double> psi_of(std::span<const double> c) { return c.first(c.size() / 2); }
inline std::span<const double> phi_of(std::span<const double> c) { return c.last(c.size() / 2); }
inline std::span<double> psi_of(std::span<double> c) { return c.first(c.size() / 2); }
inline std::span<double> phi_of(std::span<double> c) { return c.last(c.size() / 2); }

}  // namespace batten
