// SPDX-License-Identifier: MIT
#include <batten/app/flow_arrows.h>
#include <batten/app/flow_outputs.h>
#include <batten/app/flow_picture.h>
#include <batten/app/output_names.h>
#include <batten/app/sample_file.h>
#include <batten/io/curve_file.h>
#include <batten/io/point_file.h>

#include <cmath>
#include <utility>

namespace batten {
namespace {

Record record_of(const FlowOutputs& outputs) {
  const FlowArguments& arguments = *outputs.arguments;
  const FlowResult& result = *outputs.result;
  const auto& [x, y, u, v] = outputs.input->names;
  const auto& tolerance = arguments.smoothing.tolerance;
  Record record = result.field.to_record();
  record.numbers.insert({{"lambda", result.lambda},
                         {"energy", result.energy},
                         {"rms_residual", result.rms_residual},
                         {"max_residual", result.largest_residual},
                         {"largest_divergence", result.largest_divergence},
                         {"points", static_cast<double>(result.points_used)}});
  if (result.effective_degrees) record.numbers["effective_degrees"] = *result.effective_degrees;
  if (tolerance) record.numbers["tolerance"] = *tolerance;
  if (model_of(arguments) == FlowModel::General) record.numbers["ratio"] = arguments.ratio.value_or(1);
  record.texts = {{"model", arguments.model},
                  {"smoothing", tolerance ? "tolerance" : arguments.smoothing.text},
                  {"x", x},
                  {"y", y},
                  {"u", u},
                  {"v", v},
                  {"program", "batten " BATTEN_VERSION}};
  return record;
}

void add_vector(double x, double y, PointArray& array) {
  for (const double component : {x, y, 0.}) array.values.push_back(component);
}

/// The vectors inside the region at (x, y, 0), with velocity, fit, residual and weight.
ScatteredSamples fitted_vectors(const VectorObservations& data, const FlowResult& result) {
  ScatteredSamples points;
  PointArray velocity{"velocity", 3, {}}, fit{"fit", 3, {}}, residual{"residual", 3, {}}, weight{"weight", 1, {}};
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double u = result.fitted_u[i], v = result.fitted_v[i];
    if (std::isnan(u)) continue;
    points.x.push_back(data.x[i]);
    points.y.push_back(data.y[i]);
    points.z.push_back(0);
    add_vector(data.u[i], data.v[i], velocity);
    add_vector(u, v, fit);
    add_vector(u - data.u[i], v - data.v[i], residual);
    weight.values.push_back(data.weight.empty() ? 1 : data.weight[i]);
  }
  points.arrays = {std::move(velocity), std::move(fit), std::move(residual), std::move(weight)};
  return points;
}

void draw(const FlowOutputs& outputs, const GridSamples& samples) {
  const FlowField& field = outputs.result->field;
  const auto& names = outputs.input->names;
  FlowPicture picture{.path = outputs.arguments->picture,
                      .names = {names[0], names[1]},
                      .y_scale = field.geometry().aspect(field.region()),
                      .pixels = outputs.arguments->pixels};
  if (outputs.streamlines.empty()) {
    picture.curves = arrows_of(field);
  } else {
    picture.curves = outputs.streamlines;
    picture.heads = PictureOptions::Heads::Along;
  }
  draw_flow_picture(picture, samples);
}

}  // namespace

std::vector<std::string> output_files(const FlowArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& file :
       {arguments.output, arguments.points_out, arguments.streamlines_out, arguments.picture, arguments.report}) {
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

void check_outputs(const FlowArguments& arguments) {
  for (const std::string& file : output_files(arguments)) {
    check_not_input(file, arguments.vectors);
    if (!arguments.seeds.empty()) check_not_input(file, arguments.seeds);
  }
  check_output_name("-o", arguments.output, {".vti", ".vtu"});
  check_output_name("--points-out", arguments.points_out, {".vtp"});
  check_output_name("--streamlines-out", arguments.streamlines_out, {".vtp"});
  check_output_name("--picture", arguments.picture, {".png"});
  check_output_name("--report", arguments.report, {".json"});
}

void write_outputs(const FlowOutputs& outputs, Progress& progress) {
  const FlowArguments& arguments = *outputs.arguments;
  const GridSamples grid = outputs.result->field.samples();
  progress.show("write " + arguments.output);
  write_samples(arguments.output, grid, record_of(outputs));
  if (!arguments.points_out.empty())
    write_points(arguments.points_out, fitted_vectors(outputs.input->observations, *outputs.result));
  if (!arguments.streamlines_out.empty()) write_curves(arguments.streamlines_out, outputs.streamlines);
  if (arguments.picture.empty()) return;
  progress.show("draw " + arguments.picture);
  draw(outputs, grid);
}

}  // namespace batten
