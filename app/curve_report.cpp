// SPDX-License-Identifier: MIT
#include <batten/app/curve_report.h>
#include <batten/app/fit_report.h>
#include <batten/io/output_file.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

void add_account(Json& json, const FittedCurve& fitted) {
  json["energy"] = fitted.normalised_energy;
  const auto& account = fitted.account;
  json["energy_gap"] = account ? Json(account->energy_gap) : Json();
  json["largest_violation"] = account ? Json(account->largest_violation) : Json();
  json["least_tolerance"] = Json();  // every tolerance can be met
  json["active"] = account ? Json(account->active) : Json();
  json["factorisations"] = account ? Json(account->factorisations) : Json();
}

void add_residuals(Json& json, const FittedCurve& fitted, const CurveInput& input) {
  const Eigen::VectorXd residuals = (fitted.values - input.points).rowwise().norm();
  Eigen::Index worst = 0;
  const double largest = residuals.maxCoeff(&worst);
  json["rms_residual"] = residuals.norm() / std::sqrt(static_cast<double>(residuals.size()));
  json["max_residual"] = {{"value", largest}, {"line", input.lines[static_cast<std::size_t>(worst)]}};
}

Json report_json(const CurveReport& report) {
  const SubdivideArguments& a = *report.arguments;
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json json;
  json["scheme"] = a.scheme.name;
  json["points"] = report.input->points.rows();
  json["levels"] = a.levels;
  json["points_out"] = report.points_out;
  json["closed"] = a.closed;
  json["parameter"] = a.parameter;
  if (report.fitted) {
    json["interpolate"] = a.interpolate;
    json["smoothing"] = number(a.smoothing);
    json["tolerance"] = number(a.tolerance);
    json["minimum"] = number(a.minimum);
    json["maximum"] = number(a.maximum);
    add_account(json, *report.fitted);
    add_residuals(json, *report.fitted, *report.input);
  }
  json["notes"] = report.notes;
  json["seconds"] = Json::object();
  for (const PhaseTime& time : report.seconds) json["seconds"][time.phase] = time.seconds;
  json["peak_memory_bytes"] = static_cast<std::int64_t>(peak_memory());
  return json;
}

}  // namespace

void write_report(const CurveReport& report) {
  OutputFile file(report.arguments->report);
  constexpr int indent = 2;
  file.write(report_json(report).dump(indent, ' ', false, Json::error_handler_t::replace) + '\n');
  file.commit();
}

}  // namespace batten
