// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/flows/coupled_cycle.h>
#include <batten/flows/flow_fit.h>

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <random>

namespace batten {
namespace {

using Vector = std::vector<double>;

Vector random_vector(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector v(n);
  for (double& x : v) x = uniform(random);
  return v;
}

/// Slopes of ψ and of φ at random places, as those of vectors are, with factors of their own.
struct Slopes {
  FitData psi, phi;
  Vector factor;

  explicit Slopes(int vectors) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(0, 1);
    for (int i = 0; i < vectors; ++i) {
      const double x = place(random), y = place(random);
      for (const bool is_u : {true, false}) {
        for (FitData* d : {&psi, &phi}) {
          d->x.push_back(x);
          d->y.push_back(y);
          d->value.push_back(0);
          d->weight.push_back(0.5 / vectors);
          d->kind.push_back(is_u == (d == &psi) ? Measured::SlopeY : Measured::SlopeX);
        }
        phi.weight.back() *= 4;  // factors 2
        factor.push_back(is_u ? 2 : -2);
      }
    }
  }
};

/// The two problems of one grid, their cycle, and A.
struct Coupled {
  static constexpr double ratio = 3;
  Slopes slopes;
  FitProblem psi, phi;
  Vector factor;
  CoupledParts parts;
  CoupledCycle cycle;
  double lambda = 0;

  Coupled(int vectors, int cells, const SpaceEnds& ends)
      : slopes(vectors),
        psi(slopes.psi, {Interval(0, 1, cells), Interval(0, 1, cells)},
            {.energy = Energy::third_derivatives(), .degree = 3}, ends),
        phi(slopes.phi, psi.region(), {.energy = Energy::third_derivatives(), .degree = 3}, ends),
        factor(reordered(slopes.factor, psi.order())),
        parts{psi, phi, factor, ratio},
        cycle(parts, [this](int level) { return Eigen::MatrixXd(2 * parts.psi(level).space.size(), 0); }) {}

  void set(double value) {
    lambda = value;
    psi.set(lambda, psi.weight());
    phi.set(ratio * lambda, phi.weight());
    cycle.set(lambda, PairWeights(psi.weight()));
  }
  Vector apply(const Vector& c) const {
    Vector result(c.size());
    psi.apply(psi_of(c), psi_of(std::span(result)));
    phi.apply(phi_of(c), phi_of(std::span(result)));
    cycle.data().add_cross(1, c, result);
    return result;
  }
};

SpaceEnds zero_ends() {
  using enum EndCondition;
  return {{Zero, Free}, {Free, Zero}};
}
SpaceEnds periodic_ends() {
  using enum EndCondition;
  return {{Periodic, Periodic}, {Zero, Zero}};
}

/// A vector of coefficients on a level that keeps what the spaces ask for.
Vector coefficients(const Coupled& c, int level, unsigned seed) {
  const auto& space = c.parts.psi(level).space;
  Vector v = random_vector(2 * space.size(), seed);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const int k = static_cast<int>(i % space.size());
    if (space.is_removed(k % space.x.size(), k / space.x.size())) v[i] = 0;
  }
  fill_images(space, psi_of(std::span(v)));
  fill_images(space, phi_of(std::span(v)));
  return v;
}

/// The cross terms of two forms of the same data, times the same coefficients.
void expect_same_products(const CoupledData& a, const CoupledData& b, const Vector& c) {
  Vector by_a(c.size()), by_b(c.size());
  a.add_cross(1, c, by_a);
  b.add_cross(1, c, by_b);
  double largest = 0;
  for (const double v : by_a) largest = std::max(largest, std::abs(v));
  EXPECT_GT(largest, 0);
  for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(by_a[i], by_b[i], 1e-13 * largest) << i;
}

TEST(CrossStencil, multiplies_as_the_rows_do) {
  for (const auto& ends : {zero_ends(), periodic_ends()}) {
    Coupled few(100, 16, ends);
    few.set(1e-3);
    CoupledData stored(few.parts, 0);
    stored.set(PairWeights(few.psi.weight()), true);
    ASSERT_FALSE(few.cycle.data().is_stored());
    expect_same_products(few.cycle.data(), stored, coefficients(few, 0, 1));
  }
}

