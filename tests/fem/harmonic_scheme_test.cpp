// SPDX-License-Identifier: MIT
// Bounded harmonic splines: the numbers of [Warren & Weimer 2001, sec. 6.4], printed with four digits.
#include <batten/bases/polyharmonic_coefficients.h>
#include <batten/domains/errors.h>
#include <batten/fem/padded_scheme.h>
#include <batten/fem/variational_scheme.h>

#include "../support/variational_domains.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Table = std::vector<std::vector<double>>;

constexpr double printed = 0.6e-4;  // half of the last digit, and a little for how the source rounded

/// Hat functions of the source on [0, cells]², the fine level having twice as many.
VariationalDomain hats(int cells) {
  VariationalDomain domain{Breakpoints::uniform(0, cells, 2 * cells)};
  domain.y = Breakpoints::uniform(0, cells, 2 * cells);
  domain.triangles = true;
  return domain;
}

VariationalScheme scheme_on(int cells) { return {energy_levels(spline_levels(hats(cells), 1)), 0}; }

/// The largest difference between a table and values on a grid of `columns` columns.
double difference(const Table& table, const VectorXd& values, int columns) {
  double largest = 0;
  for (std::size_t j = 0; j < table.size(); ++j)
    for (std::size_t i = 0; i < table[j].size(); ++i)
      largest = std::max(largest, std::abs(table[j][i] - values[static_cast<int>(i) + static_cast<int>(j) * columns]));
  return largest;
}

TEST(HarmonicScheme, energies_of_hats_are_the_rows_of_figure_6_9) {
  const MatrixXd E = SplineLevel(hats(3)).energy();
  const auto row = [&](int i, int j) { return E.row(i + 7 * j); };
  EXPECT_NEAR(row(0, 0)[0], 1, 1e-15);
  EXPECT_NEAR(row(0, 0)[1], -0.5, 1e-15);
  EXPECT_NEAR(row(0, 0)[7], -0.5, 1e-15);
  EXPECT_NEAR(row(0, 0)[8], 0, 1e-15);
  EXPECT_NEAR(row(1, 0)[1], 2, 1e-15);
  EXPECT_NEAR(row(1, 0)[0], -0.5, 1e-15);
  EXPECT_NEAR(row(1, 0)[8], -1, 1e-15);
  EXPECT_NEAR(row(1, 1)[8], 4, 1e-15);
  for (int neighbour : {1, 7, 9, 15}) EXPECT_NEAR(row(1, 1)[neighbour], -1, 1e-15);
  EXPECT_NEAR(row(1, 1).cwiseAbs().sum(), 8, 1e-14);
}

TEST(HarmonicScheme, columns_on_the_quadrant_are_those_printed) {
  const std::vector<std::pair<std::array<int, 2>, Table>> columns = {
      {{0, 0},
       {{1.4535, 0.4535, -0.1277, -0.0338, -0.0106},
        {0.4535, 0.2441, 0.0347, 0.0015, -0.0022},
        {-0.1277, 0.0347, 0.021, 0.0073, 0.0019},
        {-0.0338, 0.0015, 0.0073, 0.0048, 0.0023},
        {-0.0106, -0.0022, 0.0019, 0.0023, 0.0016}}},
      {{1, 0},
       {{-0.2554, 0.0695, 0.0421, 0.0146, 0.0038},
        {0.4197, 0.2456, 0.0421, 0.0063, 0.0001},
        {1.443, 0.4513, -0.1258, -0.0315, -0.0089},
        {0.4496, 0.2424, 0.035, 0.0025, -0.0013},  // our copy reads .4499; s[1,0] + s[5,0] = .4535 - .0040
        {-0.1295, 0.0336, 0.0208, 0.0077, 0.0024}}},
      {{1, 1},
       {{0.0841, 0.0841, -0.2516, 0.0699, 0.0417},
        {0.0841, 0.252, 0.4198, 0.2448, 0.0413},
        {-0.2516, 0.4198, 1.4341, 0.4483, -0.1271},
        {0.0699, 0.2448, 0.4483, 0.2413, 0.0343},
        {0.0417, 0.0413, -0.1271, 0.0343, 0.021}}}};
  for (const auto& [place, table] : columns)
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        EXPECT_NEAR(harmonic_quadrant_entry(i, j, place[0], place[1]),
                    table[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], printed)
            << "column " << place[0] << ", " << place[1] << " entry " << i << ", " << j;
}

