// SPDX-License-Identifier: MIT
// A new energy: from its formula to its subdivision scheme, its predictor and the solution.
//
//   E(p) = ∫∫ p_xx² + 4 p_yy²,   a plate four times as stiff along y; without energy are 1, x, y and x y.
//
// 1. Quadratic splines on 8 x 8 cells and three refinements carry E exactly.
// 2. S_0, the exact scheme, from E_1 S_0 = U_0 E_0.
// 3. The predictor: values at the middles of coarse cells -> the least-energy finer function, rules of four layers.
// 4. The solution of the last step, exactly, to compare.
// 5. The basis function of a coarse coefficient, S_2 S_1 S_0 of a unit vector, into the PNG file that is named.
//
// Output: the rule of a middle coefficient, the energies of the levels, the error of the prediction; it is below 1e-3.
#include <batten/fem/corner_samples.h>
#include <batten/fem/energy_levels.h>
#include <batten/fem/predictor.h>
#include <batten/fem/variational_scheme.h>
#include <batten/io/picture.h>

#include <cmath>
#include <iostream>

int main(int argc, char** argv) {
  using namespace batten;
  VariationalDomain domain{Breakpoints::uniform(0, 1, 64)};
  domain.y = domain.x;
  domain.energy = Energy::sum_of({{1, 2, 0}, {4, 0, 2}});
  domain.degree = 2;
  const auto levels = spline_levels(domain, 3);

  const EnergyLevels energies = energy_levels(levels);
  const VariationalScheme S(energies, 0);
  const int i = 8, nx = levels[1].x().size(), coarse_nx = levels[0].x().size();
  std::cout << "rule of coefficient (8, 8), x to the right:\n";
  const Eigen::VectorXd rule = S.row(i + nx * i);
  for (int b = 2; b <= 7; ++b) {
    for (int a = 2; a <= 7; ++a) std::cout << std::round(1e4 * rule[a + coarse_nx * b]) / 1e4 << '\t';
    std::cout << '\n';
  }

  Eigen::VectorXd q(levels[0].size());  // a bump
  for (int g = 0; g < q.size(); ++g) q[g] = std::exp(-std::hypot(g % coarse_nx - 4.5, g / coarse_nx - 4.5));
  const Predictor predictor(levels, {.kind = Measurement::CentreValues, .layers = 4});
  const auto prediction = predictor.run(q);
  for (std::size_t k = 0; k < levels.size(); ++k)
    std::cout << "energy on level " << k << ": " << prediction.energies[k] << '\n';

  const Predictor exact({levels[2], levels[3]}, {.kind = Measurement::CentreValues, .layers = 0});
  const double least = levels[3].energy_of(exact.predict(0, prediction.coefficients[2]));
  const double error = prediction.energies[3] / least - 1;
  std::cout << "energy of the prediction over the least, minus 1: " << error << '\n';

  Eigen::VectorXd n = S.column(5 + coarse_nx * 5);
  for (int k : {1, 2}) n = VariationalScheme(energies, k).apply(n);
  if (argc > 1) write_picture(argv[1], corner_samples(levels[3], n), {}, {.title = "basis of p_xx^2 + 4 p_yy^2"});
  return error >= -1e-12 && error < 1e-3 ? 0 : 1;
}
