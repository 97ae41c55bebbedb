// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/spline_basis.h>
#include <batten/fem/hierarchy.h>

#include "dense.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

// The laws of the design, each a function that fails the calling test. They know nothing of how the objects compute.
namespace batten::test {

/// Numbers of order 1, the same on every machine.
inline std::vector<double> random_vector(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<double> v(n);
  for (double& x : v) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
  return v;
}

inline double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

inline std::vector<double> applied(const TensorSum& t, std::span<const double> v) {
  std::vector<double> result(t.output_size());
  t.apply(v, result);
  return result;
}

/// N_{k+1} R_k = N_k at 200 positions.
inline void expect_refinement_represents(const SplineBasis& coarse, const SplineBasis& fine) {
  const auto R = dense(coarse.refinement(fine));
  for (int s = 0; s <= 200; ++s) {
    const double t = fine.interval().finest_cells() * s / 200.;
    const auto f = fine.at(t), c = coarse.at(t);
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(coarse.size());
    for (int a = 0; a <= fine.degree(); ++a) {
      difference += f.values[static_cast<std::size_t>(a)] * R.row(f.first + a).transpose();
      difference[c.first + a] -= c.values[static_cast<std::size_t>(a)];
    }
    ASSERT_LT(difference.cwiseAbs().maxCoeff(), 1e-13) << "at " << t;
  }
}

/// Σ_i N_i = 1 and Σ_i N_i^(r) = 0.
inline void expect_partition_of_unity(const SplineBasis& basis) {
  for (int s = 0; s <= 97; ++s)
    for (int order = 0; order <= basis.degree(); ++order) {
      double sum = 0;
      for (double v : basis.at(basis.interval().finest_cells() * s / 97., order).values) sum += v;
      ASSERT_NEAR(sum, order == 0 ? 1 : 0, 1e-13 * 500) << "derivative " << order;
    }
}

inline std::vector<double> applied(const Operator& e, std::span<const double> v) {
  std::vector<double> result(e.size());
  e.apply(v, result);
  return result;
}

/// E_{k+1} = R_k^T E_k R_k, applied to a random vector; level k + 1 is the coarser one.
inline void expect_galerkin(const Hierarchy::Level& fine, const Hierarchy::Level& coarse) {
  const auto c = random_vector(coarse.space.size(), 3);
  const auto product = applied(*fine.restriction, applied(fine.energy, applied(*fine.refinement, c)));
  const auto exact = applied(coarse.energy, c);
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    largest = std::max(largest, std::abs(exact[i]));
    error = std::max(error, std::abs(exact[i] - product[i]));
  }
  EXPECT_LT(error, 1e-12 * largest);
}

/// x · (E y) = y · (E x).
inline void expect_symmetric(const Operator& e) {
  const auto x = random_vector(e.size(), 1), y = random_vector(e.size(), 2);
  const double a = dot(x, applied(e, y)), b = dot(y, applied(e, x));
  EXPECT_NEAR(a, b, 1e-12 * std::sqrt(dot(x, applied(e, x)) * dot(y, applied(e, y))));
}

}  // namespace batten::test
