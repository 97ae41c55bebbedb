// SPDX-License-Identifier: MIT
#include <batten/flows/flow_field.h>
#include <batten/flows/quadratic_pairs.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using enum FlowSide;

const Rectangle region = {Interval(10, 13, 12), Interval(-1, 1, 8)};

/// How many pairs cancel, by hand. grad φ = a (1, 0) + b (0, 1) + c (x - x0, y0 - y) + d (y, x) keeps the sides as:
/// φ_n = 0 on a wall x = x0 leaves b and c about x0, likewise in y; a periodic direction leaves neither c nor d;
/// without slip nothing is left. In the space of ψ, 0 on walls, a channel and a period leave no slope across or along.
struct Case {
  FlowSides sides;
  std::size_t exchangeable, unseen;  // the second with constants
};

const std::vector<Case> cases = {{{Free, Free, Free, Free}, 4, 6},                   // a, b, c, d and two constants
                                 {{Free, Free, Wall, Free}, 2, 3},                   // a, c and that of φ
                                 {{Wall, Free, Free, Wall}, 1, 2},                   // c about the corner
                                 {{Free, Free, Wall, Wall}, 1, 1},                   // a: ψ differs between the walls
                                 {{Wall, Free, Wall, Wall}, 0, 1},                   //
                                 {{Wall, Wall, Wall, Wall}, 0, 1},                   //
                                 {{NoSlip, Free, Free, Free}, 0, 0},                 //
                                 {{Periodic, Periodic, Free, Free}, 2, 2},           // a and b, neither in the spaces
                                 {{Periodic, Periodic, Wall, Free}, 1, 1},           // a
                                 {{Periodic, Periodic, Periodic, Periodic}, 2, 2}};  //

TEST(QuadraticPairs, are_as_many_as_the_sides_leave) {
  for (const Case& c : cases) {
    EXPECT_EQ(exchangeable_pairs(region, c.sides).size(), c.exchangeable);
    EXPECT_EQ(unseen_pairs(region, c.sides).size(), c.unseen);
  }
}

TEST(QuadraticPairs, cancel_and_keep_the_sides) {
  const auto spline = [](const QuadraticFunction& q) {
    const SplineSpace space = finest_space(region, 3);
    std::vector<double> c(space.size());
    q.add_to(space, c);
    return Solution(region, 3, std::move(c));
  };
  for (const Case& c : cases)
    for (const auto& pairs : {exchangeable_pairs(region, c.sides), unseen_pairs(region, c.sides)})
      for (const QuadraticPair& pair : pairs) {
        const FlowField sum(spline(pair.psi), spline(pair.phi)), part(spline(pair.psi));
        for (int k = 0; k <= 10; ++k) {
          const double x = 10 + 0.3 * k, y = -1 + 0.2 * k;
          EXPECT_LE(sum.speed(x, 0.3) + sum.speed(12.1, y), 1e-12);
          const auto [low, high] = std::pair{part.velocity(x, -1), part.velocity(x, 1)};
          const auto [left, right] = std::pair{part.velocity(10, y), part.velocity(13, y)};
          EXPECT_LE(is_wall(c.sides.bottom) ? std::abs(low.v) : 0, 1e-12);
          EXPECT_LE(is_wall(c.sides.top) ? std::abs(high.v) : 0, 1e-12);
          EXPECT_LE(is_wall(c.sides.left) ? std::abs(left.u) : 0, 1e-12);
          EXPECT_LE(is_wall(c.sides.right) ? std::abs(right.u) : 0, 1e-12);
          EXPECT_LE(c.sides.left == Periodic ? std::abs(left.u - right.u) + std::abs(left.v - right.v) : 0, 1e-12);
        }
      }
}

}  // namespace
}  // namespace batten