// E S = U E on the quadrant, exactly: every row of E has at most five entries.
TEST(HarmonicScheme, reflection_satisfies_the_two_scale_relation) {
  const MatrixXd E = SplineLevel(hats(6)).energy();  // 13 x 13; its rows away from the far sides are the quadrant's
  for (int j1 = 0; j1 < 9; ++j1)
    for (int i1 = 0; i1 < 9; ++i1)
      for (int j2 = 0; j2 < 4; ++j2)
        for (int i2 = 0; i2 < 4; ++i2) {
          double sum = 0;
          for (int j = 0; j < 13; ++j)
            for (int i = 0; i < 13; ++i)
              if (E(i1 + 13 * j1, i + 13 * j) != 0)
                sum += E(i1 + 13 * j1, i + 13 * j) * harmonic_quadrant_entry(i, j, i2, j2);
          const bool sampled = i1 % 2 == 0 && j1 % 2 == 0;
          const double expected = sampled ? E(i1 / 2 + 13 * (j1 / 2), i2 + 13 * j2) : 0;
          ASSERT_NEAR(sum, expected, 1e-12);
        }
}

TEST(HarmonicScheme, corner_rules_are_those_of_figure_6_12) {
  const Table first = {{1.4534, -0.2556, -0.0213, -0.0039, -0.001},
                       {-0.2556, 0.0838, 0.0073, -0.0012, -0.0008},
                       {-0.0213, 0.0073, 0.0065, 0.0021, 0.0005},
                       {-0.0039, -0.0012, 0.0021, 0.002, 0.0009},
                       {-0.001, -0.0008, 0.0005, 0.0009, 0.0004}};
  const Table second = {{1.4535, -0.2554, -0.0211, -0.0035, -0.001, -0.0004, -0.0002, -0.0001, -0.0001},
                        {-0.2554, 0.0841, 0.0076, -0.0008, -0.0009, -0.0005, -0.0003, -0.0002, -0.0001},
                        {-0.0211, 0.0076, 0.0066, 0.0019, 0.0004, 0, -0.0001, -0.0001, -0.0001},
                        {-0.0035, -0.0008, 0.0019, 0.0014, 0.0006, 0.0002, 0.0001, 0, 0},
                        {-0.001, -0.0009, 0.0004, 0.0006, 0.0004, 0.0003, 0.0001, 0.0001, 0},
                        {-0.0004, -0.0005, 0, 0.0002, 0.0003, 0.0002, 0.0001, 0.0001, 0},
                        {-0.0002, -0.0003, -0.0001, 0.0001, 0.0001, 0.0001, 0.0001, 0.0001, 0.0001},
                        {-0.0001, -0.0002, -0.0001, 0, 0.0001, 0.0001, 0.0001, 0.0001, 0.0001},
                        {-0.0001, -0.0001, -0.0001, 0, 0, 0, 0.0001, 0.0001, 0}};
  const auto levels = energy_levels(spline_levels(
      [] {
        auto domain = hats(4);  // [0, 4]², of 16 x 16 cells on level 2
        domain.x = domain.y.emplace(Breakpoints::uniform(0, 4, 16));
        return domain;
      }(),
      2));
  EXPECT_LE(difference(first, VariationalScheme(levels, 0).row(0), 5), printed);
  EXPECT_LE(difference(second, VariationalScheme(levels, 1).row(0), 9), printed);
}

TEST(HarmonicScheme, interior_column_on_a_square_is_the_unbounded_mask_to_four_digits) {
  const VectorXd column = scheme_on(8).column(4 + 9 * 4);
  double largest = 0;
  for (int j = -4; j <= 4; ++j)
    for (int i = -4; i <= 4; ++i)
      largest = std::max(largest, std::abs(column[8 + i + 17 * (8 + j)] - polyharmonic_coefficient(1, i, j)));
  EXPECT_NEAR(largest, 1.1e-4, 0.05e-4);
}

