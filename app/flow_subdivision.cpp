// SPDX-License-Identifier: MIT
#include <batten/app/curve_subdivision.h>
#include <batten/app/flow_arrows.h>
#include <batten/app/flow_picture.h>
#include <batten/app/flow_samples.h>
#include <batten/app/flow_subdivision.h>
#include <batten/app/flow_table.h>
#include <batten/app/grid_output.h>
#include <batten/app/output_names.h>
#include <batten/app/progress.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/usage_error.h>
#include <batten/bases/flow_limit.h>
#include <batten/bases/optimal_flow_masks.h>
#include <batten/bases/subdivide_flow.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace batten {
namespace {

constexpr int default_size = 9;   // recommended by the source
constexpr int largest_size = 17;  // larger ones gain nothing that shows

void refuse_others(const SubdivideArguments& a) {
  if (asks_for_curve(a) || a.show != "result" || a.parameter != "uniform")
    throw UsageError("the input is a flow, for which there are no options of curves");
  if (a.tension || a.rules != "exact") throw UsageError("--tension and --rules are for bounded schemes");
  if (a.boundary == "reflect" || a.boundary == "periodic")
    throw UsageError("--boundary of a flow is extend, open or zero, found " + a.boundary);
  if (a.view == "surface") throw UsageError("--view of a flow is map, found surface");
  check_options(a.scheme, {}, {"--size"});
  const int size = a.scheme.size.value_or(default_size);
  if (size < 3 || size > largest_size || size % 2 == 0)
    throw UsageError("--size of a flow is odd and from 3 to " + std::to_string(largest_size) + ", found " +
                     std::to_string(size));
}

/// The limit is that of the exact scheme, which has no choices, and of a field that is at rest outside.
void check_limit(const SubdivideArguments& a) {
  if (!a.limit) {
    if (a.samples == "rotors") throw UsageError("--samples rotors is for --limit: on walls rotors are no flow yet");
    return;
  }
  if (!a.kind.empty() || a.scheme.size)
    throw UsageError("--limit is that of the exact scheme: no --kind and no --size");
  if (!a.boundary.empty() && a.boundary != "zero")
    throw UsageError("--limit is that of a flow at rest outside, --boundary zero; found " + a.boundary);
}

FieldSides sides_of(const std::string& boundary) {
  if (boundary == "open") return FieldSides::Open;
  return boundary == "zero" ? FieldSides::Zero : FieldSides::Nearest;
}

FlowSamples samples_in(const SubdivideArguments& a) {
  return a.samples == "walls" ? FlowSamples::Walls : FlowSamples::Vertices;
}

Flow flow_of(const SubdivideArguments& a) { return a.scheme.name == "slow-flow" ? Flow::Slow : Flow::Perfect; }

/// The subdivided field with one fine cell more on each side than is shown: vertices need the walls around them.
StaggeredField with_margin(const SubdivideArguments& a, const FlowMasks<double>& masks, const StaggeredField& coarse) {
  const FieldSides sides = sides_of(a.boundary);
  if (sides != FieldSides::Nearest) return subdivided(masks, coarse, {a.levels, sides});
  const StaggeredField fine = subdivided(masks, padded(coarse, 1, sides), {a.levels, sides});
  return cropped(fine, (1 << a.levels) - 1);
}

double largest(const ControlGrid& grid) { return grid.components[0].cwiseAbs().maxCoeff(); }

/// What is written, and how the line that is printed goes on behind the speed.
struct RefinedFlow {
  std::string what;
  std::array<Eigen::Index, 2> cells;  ///< of the input
  GridSamples samples;
  std::string account;
};

RefinedFlow refined(const SubdivideArguments& a, Progress& progress) {
  progress.show("make the masks");
  const FlowKind kind = a.kind == "book" ? FlowKind::Book : FlowKind::Commuting;
  const int size = a.scheme.size.value_or(default_size);
  const auto masks = to_double(optimal_flow_masks(flow_of(a), kind, size).masks);
  progress.show("read");
  const StaggeredField coarse = read_flow(a.input, samples_in(a));
  progress.show("subdivide");
  const StaggeredField fine = with_margin(a, masks, coarse);
  return {a.scheme.name + (kind == FlowKind::Book ? ", book" : ", commuting") + ", size " + std::to_string(size),
          {coarse.cells_x(), coarse.cells_y()},
          samples_of(fine),
          ", divergence up to " + number_text(largest(divergence(cropped(fine, 1))), 3) + " (given " +
              number_text(largest(divergence(coarse)), 3) + "), rotation up to " +
              number_text(largest(rotation(fine)), 3)};
}

RefinedFlow limit_of(const SubdivideArguments& a, Progress& progress) {
  const FlowBasis basis(flow_of(a));
  progress.show("read");
  const auto evaluated = [&](std::array<Eigen::Index, 2> cells, const ControlGrid& limit) {
    return RefinedFlow{a.scheme.name + ", limit", cells, samples_of_velocity(limit), ""};
  };
  if (a.samples == "rotors") {
    const ControlGrid rotors = read_rotors(a.input);
    progress.show("evaluate");
    return evaluated({rotors.components[0].rows() - 1, rotors.components[0].cols() - 1},
                     flow_of_rotors(basis, rotors, a.levels));
  }
  const StaggeredField coarse = read_flow(a.input, samples_in(a));
  progress.show("evaluate");
  return evaluated({coarse.cells_x(), coarse.cells_y()}, flow_limit(basis, coarse, a.levels));
}

/// Of those that are finite.
double largest_speed(const GridSamples& samples) {
  double found = 0;
  for (const PointArray& array : samples.arrays)
    if (array.name == "speed")
      for (double speed : array.values)
        if (std::isfinite(speed)) found = std::max(found, speed);
  return found;
}

}  // namespace

bool is_flow_scheme(const std::string& name) { return name == "perfect-flow" || name == "slow-flow"; }

void refuse_flow_options(const SubdivideArguments& a) {
  const auto refuse = [&](const std::string& option) {
    throw UsageError(option + " is for --scheme perfect-flow and slow-flow, found " + a.scheme.name);
  };
  if (!a.kind.empty()) refuse("--kind");
  if (!a.samples.empty()) refuse("--samples");
  if (a.pixels) refuse("--pixels");
  if (a.boundary == "extend") refuse("--boundary extend");
}

void subdivide_flow(const SubdivideArguments& a) {
  refuse_others(a);
  check_limit(a);
  check_output_name("-o", a.output, {".vti", ".vtu", ".csv"});
  check_output_name("--picture", a.picture, {".png"});
  Progress progress("batten subdivide", a.quiet);
  const auto [what, cells, samples, account] = a.limit ? limit_of(a, progress) : refined(a, progress);
  progress.show("write " + a.output);
  write_subdivided(a, "subdivided flow", what, samples);
  if (!a.picture.empty())
    draw_flow_picture(
        {.path = a.picture,
         .title = a.limit ? what : what + ", " + std::to_string(a.levels) + (a.levels == 1 ? " round" : " rounds"),
         .pixels = a.pixels,
         .curves = arrows_of(samples)},
        samples);
  progress.erase();
  if (a.quiet) return;
  std::cout << what << ": " << cells[0] << " x " << cells[1] << " cells -> " << samples.points[0] - 1 << " x "
            << samples.points[1] - 1 << ", speed up to " << number_text(largest_speed(samples), 6) << account
            << "; wrote " << a.output << '\n';
}

}  // namespace batten
