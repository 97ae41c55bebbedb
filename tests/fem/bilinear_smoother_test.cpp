// SPDX-License-Identifier: MIT
#include <batten/fem/bilinear_smoother.h>
#include <batten/fem/cubic_refinement.h>
#include <batten/fem/multigrid.h>

#include "../support/laws.h"
#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace batten {
namespace {

using Vector = std::vector<double>;

constexpr double lambda = 0.7;

/// One of sixteen: each side's value is free or fixed.
SpaceEnds ends(int pair) {
  const auto end = [pair](int side) { return pair >> side & 1 ? EndCondition::Zero : EndCondition::Free; };
  return {{end(0), end(1)}, {end(2), end(3)}};
}

Hierarchy hierarchy(int pair, int nx, int ny, double mass) {
  return Hierarchy(Energy::conduction(1.3, mass), {Interval(0, 1, nx), Interval(0, double(ny) / nx, ny)}, 1, {},
                   ends(pair));
}

/// Random numbers, 0 where the ends take the function away.
Vector vector(const SplineSpace& s, unsigned seed) {
  Vector v = test::random_vector(s.size(), seed);
  for (int j = 0; j < s.y.size(); ++j)
    for (int i = 0; i < s.x.size(); ++i)
      if (s.is_removed(i, j)) v[static_cast<std::size_t>(j * s.x.size() + i)] = 0;
  return v;
}

/// What a pass leaves.
struct Left {
  Vector x, coarse_right;
  double product = 0;
};

void expect_near(const Left& found, const Left& expected) {
  for (std::size_t i = 0; i < found.x.size(); ++i) ASSERT_NEAR(found.x[i], expected.x[i], 1e-13 * 10) << i;
  for (std::size_t i = 0; i < found.coarse_right.size(); ++i)
    ASSERT_NEAR(found.coarse_right[i], expected.coarse_right[i], 1e-13 * 10) << i;
  EXPECT_NEAR(found.product, expected.product, 1e-12 * std::abs(expected.product));
}

/// All passes of a smoother on the finest level, from everything that they may start at.
template <typename Smoother>
std::vector<Left> passes(const Hierarchy& h, int steps) {
  const auto& level = h[0];
  const Smoother smoother(level, steps, lambda);
  const Vector b = vector(level.space, 1), given = vector(level.space, 2), coarse = vector(h[1].space, 3);
  const auto cubic = cubic_refinement(h, 0);
  StreamedSmoother::Rings rings;
  std::vector<Left> all;
  const auto descend = [&](StreamedSmoother::Start start, bool measure) {
    Left left{Vector(b.size()), Vector(coarse.size())};
    left.product = smoother.descend(start, b, left.x, left.coarse_right, measure, rings);
    all.push_back(left);
  };
  descend({}, true);
  descend({.given = given.data()}, true);
  descend({.coarse = coarse.data(), .refinement = &*level.refinement}, false);
  if (cubic) descend({.coarse = coarse.data(), .refinement = &*cubic}, false);
  if (steps > 1) {
    all.push_back({Vector(b.size()), {}});
    smoother.ascend(given, coarse, b, all.back().x, rings);
  }
  return all;
}

// Sums of fewer than a hundred products of numbers of order 1, weights below 10 included.
TEST(BilinearSmoother, does_what_the_smoother_of_any_degree_does) {
  const auto compare = [](int pair, int nx, int ny, double mass) {
    const Hierarchy h = hierarchy(pair, nx, ny, mass);
    for (const int steps : {1, 2, 3}) {
      const auto found = passes<BilinearSmoother>(h, steps), expected = passes<StreamedSmoother>(h, steps);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        SCOPED_TRACE(testing::Message() << pair << ' ' << nx << ' ' << ny << ' ' << steps << ' ' << k);
        expect_near(found[k], expected[k]);
      }
    }
  };
  for (int pair = 0; pair < 16; ++pair)
    for (const auto& [nx, ny] : {std::pair{64, 48}, {61, 35}, {17, 200}}) compare(pair, nx, ny, pair % 2 * 2.);
  compare(5, 4603, 24, 0);  // several panels
}

/// `turn` from (given, coarse) and, after it, `ascend` and `descend`, whose results are expected.
struct Turned {
  Left found, expected;
  double work = 0, expected_work = 0;
};
Turned turned(const Hierarchy& h, int steps) {
  const auto& level = h[0];
  const BilinearSmoother smoother(level, steps, lambda);
  const Vector b = vector(level.space, 1), given = vector(level.space, 2), coarse = vector(h[1].space, 3);
  StreamedSmoother::Rings rings;
  Turned all{{Vector(b.size()), Vector(coarse.size())}, {Vector(b.size()), Vector(coarse.size())}};
  const auto turn = smoother.turn(given, coarse, b, all.found.x, all.found.coarse_right, rings);
  all.found.product = turn.product;
  all.work = turn.work;
  Vector between(b.size());
  smoother.ascend(given, coarse, b, between, rings);
  all.expected_work = test::dot(b, between);
  all.expected.product =
      smoother.descend({.given = between.data()}, b, all.expected.x, all.expected.coarse_right, true, rings);
  return all;
}

TEST(BilinearSmoother, turns_as_it_ascends_and_descends) {
  const auto compare = [](int pair, int nx, int ny, double mass) {
    for (const int steps : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << pair << ' ' << nx << ' ' << ny << ' ' << steps);
      const Turned t = turned(hierarchy(pair, nx, ny, mass), steps);
      expect_near(t.found, t.expected);
      EXPECT_NEAR(t.work, t.expected_work, 1e-12 * (std::abs(t.expected_work) + 1));
    }
  };
  for (int pair = 0; pair < 16; ++pair)
    for (const auto& [nx, ny] : {std::pair{64, 48}, {61, 35}, {17, 200}}) compare(pair, nx, ny, pair % 2 * 2.);
  compare(5, 4603, 24, 0);   // two panels
  compare(10, 9001, 24, 1);  // three
}

TEST(BilinearSmoother, leaves_the_same_bits_for_every_thread_count) {
  const Hierarchy h = hierarchy(9, 2101, 97, 1);
  const int threads = omp_get_max_threads();
  std::vector<std::vector<Left>> found;
  for (const int count : {1, 2, 3}) {
    omp_set_num_threads(count);
    found.push_back(passes<BilinearSmoother>(h, 2));
    found.back().push_back(turned(h, 2).found);
  }
  omp_set_num_threads(threads);
  for (const auto& all : found)
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(all[k].x, found[0][k].x) << k;
      EXPECT_EQ(all[k].coarse_right, found[0][k].coarse_right) << k;
      EXPECT_EQ(all[k].product, found[0][k].product) << k;
    }
}

TEST(BilinearSmoother, makes_a_symmetric_cycle_for_every_pair_of_sides) {
  const GridPoints none;
  for (int pair = 1; pair < 16; ++pair) {
    const Hierarchy h = hierarchy(pair, 61, 48, 0);
    Multigrid system(h, none);
    system.set(lambda, {});
    const Vector x = vector(h[0].space, 1), y = vector(h[0].space, 2);
    Vector bx(x.size()), by(x.size());
    system.precondition(x, bx);
    system.precondition(y, by);
    const double xx = test::dot(x, bx), yy = test::dot(y, by);
    EXPECT_GT(xx, 0) << pair;
    EXPECT_NEAR(test::dot(x, by), test::dot(y, bx), 1e-9 * std::sqrt(xx * yy)) << pair;
  }
}

}  // namespace
}  // namespace batten
