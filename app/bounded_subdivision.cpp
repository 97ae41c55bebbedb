// SPDX-License-Identifier: MIT
#include <batten/app/bounded_subdivision.h>
#include <batten/app/curve_subdivision.h>
#include <batten/app/fit_arguments.h>
#include <batten/app/grid_output.h>
#include <batten/app/output_names.h>
#include <batten/app/progress.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/usage_error.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/corner_samples.h>
#include <batten/fem/padded_scheme.h>
#include <batten/fem/variational_scheme.h>
#include <batten/io/matrix_file.h>

#include <algorithm>
#include <array>
#include <iostream>

namespace batten {
namespace {

constexpr std::array names = {"bounded-harmonic", "bounded-thin-plate", "bounded-tension"};
constexpr int padded_cells = 8;  // of the small domain whose rules are padded

Energy energy_of(const SubdivideArguments& a) {
  if (a.scheme.name == "bounded-harmonic") return Energy::membrane();
  return a.scheme.name == "bounded-tension" ? Energy::tension(a.tension.value_or(default_tension))
                                            : Energy::thin_plate();
}

/// The domain on which `cells` coarse cells are halved `levels` times. Values are the coefficients of splines: hats for
/// the membrane, as in the source, else quadratics.
VariationalDomain domain_of(const SubdivideArguments& a, std::array<int, 2> cells, int levels) {
  const int factor = 1 << levels;
  VariationalDomain domain{.x = Breakpoints::uniform(0, cells[0], factor * cells[0]),
                           .y = Breakpoints::uniform(0, cells[1], factor * cells[1]),
                           .energy = energy_of(a)};
  domain.degree = domain.energy.order() == 1 ? 1 : 2;
  domain.triangles = domain.degree == 1;
  return domain;
}

std::array<int, 2> cells_of(const SubdivideArguments& a, const NumberMatrix& grid) {
  const int degree = energy_of(a).order() == 1 ? 1 : 2, least = a.rules == "padded" ? 2 : 1;
  const std::array cells = {grid.columns - degree, grid.rows - degree};
  if (std::min(cells[0], cells[1]) < least)
    throw InvalidInput(a.input + ": " + a.scheme.name + " needs at least " + std::to_string(least + degree) + " x " +
                       std::to_string(least + degree) + " values, found " + std::to_string(grid.columns) + " x " +
                       std::to_string(grid.rows));
  return cells;
}

/// p_K of the exact schemes S_0 .. S_{K-1}.
Eigen::VectorXd exactly_subdivided(const std::vector<SplineLevel>& levels, Eigen::VectorXd p) {
  const EnergyLevels energies = energy_levels(levels);
  for (int k = 0; k < energies.finest(); ++k) p = VariationalScheme(energies, k).apply(p);
  return p;
}

/// The same with the rules of a small domain's S_0 everywhere.
Eigen::VectorXd padded_subdivided(const SubdivideArguments& a, std::array<int, 2> cells, Eigen::VectorXd p) {
  const int small = std::min({cells[0], cells[1], padded_cells});
  const PaddedScheme scheme(domain_of(a, {small, small}, 1));
  for (int k = 0; k < a.levels; ++k) {
    p = scheme.apply(p, cells);
    for (int& n : cells) n *= 2;
  }
  return p;
}

void refuse_others(const SubdivideArguments& a) {
  check_options(a.scheme, {}, {});
  const auto refuse = [&](bool is_given, const std::string& option) {
    if (is_given) throw UsageError(a.scheme.name + " has no option " + option);
  };
  refuse(!a.boundary.empty(), "--boundary: its sides are free");
  refuse(a.tension && a.scheme.name != "bounded-tension", "--tension");
  refuse(asks_for_curve(a) || a.limit, "of curves");
}

}  // namespace

bool is_bounded_scheme(const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

void subdivide_bounded(const SubdivideArguments& a) {
  refuse_others(a);
  check_output_name("-o", a.output, {".vti", ".csv"});
  check_output_name("--picture", a.picture, {".png"});
  Progress progress("batten subdivide", a.quiet);
  progress.show("read");
  const NumberMatrix grid = read_matrix(a.input);
  const auto cells = cells_of(a, grid);
  const Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(grid.values.data(), grid.columns * grid.rows);
  progress.show("subdivide");
  const auto levels = spline_levels(domain_of(a, cells, a.levels), a.levels);
  const Eigen::VectorXd fine = a.rules == "padded" ? padded_subdivided(a, cells, p) : exactly_subdivided(levels, p);
  progress.show("write " + a.output);
  const GridSamples samples = corner_samples(levels.back(), fine);
  write_grid_outputs(a, a.scheme.name + ", " + a.rules + " rules", samples);
  progress.erase();
  if (a.quiet) return;
  std::cout << a.scheme.name << ": " << grid.columns << " x " << grid.rows << " values -> " << samples.points[0]
            << " x " << samples.points[1] << ", energy " << number_text(levels.front().energy_of(p), 6) << " -> "
            << number_text(levels.back().energy_of(fine), 6) << "; wrote " << a.output << '\n';
}

}  // namespace batten
