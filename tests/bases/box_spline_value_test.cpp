// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/bspline_scheme.h>
#include <batten/domains/errors.h>

#include <gtest/gtest.h>

#include <random>

namespace batten {
namespace {

using Q = Rational;

const Directions linear = {{1, 0}, {0, 1}, {1, 1}};
const Directions zwart_powell = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
const Directions quartic = {{1, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 1}};
const Directions eight = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}};

TEST(BoxSplineValue, has_the_derived_exact_values) {
  EXPECT_EQ(box_spline_value(linear, Q(1), Q(1)), 1);
  EXPECT_EQ(box_spline_value(linear, Q(1, 2), Q(1, 2)), Q(1, 2));
  EXPECT_EQ(box_spline_value(zwart_powell, Q(1, 2), Q(3, 2)), Q(1, 2));
  for (const auto& [x, y] : {std::pair{0, 1}, {1, 1}, {0, 2}, {1, 2}})
    EXPECT_EQ(box_spline_value(zwart_powell, Q(x), Q(y)), Q(1, 4));
  EXPECT_EQ(box_spline_value(zwart_powell, Q(0), Q(3, 2)), Q(3, 8));
  EXPECT_EQ(box_spline_value(zwart_powell, Q(1, 2), Q(1)), Q(3, 8));
  EXPECT_EQ(box_spline_value(zwart_powell, Q(1, 2), Q(1, 2)), Q(1, 8));
  EXPECT_EQ(box_spline_value(zwart_powell, Q(0), Q(1, 2)), Q(1, 16));
  EXPECT_EQ(box_spline_value(quartic, Q(2), Q(2)), Q(1, 2));
  for (const auto& [x, y] : {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 3}, {3, 2}, {3, 3}})
    EXPECT_EQ(box_spline_value(quartic, Q(x), Q(y)), Q(1, 12));
  EXPECT_EQ(box_spline_value(quartic, Q(3, 2), Q(3, 2)), Q(21, 64));
  EXPECT_EQ(box_spline_value(quartic, Q(3, 2), Q(2)), Q(21, 64));
  EXPECT_DOUBLE_EQ(box_spline_value(quartic, 1.5, 2.), 21. / 64);
}

TEST(ConeSplineValue, has_the_printed_pieces) {
  // [Warren & Weimer 2001, sec. 2.3.3], as repaired in the reference
  for (int i = -12; i <= 12; ++i)
    for (int j = -3; j <= 12; ++j) {
      const Q x(i, 5), y(j, 5);
      const Q c1 = y < 0 || x < 0 ? Q(0) : x >= y ? y : x;
      EXPECT_EQ(cone_spline_value(linear, x, y), c1);
      Q c2 = 0, c4 = 0;
      if (y >= 0 && x >= y) c2 = y * y / 2, c4 = y * y * y * (2 * x - y) / 12;
      if (x >= 0 && x < y) c2 = (-x * x + 2 * x * y + y * y) / 4, c4 = x * x * x * (2 * y - x) / 12;
      if (x < 0 && x >= -y) c2 = (x + y) * (x + y) / 4;
      EXPECT_EQ(cone_spline_value(zwart_powell, x, y), c2) << x << " " << y;
      EXPECT_EQ(cone_spline_value(quartic, x, y), c4) << x << " " << y;
    }
  EXPECT_EQ(cone_spline_value(zwart_powell, Q(1), Q(2)), Q(7, 4));
  EXPECT_EQ(cone_spline_value(zwart_powell, Q(-1), Q(2)), Q(1, 4));
  EXPECT_EQ(cone_spline_value(quartic, Q(1), Q(1)), Q(1, 12));
  EXPECT_THROW(cone_spline_value({{1, 0}, {0, -1}}, Q(1), Q(1)), InvalidInput);
}

