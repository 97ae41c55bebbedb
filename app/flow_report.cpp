// SPDX-License-Identifier: MIT
#include <batten/app/constraint_report.h>
#include <batten/app/fit_report.h>
#include <batten/app/flow_report.h>
#include <batten/io/output_file.h>

#include <nlohmann/json.hpp>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

Json points_json(const PointCounts& counts) {
  return {{"used", counts.used}, {"skipped", counts.skipped}, {"outside", counts.outside}, {"merged", counts.merged}};
}

Json worst_json(const FlowAccount& account) {
  const std::size_t worst = account.result->worst_point;
  return {{"value", account.result->largest_residual},
          {"x", account.input->observations.x[worst]},
          {"y", account.input->observations.y[worst]},
          {"line", account.input->lines[worst]}};
}

void add_result(const FlowResult& result, Json& json) {
  json["lambda"] = result.lambda;
  json["energy"] = result.energy;
  json["potential_energy"] = result.potential_energy;
  json["effective_degrees"] = result.effective_degrees ? Json(*result.effective_degrees) : Json();
  json["rms_residual"] = result.rms_residual;
  json["largest_divergence"] = result.largest_divergence;
  const auto found = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  json["flux"] = found(result.flux);
  json["mean_u"] = found(result.mean_u);
  json["mean_v"] = found(result.mean_v);
  json["iterations"] = result.iterations;
  json["search_iterations"] = result.search_iterations;
  json["accuracy"] = result.accuracy;
}

Json report_json(const FlowAccount& account) {
  const FlowArguments& arguments = *account.arguments;
  const FlowField& field = account.result->field;
  const Rectangle& region = field.region();
  const std::size_t unknowns = (field.stream() ? field.stream()->coefficients().size() : 0) +
                               (field.potential() ? field.potential()->coefficients().size() : 0);
  const auto& tolerance = arguments.smoothing.tolerance;
  Json json;
  json["points"] = points_json(account.counts());
  json["unknowns"] = unknowns;
  json["cells"] = {region.x.cells(), region.y.cells()};
  json["degree"] = field.degree();
  json["region"] = {region.x.lower(), region.x.upper(), region.y.lower(), region.y.upper()};
  json["model"] = arguments.model;
  if (model_of(arguments) == FlowModel::General) json["ratio"] = arguments.ratio.value_or(1);
  json["geographic"] = arguments.geographic;
  const FlowSides sides = sides_of(arguments.sides);
  json["sides"] = {{"left", side_name(sides.left)},
                   {"right", side_name(sides.right)},
                   {"bottom", side_name(sides.bottom)},
                   {"top", side_name(sides.top)}};
  const Smoothing smoothing = smoothing_of(arguments.smoothing);
  json["smoothing"] = tolerance ? "tolerance" : arguments.smoothing.text;
  if (smoothing.kind == Smoothing::Kind::Fixed) json["smoothing"] = smoothing.value;
  json["tolerance"] = tolerance ? Json(*tolerance) : Json();
  json["tolerance_norm"] = tolerance ? Json(arguments.tolerance_norm) : Json();
  json["tolerance_reached"] = tolerance ? Json(account.result->tolerance_reached) : Json();
  add_result(*account.result, json);
  json["max_residual"] = worst_json(account);
  json.update(Json::parse(constraint_json(account.result->constraints)));
  json["streamlines"] = account.streamlines;
  Json seconds = Json::object();
  for (const PhaseTime& time : account.seconds) seconds[time.phase] = seconds.value(time.phase, 0.) + time.seconds;
  json["seconds"] = seconds;
  json["peak_memory_bytes"] = static_cast<std::int64_t>(peak_memory());
  json["notes"] = account.notes;
  json["warnings"] = account.warnings;
  return json;
}

}  // namespace

SmoothingFound found_by(const FlowResult& result) {
  return {result.lambda, result.tolerance_reached, result.no_interior_minimum,
          result.constraints ? result.constraints->least_tolerance : std::nullopt};
}

void write_report(const FlowAccount& account) {
  OutputFile file(account.arguments->report);
  constexpr int indent = 2;
  file.write(report_json(account).dump(indent, ' ', false, Json::error_handler_t::replace) + '\n');
  file.commit();
}

}  // namespace batten
