// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/projected_gradients.h>

#include <algorithm>
#include <cmath>

namespace batten {
IterationResult ProjectedGradients::solve(std::span<const double> b, std::span<double> x, const IterationLimits& limits,
                                          double scale) {
  q_.resize(b.size());
  r_.assign(b.begin(), b.end());
  system_.apply(x, q_);
  combine(-1, q_, 1, r_);
  system_.precondition(r_, z_);
  double rz = dot(r_, z_);
  if (scale == 0) scale = std::sqrt(rz);
  IterationResult result{1, scale > 0 ? std::sqrt(rz) / scale : 0};
  p_ = z_;
  while (result.accuracy > limits.accuracy) {
    system_.apply(p_, q_);
    const double curvature = dot(p_, q_);
    if (!(curvature > 0) || result.iterations > limits.most_iterations)
      throw SolverError("ProjectedGradients: expected a relative error of at most " + number_text(limits.accuracy, 3) +
                        ", found " + number_text(result.accuracy, 3) + " after " + std::to_string(result.iterations) +
                        " iterations and a direction of energy " + number_text(curvature, 3));
    const double step = rz / curvature;
    combine(step, p_, 1, x);
    combine(-step, q_, 1, r_);
    system_.precondition(r_, z_);
    const double next = dot(r_, z_), factor = next / rz;
    rz = next;
    ++result.iterations;
    result.accuracy = std::sqrt(std::max(rz, 0.)) / scale;
    combine(1, z_, factor, p_);
  }
  return result;
}

}  // namespace batten