TEST(ConeSplineValue, is_homogeneous) {
  for (const auto& directions : {linear, zwart_powell, quartic}) {
    Q scale = 1;
    for (std::size_t k = 2; k < directions.size(); ++k) scale *= 2;
    EXPECT_EQ(cone_spline_value(directions, Q(6, 7), Q(10, 3)),
              scale * cone_spline_value(directions, Q(3, 7), Q(5, 3)));
  }
}

void expect_refinement(const Directions& directions, int trials) {
  const auto s = box_mask(directions);
  std::mt19937 random(3);
  for (int trial = 0; trial < trials; ++trial) {
    const Q x(static_cast<int>(random() % 900u) - 200, 97), y(static_cast<int>(random() % 600u) - 50, 89);
    Q sum = 0;
    for (int j = s.first()[1]; j <= s.last()[1]; ++j)
      for (int i = s.first()[0]; i <= s.last()[0]; ++i)
        if (s[{i, j}] != 0) sum += s[{i, j}] * box_spline_value(directions, 2 * x - i, 2 * y - j);
    EXPECT_EQ(sum, box_spline_value(directions, x, y)) << x << " " << y;
  }
}

TEST(BoxSplineValue, obeys_refinement_exactly_at_forty_points) {
  for (const auto& directions : {linear, zwart_powell, quartic}) expect_refinement(directions, 40);
}

TEST(BoxSplineValue, obeys_refinement_for_directions_that_point_down_or_repeat) {
  expect_refinement({{1, 0}, {0, -1}}, 40);
  expect_refinement({{-1, 0}, {0, -1}, {1, 1}, {1, 1}, {2, -1}}, 12);
  expect_refinement({{3, 1}, {1, 2}, {2, 0}}, 12);
}

TEST(BoxSplineValue, sums_to_one_on_mesh_lines_and_off_them) {
  for (const auto& directions : {Directions{{1, 0}, {0, 1}}, linear, zwart_powell, quartic, Directions{{2, 0}, {0, 1}}})
    for (const auto& [x, y] : {std::pair{Q(0), Q(0)}, {Q(1, 2), Q(1, 2)}, {Q(1, 3), Q(0)}, {Q(2, 7), Q(3, 5)}}) {
      Q sum = 0;
      for (int i = -6; i <= 6; ++i)
        for (int j = -6; j <= 6; ++j) sum += box_spline_value(directions, x - i, y - j);
      EXPECT_EQ(sum, 1);
    }
}

TEST(BoxSplineValue, of_axis_directions_is_a_product_of_b_splines) {
  const Directions directions = {{1, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 1}};
  for (const auto& [x, y] : {std::pair{Q(1), Q(1)}, {Q(5, 3), Q(1, 4)}, {Q(2, 7), Q(8, 5)}})
    for (int r : {0, 1, 2})
      for (int s : {0, 1})
        EXPECT_EQ(box_spline_value(directions, x, y, {r, s}), bspline_value(3, x, r) * bspline_value(2, y, s));
}

TEST(BoxSplineValue, has_differences_as_directional_derivatives) {
  // D_ξ n_Σ(x) = n_{Σ\ξ}(x) - n_{Σ\ξ}(x - ξ), here for ξ = (1, 1) = e_x + e_y
  const Directions rest = {{1, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 1}};
  for (const auto& [x, y] : {std::pair{Q(1), Q(1)}, {Q(5, 3), Q(7, 4)}, {Q(2), Q(8, 5)}}) {
    EXPECT_EQ(box_spline_value(quartic, x, y, {1, 0}) + box_spline_value(quartic, x, y, {0, 1}),
              box_spline_value(rest, x, y) - box_spline_value(rest, x - 1, y - 1));
    EXPECT_EQ(box_spline_value(quartic, x, y, {3, 2}), 0);
  }
  EXPECT_THROW(box_spline_value(quartic, Q(0), Q(0), {-1, 0}), InvalidInput);
}

TEST(BoxSplineValue, of_eight_directions_refines_exactly) { expect_refinement(eight, 1); }

}  // namespace
}  // namespace batten
