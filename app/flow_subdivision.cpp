// SPDX-License-Identifier: MIT
#include <batten/app/flow_subdivision.h>
#include <batten/app/flow_table.h>
#include <batten/app/output_names.h>
#include <batten/app/progress.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/usage_error.h>
#include <batten/bases/optimal_flow_masks.h>
#include <batten/bases/subdivide_flow.h>
#include <batten/domains/number_text.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>
#include <batten/io/table.h>

#include <algorithm>
#include <iostream>

namespace batten {
namespace {

constexpr int default_size = 9;   // recommended by the source
constexpr int largest_size = 17;  // larger ones gain nothing that shows

void refuse_others(const SubdivideArguments& a) {
  if (a.interpolate || a.limit || a.closed || a.smoothing || a.tolerance || !a.columns.empty() || a.show != "result" ||
      a.parameter != "uniform")
    throw UsageError("the input is a flow, for which there are no options of curves");
  if (a.tension || a.rules != "exact") throw UsageError("--tension and --rules are for bounded schemes");
  if (a.boundary == "reflect" || a.boundary == "periodic")
    throw UsageError("--boundary of a flow is extend, open or zero, found " + a.boundary);
  check_options(a.scheme, {}, {"--size"});
  const int size = a.scheme.size.value_or(default_size);
  if (size < 3 || size > largest_size || size % 2 == 0)
    throw UsageError("--size of a flow is odd and from 3 to " + std::to_string(largest_size) + ", found " +
                     std::to_string(size));
}

FieldSides sides_of(const std::string& boundary) {
  if (boundary == "open") return FieldSides::Open;
  return boundary == "zero" ? FieldSides::Zero : FieldSides::Nearest;
}

/// The subdivided field with one fine cell more on each side than is shown: vertices need the walls around them.
StaggeredField with_margin(const SubdivideArguments& a, const FlowMasks<double>& masks, const StaggeredField& coarse) {
  const FieldSides sides = sides_of(a.boundary);
  if (sides != FieldSides::Nearest) return subdivided(masks, coarse, {a.levels, sides});
  const StaggeredField fine = subdivided(masks, padded(coarse, 1, sides), {a.levels, sides});
  return cropped(fine, (1 << a.levels) - 1);
}

/// At the vertices of nx x ny cells the mean of the cells around.
Eigen::MatrixXd vertex_means(const Eigen::MatrixXd& cells) {
  const Eigen::Index nx = cells.rows(), ny = cells.cols();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(nx + 1, ny + 1), counts = sums;
  for (Eigen::Index b : {0, 1})
    for (Eigen::Index a : {0, 1}) {
      sums.block(a, b, nx, ny) += cells;
      counts.block(a, b, nx, ny).array() += 1;
    }
  return sums.cwiseQuotient(counts);
}

PointArray array_of(const std::string& name, const Eigen::MatrixXd& values) {
  return {name, 1, {values.data(), values.data() + values.size()}};
}

/// velocity, divergence, rotation and speed at the vertices of all but the outermost cells.
GridSamples samples_of(const StaggeredField& field) {
  const ControlGrid vertices = vertex_averages(field);
  const Eigen::MatrixXd &u = vertices.components[0], &v = vertices.components[1];
  GridSamples samples{.points = {static_cast<int>(u.rows()), static_cast<int>(u.cols())},
                      .origin = vertices.start,
                      .spacing = vertices.spacing};
  PointArray velocity{"velocity", 3, {}};
  for (Eigen::Index k = 0; k < u.size(); ++k)
    for (double component : {u.data()[k], v.data()[k], 0.}) velocity.values.push_back(component);
  const Eigen::MatrixXd speed = (u.array().square() + v.array().square()).sqrt();
  samples.arrays = {std::move(velocity),
                    array_of("divergence", vertex_means(divergence(cropped(field, 1)).components[0])),
                    array_of("rotation", rotation(field).components[0]), array_of("speed", speed)};
  return samples;
}

void write_outputs(const SubdivideArguments& a, const std::string& what, const GridSamples& samples) {
  if (is_table(a.output)) {
    write_table(a.output, samples);
  } else {
    const auto [x, y] = samples.origin;
    Record record{.kind = "subdivided flow",
                  .region = {x, x + samples.spacing[0] * (samples.points[0] - 1), y,
                             y + samples.spacing[1] * (samples.points[1] - 1)}};
    record.texts = {{"scheme", what}, {"program", "batten " BATTEN_VERSION}};
    record.numbers = {{"levels", static_cast<double>(a.levels)}};
    write_image(a.output, samples, record);
  }
  if (a.picture.empty()) return;
  PictureOptions options;
  options.view = a.view == "map" ? PictureOptions::View::Map : PictureOptions::View::Surface;
  options.array = options.value_name = "speed";
  options.title = what + ", " + std::to_string(a.levels) + " levels";
  write_picture(a.picture, samples, {}, options);
}

double largest(const ControlGrid& grid) { return grid.components[0].cwiseAbs().maxCoeff(); }

}  // namespace

bool is_flow_scheme(const std::string& name) { return name == "perfect-flow" || name == "slow-flow"; }

void refuse_flow_options(const SubdivideArguments& a) {
  const auto refuse = [&](const std::string& option) {
    throw UsageError(option + " is for --scheme perfect-flow and slow-flow, found " + a.scheme.name);
  };
  if (!a.kind.empty()) refuse("--kind");
  if (!a.samples.empty()) refuse("--samples");
  if (a.boundary == "extend") refuse("--boundary extend");
}

void subdivide_flow(const SubdivideArguments& a) {
  refuse_others(a);
  check_output_name("-o", a.output, {".vti", ".csv"});
  check_output_name("--picture", a.picture, {".png"});
  Progress progress("batten subdivide", a.quiet);
  progress.show("make the masks");
  const Flow flow = a.scheme.name == "slow-flow" ? Flow::Slow : Flow::Perfect;
  const FlowKind kind = a.kind == "book" ? FlowKind::Book : FlowKind::Commuting;
  const int size = a.scheme.size.value_or(default_size);
  const auto masks = to_double(optimal_flow_masks(flow, kind, size).masks);
  progress.show("read");
  const StaggeredField coarse = read_flow(a.input, a.samples == "walls" ? FlowSamples::Walls : FlowSamples::Vertices);
  progress.show("subdivide");
  const StaggeredField fine = with_margin(a, masks, coarse);
  progress.show("write " + a.output);
  const GridSamples samples = samples_of(fine);
  const std::string what =
      a.scheme.name + (kind == FlowKind::Book ? ", book" : ", commuting") + ", size " + std::to_string(size);
  write_outputs(a, what, samples);
  progress.erase();
  if (a.quiet) return;
  const auto& speed = samples.arrays.back().values;
  std::cout << what << ": " << coarse.cells_x() << " x " << coarse.cells_y() << " cells -> " << samples.points[0] - 1
            << " x " << samples.points[1] - 1 << ", speed up to "
            << number_text(*std::max_element(speed.begin(), speed.end()), 6) << ", divergence up to "
            << number_text(largest(divergence(cropped(fine, 1))), 3) << " (given "
            << number_text(largest(divergence(coarse)), 3) << "), rotation up to "
            << number_text(largest(rotation(fine)), 3) << "; wrote " << a.output << '\n';
}

}  // namespace batten
