// SPDX-License-Identifier: MIT
#include <batten/app/output_names.h>
#include <batten/app/sample_file.h>
#include <batten/app/solve_outputs.h>
#include <batten/fem/plate_forces.h>
#include <batten/io/output_file.h>
#include <batten/io/picture.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace batten {
namespace {

std::string padded(int k, std::size_t digits) {
  const std::string text = std::to_string(k);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

}  // namespace

std::string with_suffix(const std::string& file, const std::string& suffix) {
  const std::filesystem::path path(file);
  return (path.parent_path() / (path.stem().string() + suffix + path.extension().string())).string();
}

std::string mode_suffix(int k, int count) { return "_mode" + padded(k, std::to_string(count).size()); }

std::string frame_suffix(int k, int count) {
  constexpr std::size_t usual_digits = 4;
  return '_' + padded(k, std::max(usual_digits, std::to_string(count - 1).size()));
}

int frame_count(const Motion& motion) { return 1 + static_cast<int>(std::ceil(motion.end / motion.step)); }

std::string collection_name(const std::string& file) {
  return std::filesystem::path(file).replace_extension(".pvd").string();
}

void check_solve_outputs(const SolveArguments& arguments) {
  for (const std::string& file : {arguments.output, arguments.picture, arguments.report})
    check_not_input(file, arguments.problem);
  check_output_name("-o", arguments.output, {".vti", ".vtu"});
  check_output_name("--picture", arguments.picture, {".png"});
  check_output_name("--report", arguments.report, {".json"});
}

void check_series_outputs(const SolveArguments& arguments, const ProblemFile& file) {
  if (!file.modes && !file.motion) return;
  check_output(collection_name(arguments.output));
  if (file.motion) check_output(with_suffix(arguments.output, frame_suffix(0, frame_count(*file.motion))));
  if (!file.modes) return;
  const int count = file.modes->count;
  for (int k = 1; k <= count; ++k) {
    check_output(with_suffix(arguments.output, mode_suffix(k, count)));
    if (!arguments.picture.empty()) check_output(with_suffix(arguments.picture, mode_suffix(k, count)));
  }
}

GridSamples samples_of(const Solution& solution, const BoundaryProblem& problem) {
  GridSamples grid = solution.samples();
  if (problem.is_plate())
    for (PointArray& array : force_samples(solution, std::get<KirchhoffPlate>(problem.material)))
      grid.arrays.push_back(std::move(array));
  return grid;
}

Extremes extremes_of(const GridSamples& grid, const PointArray& array) {
  const auto place = [&](std::size_t k) {
    const auto columns = static_cast<std::size_t>(grid.points[0]);
    return Extremes::Place{array.values[k], grid.origin[0] + static_cast<double>(k % columns) * grid.spacing[0],
                           grid.origin[1] + static_cast<double>(k / columns) * grid.spacing[1]};
  };
  std::size_t least = array.values.size(), largest = array.values.size();
  for (std::size_t k = 0; k < array.values.size(); ++k) {
    if (std::isnan(array.values[k])) continue;
    if (least == array.values.size()) least = largest = k;
    if (array.values[k] < array.values[least]) least = k;
    if (array.values[k] > array.values[largest]) largest = k;
  }
  if (least == array.values.size()) return {array.name, {}, {}};
  return {array.name, place(least), place(largest)};
}

void write_solution(const SolutionFile& file, const GridSamples& grid) {
  Record record = file.solution->to_record();
  record.numbers = file.numbers;
  record.texts = {{"problem", file.problem->kind()},
                  {"x", "x"},
                  {"y", "y"},
                  {"value", file.problem->unknown()},
                  {"program", "batten " BATTEN_VERSION}};
  write_samples(file.path, grid, record);
}

void draw_surface_picture(const std::string& path, const GridSamples& grid, const std::string& name,
                          const std::string& title) {
  PictureOptions options;
  options.value_name = name;
  options.title = title;
  write_picture(path, grid, {}, options);
}

void draw_mode_picture(const std::string& path, const GridSamples& grid, const std::string& name,
                       const std::string& title) {
  PictureOptions options;
  options.view = PictureOptions::View::Map;
  options.value_name = name;
  options.title = title;
  options.bold_value = 0;
  write_picture(path, grid, {}, options);
}

}  // namespace batten
