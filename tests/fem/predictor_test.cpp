// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/energy_levels.h>
#include <batten/fem/predictor.h>
#include <batten/fem/variational_scheme.h>

#include "../support/variational_domains.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using Eigen::VectorXd;
using test::variational_domain;

struct Case {
  std::string name;
  VariationalDomain domain;
  Measurement kind;
};

std::vector<Case> cases() {
  auto rough = variational_domain(Energy::membrane(), 1, 32, 32);
  rough.coefficient = test::rough(1024, 1000, 9);
  auto masked = variational_domain(Energy::membrane(), 1, 32, 32);
  masked.inside = test::l_shape(32, 32);
  return {{"membrane", variational_domain(Energy::membrane(), 1, 32, 32), Measurement::CellAverages},
          {"contrast", rough, Measurement::CellAverages},
          {"mask", masked, Measurement::CellAverages},
          {"plate 2", variational_domain(Energy::thin_plate(), 2, 29, 32, false), Measurement::CentreValues},
          {"plate 3", variational_domain(Energy::thin_plate(), 3, 32, 32), Measurement::CentreValues},
          {"interval", variational_domain(Energy::thin_plate(), 3, 67, 0, false), Measurement::CentreValues}};
}

TEST(Predictor, never_raises_the_energy_and_four_layers_are_within_a_thousandth) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto levels = spline_levels(c.domain, 3);
    const VectorXd q0 = test::random_coefficients(levels[0].size(), 3);
    const auto exact = Predictor(levels, {.kind = c.kind, .layers = 0}).run(q0);
    const auto local = Predictor(levels, {.kind = c.kind, .layers = 4}).run(q0);
    for (std::size_t k = 1; k < levels.size(); ++k) {
      EXPECT_LT(exact.energies[k], exact.energies[k - 1]);
      EXPECT_NEAR(local.energies[k], exact.energies[k], 1e-3 * exact.energies[k]) << "level " << k;
    }
  }
}

TEST(Predictor, keeps_cell_averages_on_all_levels) {
  const auto levels = spline_levels(cases()[1].domain, 3);
  const VectorXd q0 = test::random_coefficients(levels[0].size(), 5);
  const auto prediction = Predictor(levels, {.kind = Measurement::CellAverages, .layers = 1}).run(q0);
  const auto average = [&](std::size_t k) {  // over the lower left quarter
    const SplineLevel& level = levels[k];
    const int half = level.x().cells() / 2;
    double integral = 0;
    for (int j = 0; j < half; ++j)
      for (int i = 0; i < half; ++i) {
        const auto w = level.cell_moments(i, j, {0, 0});
        for (int a = 0; a < 4; ++a) integral += w[a] * prediction.coefficients[k][level.function(i + a % 2, j + a / 2)];
      }
    return integral / 256;
  };
  for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(average(k), average(0), 1e-11);
}

TEST(Predictor, smoothing_lowers_the_energy_of_local_rules_and_keeps_measurements) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto levels = spline_levels(c.domain, 1);
    const VectorXd q0 = test::random_coefficients(levels[0].size(), 3);
    const auto with = Predictor(levels, {.kind = c.kind, .layers = 1, .smoothing = true}).predict(0, q0);
    const auto without = Predictor(levels, {.kind = c.kind, .layers = 1}).predict(0, q0);
    const double least = levels[1].energy_of(Predictor(levels, {.kind = c.kind, .layers = 0}).predict(0, q0));
    const double before = levels[1].energy_of(without) - least, after = levels[1].energy_of(with) - least;
    EXPECT_LT(after, 0.5 * before);
    EXPECT_GE(after, -1e-10 * least);
    const auto M = measurement_matrix(levels[0], levels[1], c.kind).M;
    EXPECT_LE((M * (with - without)).norm(), 1e-11 * without.norm());
  }
}

// Energies of p_k fall to p_0^T E_0 N_0 p_0, here for bending and tension with Greville values, where the source has
// sampled coefficients of quadratics in one dimension.
TEST(VariationalScheme, energies_of_bending_fall_to_that_of_the_limit) {
  for (const auto& energy : {Energy::thin_plate(), Energy::tension(0.2)})
    for (int degree : {2, 3})
      for (bool even : {true, false})
        for (int rows : {0, 16}) {
          const auto levels = energy_levels(spline_levels(variational_domain(energy, degree, 16, rows, even), 3));
          VectorXd p = test::random_coefficients(levels.levels[0].E.rows(), 6);
          const VectorXd p0 = p;
          std::vector<double> energies = {p.dot(levels.levels[0].E * p)};
          for (int k = 0; k < 3; ++k) {
            p = VariationalScheme(levels, k).apply(p);
            energies.push_back(p.dot(levels.levels[static_cast<std::size_t>(k + 1)].E * p));
            const double exact = p0.dot(levels.levels[0].E * measured_on_coarsest(levels, k + 1, p));
            EXPECT_NEAR(energies.back(), exact, 1e-8 * exact);
          }
          SCOPED_TRACE(testing::Message() << "degree " << degree << (even ? " even " : " uneven ") << rows);
          for (std::size_t k = 1; k < 4; ++k) EXPECT_LT(energies[k], energies[k - 1]);
          EXPECT_LT(energies[2] - energies[3], 0.6 * (energies[1] - energies[2]));
          EXPECT_LT(energies[1] - energies[2], 0.6 * (energies[0] - energies[1]));
        }
}

TEST(Predictor, says_what_is_wrong_with_its_input) {
  const auto levels = spline_levels(variational_domain(Energy::membrane(), 1, 8, 8), 1);
  EXPECT_THROW(Predictor({}, {}), InvalidInput);
  EXPECT_THROW(Predictor(levels, {}).run(VectorXd::Zero(3)), InvalidInput);
}

}  // namespace
}  // namespace batten
