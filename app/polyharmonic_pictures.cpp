// SPDX-License-Identifier: MIT
#include <batten/app/polyharmonic_pictures.h>
#include <batten/bases/bell_basis.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>

#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr int rounds = 5;         // of subdivision in a picture
constexpr int bell_points = 161;  // along a side
constexpr double bell_reach = 4;  // the bell is drawn for |x|, |y| up to this

GridSamples samples_of(const Mask2<double>& values, double spacing) {
  GridSamples grid;
  for (std::size_t d : {0, 1}) {
    grid.points[d] = values.size()[d];
    grid.origin[d] = values.first()[d] * spacing;
    grid.spacing[d] = spacing;
  }
  grid.arrays = {{"value", 1, {values.coefficients().begin(), values.coefficients().end()}}};
  return grid;
}

/// The spikes of order 1 are blank.
GridSamples bell_samples(int order) {
  const BellBasis bell(order);
  GridSamples grid{.points = {bell_points, bell_points}, .origin = {-bell_reach, -bell_reach}};
  grid.spacing.fill(2 * bell_reach / (bell_points - 1));
  grid.arrays = {{"value", 1, {}}};
  for (int j = 0; j < bell_points; ++j)
    for (int i = 0; i < bell_points; ++i) {
      const double n = bell.value(grid.origin[0] + i * grid.spacing[0], grid.origin[1] + j * grid.spacing[1]);
      grid.arrays[0].values.push_back(std::isfinite(n) ? n : std::numeric_limits<double>::quiet_NaN());
    }
  return grid;
}

}  // namespace

void write_polyharmonic_outputs(const PolyharmonicMask& m, const SchemeArguments& arguments) {
  if (arguments.output.empty() && arguments.picture.empty()) return;
  const bool exact = m.method == "exact";
  const GridSamples grid =
      exact ? bell_samples(m.order) : samples_of(iterated(to_double(m.mask), rounds), std::ldexp(1, -rounds));
  if (!arguments.output.empty()) {
    const double x = grid.origin[0], y = grid.origin[1];
    Record record{
        .kind = "scaling function",
        .region = {x, x + grid.spacing[0] * (grid.points[0] - 1), y, y + grid.spacing[1] * (grid.points[1] - 1)}};
    record.texts["scheme"] = "polyharmonic of order " + std::to_string(m.order) + ", " + m.method;
    write_image(arguments.output, grid, record);
  }
  if (arguments.picture.empty()) return;
  PictureOptions options;
  options.title = "polyharmonic of order " + std::to_string(m.order);
  options.title +=
      exact ? ": bell basis"
            : ", " + m.method + " " + std::to_string(m.size) + " x " + std::to_string(m.size) + ": five rounds";
  options.value_name = "n";
  write_picture(arguments.picture, grid, {}, options);
}

}  // namespace batten
