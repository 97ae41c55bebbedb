// SPDX-License-Identifier: MIT
#include <batten/app/curve_subdivision.h>
#include <batten/app/grid_output.h>
#include <batten/app/grid_subdivision.h>
#include <batten/app/output_names.h>
#include <batten/app/progress.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/usage_error.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/number_text.h>
#include <batten/io/matrix_file.h>

#include <iostream>

namespace batten {
namespace {

/// Whether the mask is even in x and in y, so that reflection is defined.
bool is_even(const Scheme2& scheme) {
  const auto mask = scheme.mask();
  return is_even(mask, 0) && is_even(mask, 1);
}

/// On a grid a scheme of the line acts in x and in y, centred so that the grid does not drift.
Scheme2 grid_scheme(const SchemeArguments& arguments) {
  const AnyScheme found = scheme_of(arguments);
  if (const auto* plane = std::get_if<Scheme2>(&found)) return is_even(*plane) ? *plane : centred(*plane);
  const auto line = centred(std::get<Scheme>(found));
  if (!line.is_stationary())
    throw UsageError("--scheme " + arguments.name + " changes from level to level; on grids the mask must be one");
  return tensor_product(line, line);
}

Ends ends_of(const SubdivideArguments& arguments, const Scheme2& scheme) {
  const std::string& name = arguments.boundary;
  if (name == "open") return Ends::Open;
  if (name == "zero") return Ends::Zero;
  if (name == "periodic") return Ends::Periodic;
  if (name == "reflect") return Ends::Reflect;
  return is_even(scheme) ? Ends::Reflect : Ends::Open;
}

ControlGrid grid_of(const NumberMatrix& matrix) {
  return {.components = {Eigen::Map<const Eigen::MatrixXd>(matrix.values.data(), matrix.columns, matrix.rows)}};
}

GridSamples samples_of(const ControlGrid& grid) {
  const Eigen::MatrixXd& values = grid.components[0];
  GridSamples samples{.points = {static_cast<int>(values.rows()), static_cast<int>(values.cols())},
                      .origin = grid.start,
                      .spacing = grid.spacing};
  samples.arrays = {{"value", 1, {values.data(), values.data() + values.size()}}};
  return samples;
}

}  // namespace

void subdivide_grid(const SubdivideArguments& arguments) {
  if (asks_for_curve(arguments) || arguments.limit)
    throw UsageError(
        "the input is a control grid, for which there are no options of curves; a curve's table has a header");
  check_output_name("-o", arguments.output, {".vti", ".csv"});
  check_output_name("--picture", arguments.picture, {".png"});
  Progress progress("batten subdivide", arguments.quiet);
  progress.show("make the scheme");
  const Scheme2 scheme = grid_scheme(arguments.scheme);
  require_affine_invariance(scheme);
  progress.show("read");
  const ControlGrid control = grid_of(read_matrix(arguments.input));
  progress.show("subdivide");
  const Ends ends = ends_of(arguments, scheme);
  const ControlGrid fine = subdivided(scheme, control, {.levels = arguments.levels, .x = ends, .y = ends});
  progress.show("write " + arguments.output);
  const GridSamples samples = samples_of(fine);
  write_grid_outputs(arguments, scheme.name(), samples);
  progress.erase();
  if (arguments.quiet) return;
  const Eigen::MatrixXd &before = control.components[0], &after = fine.components[0];
  std::cout << scheme.name() << ": " << before.rows() << " x " << before.cols() << " values -> " << after.rows()
            << " x " << after.cols() << ", from " << number_text(after.minCoeff(), 6) << " to "
            << number_text(after.maxCoeff(), 6) << "; wrote " << arguments.output << '\n';
}

}  // namespace batten