// The formula that the source leaves to the reader: reflection at all four sides makes data of period 2 n, so that the
// entry is the sum of the mask over all images, s[i1 ± 2 i2 + 4 n a, j1 ± 2 j2 + 4 n b].
TEST(HarmonicScheme, on_a_square_is_the_sum_of_the_mask_over_all_images) {
  const int n = 3, images = 12;
  const MatrixXd S = scheme_on(n).matrix();
  const auto entry = [&](int i1, int j1, int i2, int j2) {
    double sum = 0;
    for (int a = -images; a <= images; ++a)
      for (int b = -images; b <= images; ++b)
        for (int s : {-1, 1})
          for (int t : {-1, 1})
            if ((s > 0 || i2 % n > 0) && (t > 0 || j2 % n > 0))
              sum += polyharmonic_coefficient(1, i1 + 2 * s * i2 + 4 * n * a, j1 + 2 * t * j2 + 4 * n * b);
    return sum;
  };
  for (const auto& [i1, j1, i2, j2] : std::vector<std::array<int, 4>>{
           {0, 0, 0, 0}, {3, 2, 1, 2}, {6, 0, 3, 0}, {4, 5, 2, 3}, {1, 6, 3, 1}, {3, 3, 1, 1}})
    EXPECT_NEAR(S(i1 + 7 * j1, i2 + 4 * j2), entry(i1, j1, i2, j2), 2e-6);  // the images left out: measured to fall
                                                                            // like the square of their distance
}

// Errors of the padded rules against the exact ones of the next level: of S_0 on [0, 4]², and of S_1.
TEST(PaddedScheme, errors_on_squares_are_those_stated) {
  struct Case {
    int cells;
    double entry, sum;
  };
  for (const Case& c : {Case{4, 2.0e-3, 3.8e-2}, Case{8, 2.1e-4, 1.3e-2}}) {
    const PaddedScheme padded(hats(c.cells));
    const int n = 2 * c.cells, side = 4 * c.cells + 1;
    const auto exact = scheme_on(n);
    const auto rule = padded.rule({side / 2, side / 2}, {n, n});
    VectorXd error = exact.row(side / 2 + side * (side / 2));
    for (int b = 0; b <= c.cells; ++b)
      for (int a = 0; a <= c.cells; ++a)
        error[rule.begin[0] + a + (n + 1) * (rule.begin[1] + b)] -= rule.weights[a + (c.cells + 1) * b];
    EXPECT_NEAR(error.cwiseAbs().maxCoeff(), c.entry, 0.05 * c.entry);
    EXPECT_NEAR(error.cwiseAbs().sum(), c.sum, 0.05 * c.sum);
  }
}

TEST(PaddedScheme, is_exact_on_the_small_domain_and_keeps_constants_everywhere) {
  for (int degree : {1, 2, 3}) {
    auto domain = test::variational_domain(Energy::membrane(), degree, 8, 12);
    const PaddedScheme padded(domain);
    const VariationalScheme exact(energy_levels(spline_levels(domain, 1)), 0);
    const VectorXd p = test::random_coefficients(exact.columns(), 1);
    EXPECT_LE((padded.apply(p, {4, 6}) - exact.apply(p)).norm(), 1e-12 * p.norm());
    const VectorXd constant = padded.apply(VectorXd::Ones((9 + degree) * (7 + degree)), {9, 7});
    EXPECT_LE((constant.array() - 1).abs().maxCoeff(), 1e-11);
    EXPECT_EQ(constant.size(), (18 + degree) * (14 + degree));
  }
}

TEST(PaddedScheme, application_agrees_with_its_rules) {
  const PaddedScheme padded(test::variational_domain(Energy::thin_plate(), 2, 12, 8));
  const std::array<int, 2> cells = {9, 11};
  const VectorXd p = test::random_coefficients(11 * 13, 3), q = padded.apply(p, cells);
  for (int j = 0; j < 24; ++j)
    for (int i = 0; i < 20; ++i) {
      const auto rule = padded.rule({i, j}, cells);
      double sum = 0;
      for (int b = 0; b < 6; ++b)
        for (int a = 0; a < 8; ++a) sum += rule.weights[a + 8 * b] * p[rule.begin[0] + a + 11 * (rule.begin[1] + b)];
      ASSERT_NEAR(q[i + 20 * j], sum, 1e-12);
    }
}

TEST(PaddedScheme, says_what_is_wrong_with_its_input) {
  EXPECT_THROW(PaddedScheme(test::variational_domain(Energy::membrane(), 1, 7, 8)), InvalidInput);
  EXPECT_THROW(PaddedScheme(test::variational_domain(Energy::membrane(), 1, 8, 8, false)), InvalidInput);
  const PaddedScheme padded(test::variational_domain(Energy::membrane(), 1, 8, 8));
  EXPECT_THROW(padded.apply(VectorXd::Zero(16), {3, 3}), InvalidInput);
  EXPECT_THROW(padded.apply(VectorXd::Zero(24), {4, 4}), InvalidInput);
  auto odd = hats(4);
  odd.x = Breakpoints::uniform(0, 4, 7);
  EXPECT_THROW(SplineLevel{odd}, InvalidInput);
}

}  // namespace
}  // namespace batten
