// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/preconditioned_system.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using Vector = std::vector<double>;

/// A and B by their diagonals.
struct Diagonal : PreconditionedSystem {
  Vector a, b;

  Diagonal(Vector of_a, Vector of_b) : a(std::move(of_a)), b(std::move(of_b)) {}
  double apply(std::span<const double> c, std::span<double> out) const override {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      out[i] = a[i] * c[i];
      sum += c[i] * out[i];
    }
    return sum;
  }
  void precondition(std::span<const double> r, Vector& out) const override {
    out.resize(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) out[i] = b[i] * r[i];
  }
};

constexpr IterationLimits limits{.accuracy = 1e-10, .most_iterations = 50};

TEST(SolveSystem, takes_a_step_for_each_eigenvalue) {
  const Diagonal system({2, 2, 3, 3, 4, 4}, {1, 1, 1, 1, 1, 1});
  const Vector right = {2, 4, 3, 6, 4, 8};
  Vector c(6);
  const auto found = solve_system(system, right, c, limits, 0);
  EXPECT_LE(found.accuracy, limits.accuracy);
  EXPECT_EQ(found.iterations, 3);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(c[i], i % 2 == 0 ? 1 : 2, 1e-12);
}

TEST(SolveSystem, ends_where_an_energy_is_rounding) {
  const Diagonal system({1, 1, -1e-17}, {1, 1, 1e14});
  const Vector right = {1, 2, 1e-4};
  Vector c(3);
  const auto found = solve_system(system, right, c, limits, 0);
  EXPECT_GT(found.accuracy, limits.accuracy);  // and says so
  for (const double v : c) EXPECT_TRUE(std::isfinite(v));
}

TEST(SolveSystem, refuses_what_is_indefinite) {
  const Diagonal system({1, -1}, {1, 1});
  const Vector right = {1, 2};
  Vector c(2);
  EXPECT_THROW(solve_system(system, right, c, limits, 0), SolverError);
}

TEST(SolveSystem, takes_a_negative_size_for_no_success) {
  const Diagonal system({1, 1}, {1, -1});
  const Vector right = {1, 2};
  Vector c(2);
  EXPECT_NEAR(solve_system(system, right, c, limits, 1).accuracy, std::sqrt(3), 1e-12);
}

TEST(SolveSystem, drops_a_start_that_is_worse_than_none) {
  const Diagonal system({1, 2}, {1, 0.5});
  const Vector right = {1, 2};
  Vector c = {1e30, -1e30};  // rounding of its residual hides the right side
  const auto found = solve_system(system, right, c, limits, 0);
  EXPECT_LE(found.accuracy, limits.accuracy);
  EXPECT_NEAR(c[0], 1, 1e-12);
  EXPECT_NEAR(c[1], 1, 1e-12);
}

}  // namespace
}  // namespace batten
