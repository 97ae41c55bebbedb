// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace batten {

/// CHOLMOD's supernodal factorisation L L^T with its own choice of ordering: the fastest direct solver at hand.
class SupernodalCholesky {
public:
  /// Orders and analyses; `lower` holds the lower triangle, compressed. Throws SolverError.
  explicit SupernodalCholesky(Eigen::SparseMatrix<double> lower);
  ~SupernodalCholesky();
  SupernodalCholesky(const SupernodalCholesky&) = delete;
  SupernodalCholesky& operator=(const SupernodalCholesky&) = delete;

  /// Bytes that the factor will take.
  std::size_t factor_bytes() const;
  /// Factors. Throws SolverError if the matrix is not positive definite.
  void factor();
  /// Replaces b by the solution.
  void solve(std::span<double> b);

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Gives the BLAS below CHOLMOD one thread, the stable choice, and says which BLAS it is.
std::string use_one_blas_thread();

}  // namespace batten
