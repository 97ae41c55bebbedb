// SPDX-License-Identifier: MIT
#include <batten/app/fit_outputs.h>
#include <batten/app/output_names.h>
#include <batten/domains/errors.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>
#include <batten/io/point_file.h>
#include <batten/io/table.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

Record record_of(const FitOutputs& outputs) {
  const FitArguments& arguments = *outputs.arguments;
  const FitResult& result = *outputs.result;
  Record record = result.solution.to_record();
  record.numbers = {{"lambda", result.lambda},
                    {"energy", result.energy},
                    {"tension", tension_of(arguments)},
                    {"aspect", outputs.aspect},
                    {"rms_residual", result.rms_residual},
                    {"max_residual", result.largest_residual},
                    {"points", static_cast<double>(result.points_used)}};
  if (result.effective_degrees) record.numbers["effective_degrees"] = *result.effective_degrees;
  if (arguments.smoothing.tolerance) record.numbers["tolerance"] = *arguments.smoothing.tolerance;
  record.texts = {{"energy", arguments.energy},
                  {"smoothing", arguments.smoothing.tolerance ? "tolerance" : arguments.smoothing.text},
                  {"x", outputs.input->names[0]},
                  {"y", outputs.input->names[1]},
                  {"value", outputs.input->names[2]},
                  {"program", "batten " BATTEN_VERSION}};
  return record;
}

// x, y and the arrays with one component, at the corners of the cells; the coordinates exactly those of the region.
void write_surface_table(const FitOutputs& outputs) {
  const Rectangle& region = outputs.result->solution.region();
  const int columns = region.x.cells() + 1, rows = region.y.cells() + 1;
  std::vector<std::string> names = {"x", "y"};
  std::vector<std::vector<double>> table(2);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      table[0].push_back(region.x.coordinate(i));
      table[1].push_back(region.y.coordinate(j));
    }
  }
  for (const PointArray& array : outputs.grid.arrays) {
    if (array.components != 1) continue;
    names.push_back(array.name);
    table.push_back(array.values);
  }
  write_table(outputs.arguments->output, names, table);
}

// The observations inside the region, with value, fit, residual and weight.
ScatteredSamples fitted_points(const FitInput& input, const FitResult& result) {
  const Observations& data = input.observations;
  ScatteredSamples points;
  points.arrays = {{"value", 1, {}}, {"fit", 1, {}}, {"residual", 1, {}}, {"weight", 1, {}}};
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (std::isnan(result.fitted[i])) continue;
    points.x.push_back(data.x[i]);
    points.y.push_back(data.y[i]);
    points.z.push_back(data.value[i]);
    const std::array row = {data.value[i], result.fitted[i], result.fitted[i] - data.value[i],
                            data.weight.empty() ? 1 : data.weight[i]};
    for (std::size_t k = 0; k < row.size(); ++k) points.arrays[k].values.push_back(row[k]);
  }
  return points;
}

void write_fit_picture(const FitOutputs& outputs, const ScatteredSamples& points) {
  const FitArguments& arguments = *outputs.arguments;
  PictureOptions options;
  options.view = arguments.view == "map" ? PictureOptions::View::Map : PictureOptions::View::Surface;
  options.x_name = outputs.input->names[0];
  options.y_name = outputs.input->names[1];
  options.value_name = outputs.input->names[2];
  options.y_scale = outputs.aspect;
  write_picture(arguments.picture, outputs.grid, points, options);
}

}  // namespace

std::vector<std::string> output_files(const FitArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& file : {arguments.output, arguments.points_out, arguments.picture, arguments.report}) {
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

void check_outputs(const FitArguments& arguments) {
  for (const std::string& file : output_files(arguments)) check_not_input(file, arguments.points);
  check_output_name("-o", arguments.output, {".vti", ".csv"});
  check_output_name("--points-out", arguments.points_out, {".vtp"});
  check_output_name("--picture", arguments.picture, {".png"});
  check_output_name("--report", arguments.report, {".json"});
}

void write_outputs(const FitOutputs& outputs, Progress& progress) {
  const FitArguments& arguments = *outputs.arguments;
  progress.show("write " + arguments.output);
  if (is_table(arguments.output)) {
    write_surface_table(outputs);
  } else {
    write_image(arguments.output, outputs.grid, record_of(outputs));
  }
  if (arguments.points_out.empty() && arguments.picture.empty()) return;
  const ScatteredSamples points = fitted_points(*outputs.input, *outputs.result);
  if (!arguments.points_out.empty()) write_points(arguments.points_out, points);
  if (arguments.picture.empty()) return;
  progress.show("draw " + arguments.picture);
  write_fit_picture(outputs, points);
}

}  // namespace batten
