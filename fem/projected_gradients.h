// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/conjugate_gradients.h>

#include <functional>
#include <span>
#include <vector>

namespace batten {

/// Conjugate gradients for systems given by what they do to a vector: for a sequence of right-hand sides with good
/// starts. The preconditioner B may map into a subspace, such as P B P^T; the solution is then the one in it, and the
/// residual means its part that the subspace sees.
class ProjectedGradients {
public:
  struct System {
    std::function<void(std::span<const double> v, std::span<double> out)> apply;
    /// z = B r. Replaces r by P^T r where there is a subspace: what grew in r unseen would drown the rest in rounding
    /// [Gould, Hribar & Nocedal 2001].
    std::function<void(std::vector<double>& r, std::vector<double>& z)> precondition;
  };
  explicit ProjectedGradients(System system) : system_(std::move(system)) {}

  /// Improves x until sqrt(r·B r) <= limits.accuracy * scale; a scale of 0 stands for sqrt(r·B r) at the start.
  /// `iterations` counts applications of B. Throws SolverError where A or B is not positive, or the iteration ends
  /// without the accuracy.
  IterationResult solve(std::span<const double> b, std::span<double> x, const IterationLimits& limits, double scale);
  /// b - A x of the last solve, or P^T of it.
  const std::vector<double>& residual() const { return r_; }

private:
  System system_;
  std::vector<double> r_, z_, p_, q_;
};

}  // namespace batten
