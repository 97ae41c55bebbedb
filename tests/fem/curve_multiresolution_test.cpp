// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/curve_fit.h>
#include <batten/fem/curve_multiresolution.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// sin on 2^level cells of [0, 2π], as in figure 6.8.
NaturalCubic sine(int level) {
  const int cells = 1 << level;
  std::vector<double> knots;
  Eigen::MatrixXd values(cells + 1, 1);
  for (int i = 0; i <= cells; ++i) {
    knots.push_back(2 * std::numbers::pi * i / cells);
    values(i, 0) = std::sin(knots.back());
  }
  return interpolating_curve(knots, values);
}

NaturalCubic wavy(bool closed) {
  std::vector<double> knots = {0};
  Eigen::MatrixXd points(closed ? 24 : 25, 2);
  for (int i = 0; i < 24; ++i) knots.push_back(knots.back() + 1 + 0.4 * std::sin(3 * i));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 24;
    points.row(i) << std::cos(angle) + 0.1 * std::cos(7 * angle), std::sin(angle);
  }
  return interpolating_curve(knots, points, closed);
}

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

TEST(CurveMultiresolution, is_lossless_and_its_energies_add) {  // [Warren & Weimer 2001, th. 6.5]
  for (const NaturalCubic& curve : {sine(5), wavy(false), wavy(true)}) {
    const auto parts = analysed(curve, 3);
    ASSERT_EQ(parts.details.size(), 3u);
    EXPECT_LT(largest(parts.level(3).coefficients() - curve.coefficients()), 1e-13);
    double energy = parts.coarsest.energy();
    for (const auto& detail : parts.details) energy += detail.energy();
    EXPECT_NEAR(energy, curve.energy(), 1e-12 * curve.energy());
  }
}

TEST(CurveMultiresolution, details_vanish_at_the_knots_below_and_coarse_curves_interpolate) {
  const NaturalCubic curve = wavy(false);
  const auto parts = analysed(curve, 3);
  for (const auto& detail : parts.details)
    for (Eigen::Index i = 0; i < detail.values().rows(); i += 2) EXPECT_LT(largest(detail.values().row(i)), 1e-13);
  for (int i = 0; i <= 3; ++i) EXPECT_LT(largest(parts.coarsest.values().row(i) - curve.values().row(8 * i)), 1e-13);
}

TEST(CurveMultiresolution, of_a_sine_has_details_that_fall_by_the_order_of_the_spline) {  // figure 6.8
  // The natural ends suit sin, whose second derivative is 0 there: errors fall like h^4, energies of details like h^4.
  const auto parts = analysed(sine(8), 6);
  for (std::size_t k = 2; k + 1 < parts.details.size(); ++k)
    EXPECT_NEAR(parts.details[k].energy() / parts.details[k + 1].energy(), 16, 1.5) << k;
  EXPECT_NEAR(sine(8).energy(), std::numbers::pi, 1e-6);  // ∫ sin² over a period
}

TEST(CompressedCurve, knows_its_error) {
  const auto parts = analysed(wavy(false), 3);
  const auto all = compressed(parts, 0);
  EXPECT_EQ(all.kept, 25);
  EXPECT_LT(all.energy_error, 1e-20);
  const auto some = compressed(parts, 0.05);
  EXPECT_LT(some.kept, 25);
  EXPECT_GT(some.kept, 4);
  const NaturalCubic a = wavy(false), b = some.parts.level(3);
  const NaturalCubic difference(a.knots(), a.coefficients() - b.coefficients());
  EXPECT_GT(some.energy_error, 1e-6);
  EXPECT_NEAR(difference.energy(), some.energy_error, 1e-11 * a.energy());
}

TEST(CurveMultiresolution, needs_cells_that_can_be_halved) {
  EXPECT_THAT([] { analysed(wavy(false), 4); },
              ThrowsMessage<InvalidInput>(HasSubstr("must be a multiple of 2^4 that leaves 1, found 24")));
  EXPECT_THROW(analysed(sine(2), 3), InvalidInput);
  EXPECT_THROW(analysed(wavy(true), -1), InvalidInput);
  EXPECT_THROW(compressed(analysed(sine(2), 1), -1), InvalidInput);
}

}  // namespace
}  // namespace batten