TEST(CrossStencil, coarser_levels_are_those_of_the_same_rows) {
  for (const auto& ends : {zero_ends(), periodic_ends()}) {
    Coupled many(3000, 32, ends);
    many.set(1e-3);
    CoupledData fine(many.parts, 0), by_rows(many.parts, 1), shared(many.parts, 1);
    fine.set(PairWeights(many.psi.weight()), true);
    by_rows.set(PairWeights(many.psi.weight()), true);
    const Vector c = coefficients(many, 1, 1);
    shared.share(by_rows.psi(), by_rows.phi(), PairWeights(many.psi.weight()), &fine);
    Vector a(c.size()), b(c.size());
    by_rows.add_cross(1, c, a);
    shared.add_cross(1, c, b);
    const auto& space = many.parts.psi(1).space;
    double largest = 0;
    for (const double v : a) largest = std::max(largest, std::abs(v));
    EXPECT_GT(largest, 0);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const int k = static_cast<int>(i % space.size());
      if (space.is_removed(k % space.x.size(), k / space.x.size())) continue;
      ASSERT_NEAR(a[i], b[i], 1e-13 * largest) << i;
    }
  }
}

/// λ at which levels are smoothed apart, some of them together, and data-aware.
TEST(CoupledCycle, is_symmetric_and_positive) {
  for (const auto& ends : {zero_ends(), periodic_ends()})
    for (const int vectors : {400, 8000}) {
      Coupled c(vectors, 96, ends);
      for (const double lambda : {1e-2, 1e-7, 1e-13}) {
        c.set(lambda);
        const Vector r = c.apply(coefficients(c, 0, 1)), s = c.apply(coefficients(c, 0, 2));
        Vector br, bs;
        c.cycle.apply(r, br);
        c.cycle.apply(s, bs);
        const double scale = std::sqrt(dot(r, br) * dot(s, bs));
        EXPECT_GT(dot(r, br), 0);
        EXPECT_NEAR(dot(s, br), dot(r, bs), 1e-9 * scale) << vectors << " vectors, lambda " << lambda;
      }
    }
}

/// Noisy Taylor-Green flow.
VectorObservations noisy_vectors(int count) {
  constexpr double pi = std::numbers::pi;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  std::normal_distribution<double> error(0, 0.1);
  VectorObservations o;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random);
    o.x.push_back(x);
    o.y.push_back(y);
    o.u.push_back(std::sin(pi * x) * std::cos(pi * y) + error(random));
    o.v.push_back(-std::cos(pi * x) * std::sin(pi * y) + error(random));
  }
  return o;
}

TEST(CoupledCycle, iterations_depend_neither_on_lambda_nor_on_the_cells) {
  for (const int vectors : {500, 4000})
    for (const int cells : {64, 128}) {
      const Rectangle square{Interval(0, 1, cells), Interval(0, 1, cells)};
      const auto o = noisy_vectors(vectors);
      for (const double lambda : {1., 1e-7, 1e-13}) {
        const auto fit = fit_flow(o, square, {.model = FlowModel::General, .smoothing = Smoothing::fixed(lambda)});
        EXPECT_LE(fit.accuracy, 1e-8);
        EXPECT_LE(fit.iterations, 30) << vectors << " vectors, " << cells << " cells, lambda " << lambda;
      }
    }
}

// In a small region of the sphere there are pairs that the data hardly see, found from the products of many rows.
TEST(CoupledProblem, has_the_same_bits_for_every_number_of_threads) {
  const Rectangle region{Interval(0, 1, 16), Interval(0, 1, 16)};
  const auto o = noisy_vectors(4000);
  const int before = omp_get_max_threads();
  std::vector<Vector> results;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    const auto fit =
        fit_flow(o, region, {.model = FlowModel::General, .geographic = true, .smoothing = Smoothing::fixed(1e-2)});
    const auto c = fit.field.stream()->coefficients();
    results.emplace_back(c.begin(), c.end());
  }
  omp_set_num_threads(before);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

}  // namespace
}  // namespace batten
