// SPDX-License-Identifier: MIT
#include <batten/app/constraint_report.h>
#include <batten/app/fit_report.h>
#include <batten/io/output_file.h>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

Json region_json(const Rectangle& region) {
  return {region.x.lower(), region.x.upper(), region.y.lower(), region.y.upper()};
}

Json points_json(const FitAccount& account) {
  const FitResult& result = *account.result;
  return {{"used", result.points_used},
          {"skipped", account.input->skipped},
          {"outside", result.points_outside},
          {"merged", result.points_merged}};
}

Json worst_point_json(const FitAccount& account) {
  const FitResult& result = *account.result;
  const Observations& data = account.input->observations;
  return {{"value", result.largest_residual},
          {"x", data.x[result.worst_point]},
          {"y", data.y[result.worst_point]},
          {"line", account.input->lines[result.worst_point]}};
}

Json seconds_json(const FitAccount& account) {
  Json json = Json::object();
  for (const PhaseTime& time : account.seconds) json[time.phase] = json.value(time.phase, 0.) + time.seconds;
  return json;
}

Json smoothing_json(const SmoothingArguments& arguments) {
  if (arguments.tolerance) return "tolerance";
  const Smoothing smoothing = smoothing_of(arguments);
  if (smoothing.kind == Smoothing::Kind::Automatic) return "auto";
  return smoothing.kind == Smoothing::Kind::None ? Json("none") : Json(smoothing.value);
}

Json report_json(const FitAccount& account) {
  const FitArguments& arguments = *account.arguments;
  const FitResult& result = *account.result;
  const Rectangle& region = result.solution.region();
  Json json;
  json["points"] = points_json(account);
  json["unknowns"] = result.solution.coefficients().size();
  json["cells"] = {region.x.cells(), region.y.cells()};
  json["degree"] = result.solution.degree();
  json["region"] = region_json(region);
  json["energy_kind"] = arguments.energy;
  json["tension"] = tension_of(arguments);
  json["smoothing"] = smoothing_json(arguments.smoothing);
  json["tolerance"] = arguments.smoothing.tolerance ? Json(*arguments.smoothing.tolerance) : Json();
  json["tolerance_reached"] = arguments.smoothing.tolerance ? Json(result.tolerance_reached) : Json();
  json["lambda"] = result.lambda;
  json["energy"] = result.energy;
  json["effective_degrees"] = result.effective_degrees ? Json(*result.effective_degrees) : Json();
  json["rms_residual"] = result.rms_residual;
  json["max_residual"] = worst_point_json(account);
  json["minimum"] = arguments.minimum ? Json(*arguments.minimum) : Json();
  json["maximum"] = arguments.maximum ? Json(*arguments.maximum) : Json();
  json.update(Json::parse(constraint_json(result.constraints)));
  json["iterations"] = result.iterations;
  json["search_iterations"] = result.search_iterations;
  json["refinement_iterations"] = result.refinement_iterations;
  json["accuracy"] = result.accuracy;
  json["seconds"] = seconds_json(account);
  json["peak_memory_bytes"] = static_cast<std::int64_t>(peak_memory());
  json["notes"] = account.notes;
  json["warnings"] = account.warnings;
  return json;
}

}  // namespace

SmoothingFound found_by(const FitResult& result) {
  return {result.lambda, result.tolerance_reached, result.no_interior_minimum,
          result.constraints ? result.constraints->least_tolerance : std::nullopt};
}

void write_report(const std::filesystem::path& path, const FitAccount& account) {
  OutputFile file(path);
  constexpr int indent = 2;
  file.write(report_json(account).dump(indent, ' ', false, Json::error_handler_t::replace) + '\n');
  file.commit();
}

double peak_memory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

}  // namespace batten
