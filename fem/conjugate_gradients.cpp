// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/fem/conjugate_gradients.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

using Vector = std::vector<double>;

constexpr int row_length = 1024;  // vectors are cut into rows of this length, for the fixed blocks

template <typename Work>
double sum_over(std::size_t n, Work&& work) {
  const int rows = static_cast<int>((n + row_length - 1) / row_length);
  return sum_blocks(RowBlocks(rows, row_length), [&](int begin, int end) {
    return work(static_cast<std::size_t>(begin) * row_length, std::min(n, static_cast<std::size_t>(end) * row_length));
  });
}

double dot(std::span<const double> a, std::span<const double> b) {
  return sum_over(a.size(), [&](std::size_t from, std::size_t to) {
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = from; i < to; ++i) sum += a[i] * b[i];
    return sum;
  });
}

/// c += step p and r -= step q in one pass.
void move(double step, std::span<const double> p, std::span<const double> q, std::span<double> c, std::span<double> r) {
  sum_over(p.size(), [&](std::size_t from, std::size_t to) {
#pragma omp simd
    for (std::size_t i = from; i < to; ++i) {
      c[i] += step * p[i];
      r[i] -= step * q[i];
    }
    return 0.;
  });
}

/// p = z + factor p
void turn(double factor, std::span<const double> z, std::span<double> p) {
  sum_over(p.size(), [&](std::size_t from, std::size_t to) {
#pragma omp simd
    for (std::size_t i = from; i < to; ++i) p[i] = z[i] + factor * p[i];
    return 0.;
  });
}

void residual(const Multigrid& system, std::span<const double> b, std::span<const double> c, Vector& r) {
  system.apply(c, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
}

}  // namespace

double energy_size(const Multigrid& system, std::span<const double> b) {
  Vector z(b.size());
  system.precondition(b, z);
  return std::sqrt(std::max(0., dot(b, z)));
}

namespace {

IterationResult iterate(const Multigrid& system, std::span<const double> b, std::span<double> c,
                        const IterationLimits& limits, double scale) {
  const std::size_t n = b.size();
  Vector r(b.begin(), b.end()), z(n), p(n), q(n);
  IterationResult result;
  const bool from_zero = std::all_of(c.begin(), c.end(), [](double v) { return v == 0; });
  if (!from_zero) {
    if (scale == 0) scale = energy_size(system, b);
    residual(system, b, c, r);
  }
  for (int restart = 0;; ++restart) {
    system.precondition(r, z);
    double rz = dot(r, z);
    if (scale == 0) scale = std::sqrt(std::max(0., rz));
    result.accuracy = scale > 0 ? std::sqrt(std::max(0., rz)) / scale : 0;
    if (!(result.accuracy > limits.accuracy) || restart == 2) return result;
    p = z;
    while (result.iterations < limits.most_iterations) {
      ++result.iterations;
      system.apply(p, q);
      const double curvature = dot(p, q);
      if (!(curvature > 0) || !(rz > 0))
        throw SolverError("solve: expected a positive definite system, found a direction of energy " +
                          std::to_string(curvature));
      move(rz / curvature, p, q, c, r);
      system.precondition(r, z);
      const double next = dot(r, z);
      const double accuracy = std::sqrt(std::max(0., next)) / scale;
      if (accuracy <= limits.accuracy) break;
      turn(next / rz, z, p);
      rz = next;
    }
    residual(system, b, c, r);  // the true one; the loop ends if it agrees
    system.precondition(r, z);
    result.accuracy = std::sqrt(std::max(0., dot(r, z))) / scale;
    if (result.accuracy <= 10 * limits.accuracy || result.iterations >= limits.most_iterations) return result;
  }
}

}  // namespace

IterationResult solve(const Multigrid& system, std::span<const double> b, std::span<double> c,
                      const IterationLimits& limits, double scale) {
  const auto result = iterate(system, b, c, limits, scale);
  if (system.null_projection()) system.null_projection()->set_component(b, c);
  return result;
}

}  // namespace batten
