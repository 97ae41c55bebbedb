// SPDX-License-Identifier: MIT
#include <batten/app/fit_report.h>
#include <batten/app/solve_account.h>
#include <batten/io/output_file.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

Json place_json(const Extremes::Place& place) { return {{"value", place.value}, {"x", place.x}, {"y", place.y}}; }

Json extremes_json(const std::vector<Extremes>& extremes) {
  Json json = Json::object();
  for (const Extremes& e : extremes)
    json[e.array] = {{"least", place_json(e.least)}, {"largest", place_json(e.largest)}};
  return json;
}

Json reactions_json(const SolveAccount& account) {
  const BoundaryResult& result = *account.result;
  const auto& sides = result.side_reactions;
  Json json = {{"left", sides[0]}, {"right", sides[1]}, {"bottom", sides[2]}, {"top", sides[3]}};
  json["points"] = result.point_reactions;
  json["lines"] = result.line_reactions;
  if (account.corners) {
    const auto& c = *account.corners;
    json["corners"] = {{"lower_left", c[0]}, {"lower_right", c[1]}, {"upper_left", c[2]}, {"upper_right", c[3]}};
  }
  return json;
}

void add_result(const SolveAccount& account, Json& json) {
  const BoundaryResult& result = *account.result;
  json["levels"] = result.levels;
  json["iterations"] = result.iterations;
  json["accuracy"] = result.accuracy;
  json["energy"] = result.energy;
  json["compliance"] = result.compliance;
  json["reactions"] = reactions_json(account);
  json["extremes"] = extremes_json(account.extremes);
}

Json place_json(const StreamExtremes::Place& place) { return {{"value", place.value}, {"x", place.x}, {"y", place.y}}; }

void add_flow(const SolveAccount& account, Json& json) {
  const auto& [result, stream, streamlines] = *account.flow;
  json["mu"] = account.file->flow->viscosity;
  json["levels"] = result.levels;
  json["iterations"] = result.iterations;
  json["accuracy"] = result.accuracy;
  json["dissipation"] = result.dissipation;
  json["power"] = result.power;
  json["inflow"] = result.inflow;
  json["net_inflow"] = result.net_inflow;
  json["largest_divergence"] = result.largest_divergence;
  json["psi_min"] = place_json(stream.least);
  json["psi_max"] = place_json(stream.largest);
  json["extremes"] = extremes_json(account.extremes);
  json["streamlines"] = streamlines;
}

Json modes_json(const SolveAccount& account) {
  Json list = Json::array();
  for (const ModeAccount& mode : account.modes)
    list.push_back({{"file", mode.file},
                    {"eigenvalue", mode.eigenvalue},
                    {"angular_frequency", angular_frequency(mode.eigenvalue)},
                    {"frequency", frequency(mode.eigenvalue)},
                    {"residual", mode.residual}});
  return list;
}

Json frames_json(const SolveAccount& account) {
  Json list = Json::array();
  for (const FrameAccount& frame : account.frames)
    list.push_back({{"time", frame.time},
                    {"file", frame.file},
                    {"least", place_json(frame.extremes.least)},
                    {"largest", place_json(frame.extremes.largest)}});
  return list;
}

Json report_json(const SolveAccount& account) {
  const BoundaryProblem& problem = account.problem();
  const Rectangle& region = problem.region;
  Json json;
  json["file"] = account.arguments->problem;
  json["problem"] = account.file->kind();
  json["cells"] = {region.x.cells(), region.y.cells()};
  json["degree"] = problem.degree;
  json["region"] = {region.x.lower(), region.x.upper(), region.y.lower(), region.y.upper()};
  json["unknowns"] = account.unknowns();
  if (account.result) add_result(account, json);
  if (account.flow) add_flow(account, json);
  if (account.file->modes) json["modes"] = modes_json(account);
  if (account.file->motion) json["frames"] = frames_json(account);
  json["files"] = account.files;
  if (!account.result && !account.flow) json["cycles"] = account.cycles;
  json["notes"] = account.notes;
  Json seconds = Json::object();
  for (const PhaseTime& time : account.seconds) seconds[time.phase] = seconds.value(time.phase, 0.) + time.seconds;
  json["seconds"] = seconds;
  json["peak_memory_bytes"] = static_cast<std::int64_t>(peak_memory());
  return json;
}

}  // namespace

void write_report(const SolveAccount& account) {
  OutputFile file(account.arguments->report);
  constexpr int indent = 2;
  file.write(report_json(account).dump(indent, ' ', false, Json::error_handler_t::replace) + '\n');
  file.commit();
}

}  // namespace batten
