// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/domains/errors.h>
#include <batten/flows/flow_field.h>

#include "../support/laws.h"
#include "../support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using testing::HasSubstr;

const Rectangle region = {Interval(-1, 2, 9), Interval(3, 5, 7)};

Solution random_spline(int degree, unsigned seed) {
  const auto size = static_cast<std::size_t>((9 + degree) * (7 + degree));
  return {region, degree, test::random_vector(size, seed)};
}

TEST(FlowField, is_the_rotation_of_its_stream_function_and_the_gradient_of_its_potential) {
  for (const int degree : {3, 4, 5}) {
    const Solution psi = random_spline(degree, 1), phi = random_spline(degree, 2);
    const FlowField field(psi, phi);
    for (const auto& [x, y] : {std::pair{-1., 3.}, {0.3, 4.4}, {1.9, 3.01}, {2., 5.}}) {
      const auto v = field.velocity(x, y);
      const auto g = field.gradient(x, y);
      const auto d = [&](const Solution& p, int a, int b) { return p.derivative(x, y, a, b); };
      EXPECT_NEAR(v.u, d(psi, 0, 1) + d(phi, 1, 0), 1e-12);
      EXPECT_NEAR(v.v, -d(psi, 1, 0) + d(phi, 0, 1), 1e-12);
      EXPECT_NEAR(g.u_x, d(psi, 1, 1) + d(phi, 2, 0), 1e-11);
      EXPECT_NEAR(g.u_y, d(psi, 0, 2) + d(phi, 1, 1), 1e-11);
      EXPECT_NEAR(g.v_x, -d(psi, 2, 0) + d(phi, 1, 1), 1e-11);
      EXPECT_NEAR(g.v_y, -d(psi, 1, 1) + d(phi, 0, 2), 1e-11);
      EXPECT_NEAR(field.divergence(x, y), d(phi, 2, 0) + d(phi, 0, 2), 1e-11);
      EXPECT_NEAR(field.vorticity(x, y), -d(psi, 2, 0) - d(psi, 0, 2), 1e-11);
      EXPECT_NEAR(field.speed(x, y), std::hypot(v.u, v.v), 1e-13);
      EXPECT_EQ(field.stream_function(x, y), psi.value(x, y));
      EXPECT_EQ(FlowField(psi).divergence(x, y), 0);
      EXPECT_EQ(FlowField({}, phi).vorticity(x, y), 0);
    }
    EXPECT_TRUE(std::isnan(field.velocity(2.1, 4).u));
  }
}

TEST(FlowField, does_not_lose_its_velocity_in_a_large_stream_function) {
  // Coefficients of 10^9 that rise by 1/4 in each row of cells 2/7 high: u = 7/8.
  std::vector<double> c;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 12; ++i) c.push_back(1e9 + 0.25 * std::clamp(j, 0, 9));
  const FlowField field{Solution(region, 3, c)};
  EXPECT_NEAR(field.velocity(0.5, 4).u, 0.875, 1e-14);
  EXPECT_NEAR(field.velocity(0.5, 4).v, 0, 1e-14);
}

TEST(FlowField, has_samples_at_the_corners_of_the_cells) {
  const FlowField field(random_spline(4, 3), random_spline(4, 4));
  const GridSamples s = field.samples();
  ASSERT_EQ(s.points, (std::array<int, 2>{10, 8}));
  for (const auto& array : s.arrays)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 10; ++i) {
        const double x = -1 + i / 3., y = 3 + j * 2 / 7.;
        const auto k = static_cast<std::size_t>(i + 10 * j);
        const double found = array.values[array.name == "velocity" ? 3 * k + 1 : k];
        const double expected = array.name == "velocity"          ? field.velocity(x, std::min(y, 5.)).v
                                : array.name == "divergence"      ? field.divergence(x, std::min(y, 5.))
                                : array.name == "vorticity"       ? field.vorticity(x, std::min(y, 5.))
                                : array.name == "speed"           ? field.speed(x, std::min(y, 5.))
                                : array.name == "stream_function" ? field.stream()->value(x, std::min(y, 5.))
                                                                  : field.potential()->value(x, std::min(y, 5.));
        ASSERT_NEAR(found, expected, 1e-10) << array.name << " at " << i << ", " << j;
      }
  EXPECT_EQ(s.arrays.size(), 6u);
}

TEST(FlowField, has_exact_inner_products) {
  const FlowField a(random_spline(3, 5), random_spline(3, 6)), b(random_spline(3, 7), random_spline(3, 8));
  const GaussRule rule = gauss_rule(4);  // exact for the products, of degree 6 in each direction
  double expected = 0;
  for (int cell = 0; cell < 63; ++cell)
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < 4; ++q) {
        const double x = -1 + (cell % 9 + rule.place[p]) / 3, y = 3 + (cell / 9 + rule.place[q]) * 2 / 7;
        const auto va = a.velocity(x, y), vb = b.velocity(x, y);
        expected += rule.weight[p] * rule.weight[q] / 3 * 2 / 7 * (va.u * vb.u + va.v * vb.v);
      }
  EXPECT_NEAR(inner_product(a, b), expected, 1e-11);
  EXPECT_NEAR(inner_product(a, a),
              inner_product(FlowField(a.stream()), a) + inner_product(FlowField({}, a.potential()), a), 1e-10);
}

TEST(FlowField, mean_value_is_that_of_the_spline) {
  // of x: Greville abscissae as coefficients
  std::vector<double> c;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 12; ++i)
      c.push_back(-1 + (std::clamp(i - 2, 0, 9) + std::clamp(i - 1, 0, 9) + std::clamp(i, 0, 9)) / 9.);
  EXPECT_NEAR(mean_value(Solution(region, 3, c)), 0.5, 1e-14);
}

TEST(FlowField, survives_a_record) {
  const FlowField field(random_spline(3, 5), random_spline(3, 6));
  const FlowField again = FlowField::from_record(field.to_record());
  EXPECT_EQ(again.velocity(0.1, 3.3).u, field.velocity(0.1, 3.3).u);
  EXPECT_EQ(FlowField::from_record(FlowField(field.stream()).to_record()).potential().has_value(), false);
  Record record = field.to_record();
  record.arrays.clear();
  EXPECT_THAT(message_of<InvalidInput>([&] { FlowField::from_record(record); }), HasSubstr("found none"));
  record.kind = "surface";
  EXPECT_THAT(message_of<InvalidInput>([&] { FlowField::from_record(record); }), HasSubstr("kind \"flow\""));
}

TEST(FlowField, refuses_parts_that_do_not_belong_together) {
  EXPECT_THAT(message_of<InvalidInput>([] { FlowField({}, {}); }), HasSubstr("found none"));
  EXPECT_THAT(message_of<InvalidInput>([] { FlowField(random_spline(3, 1), random_spline(4, 1)); }),
              HasSubstr("one degree"));
  EXPECT_THAT(
      message_of<InvalidInput>([] { inner_product(FlowField(random_spline(3, 1)), FlowField(random_spline(4, 1))); }),
      HasSubstr("one degree"));
}

}  // namespace
}  // namespace batten
