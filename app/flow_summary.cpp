// SPDX-License-Identifier: MIT
#include <batten/app/constraint_report.h>
#include <batten/app/fit_report.h>
#include <batten/app/flow_outputs.h>
#include <batten/app/flow_report.h>
#include <batten/app/grid_text.h>
#include <batten/domains/number_text.h>

namespace batten {
namespace {

std::string field_line(const FlowAccount& account) {
  const FlowResult& result = *account.result;
  std::string line = "model " + account.arguments->model + ", " +
                     smoothing_text(account.arguments->smoothing, found_by(result)) + ", energy " +
                     number_text(result.energy);
  if (result.effective_degrees) line += ", " + number_text(*result.effective_degrees) + " effective degrees of freedom";
  return line + constraint_text(result.constraints);
}

std::string residual_line(const FlowAccount& account) {
  const FlowResult& result = *account.result;
  return "residual: rms " + number_text(result.rms_residual) + ", largest " + number_text(result.largest_residual) +
         ", " + place_of(*account.input, result.worst_point) + "; divergence at most " +
         number_text(result.largest_divergence, 2) + " of |grad v|";
}

/// What the fit has found of fluxes and mean flows, a line or nothing.
std::string side_line(const FlowResult& result) {
  std::string line;
  const auto add = [&](const char* name, const std::optional<double>& value) {
    if (value) line += (line.empty() ? "" : ", ") + std::string(name) + ' ' + number_text(*value);
  };
  add("flux between the walls", result.flux);
  add("mean u", result.mean_u);
  add("mean v", result.mean_v);
  return line.empty() ? line : line + '\n';
}

std::string cost_line(const FlowAccount& account) {
  const FlowResult& result = *account.result;
  std::string line = std::to_string(result.iterations) + " V-cycles";
  if (result.search_iterations > 0) line += " and " + std::to_string(result.search_iterations) + " in search of lambda";
  if (account.streamlines > 0) line += ", " + std::to_string(account.streamlines) + " streamlines";
  if (!account.seconds.empty()) line += ", " + number_text(account.seconds.back().seconds, 3) + " s";
  line += ", " + bytes_text(peak_memory()) + "; wrote";
  for (const std::string& file : output_files(*account.arguments)) line += ' ' + file;
  return line;
}

}  // namespace

std::string summary_of(const FlowAccount& account) {
  const FlowField& field = account.result->field;
  std::size_t unknowns = 0;
  for (const auto* part : {&field.stream(), &field.potential()})
    if (*part) unknowns += (*part)->coefficients().size();
  return counts_text(account.arguments->vectors, account.counts(), "vectors") + '\n' +
         grid_text(field.region(), field.degree(), unknowns) + '\n' + field_line(account) + '\n' +
         residual_line(account) + '\n' + side_line(*account.result) + cost_line(account) + '\n';
}

}  // namespace batten
