// SPDX-License-Identifier: MIT
#include <batten/app/fit_outputs.h>
#include <batten/app/fit_report.h>
#include <batten/app/grid_text.h>
#include <batten/domains/number_text.h>

namespace batten {
namespace {

std::string points_line(const FitAccount& account) {
  const FitResult& result = *account.result;
  const std::string source = account.arguments->points == "-" ? "standard input" : account.arguments->points;
  std::string line = source + ": " + std::to_string(result.points_used) + " points";
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) line += ", " + std::to_string(count) + ' ' + what;
  };
  add(account.input->skipped, "rows skipped");
  add(result.points_outside, "outside the region");
  add(result.points_merged, "averaged into others");
  return line;
}

std::string energy_text(const FitArguments& arguments) {
  if (arguments.energy == "tension") return "tension " + number_text(tension_of(arguments));
  return arguments.energy == "membrane" ? "membrane" : "thin plate";
}

std::string smoothing_text(const FitAccount& account) {
  const FitResult& result = *account.result;
  const Smoothing smoothing = smoothing_of(*account.arguments);
  switch (smoothing.kind) {
    case Smoothing::Kind::Tolerance:
      return "within " + number_text(smoothing.value) + (result.tolerance_reached ? "" : " (not reached)");
    case Smoothing::Kind::None:
      return result.lambda > 0 ? "lambda " + number_text(result.lambda) : "no smoothing";
    case Smoothing::Kind::Automatic:
      return "lambda " + number_text(result.lambda) + " by cross-validation" +
             (result.no_interior_minimum ? " (no interior minimum)" : "");
    case Smoothing::Kind::Fixed:
      break;
  }
  return "lambda " + number_text(result.lambda);
}

std::string surface_line(const FitAccount& account) {
  const FitResult& result = *account.result;
  std::string line =
      energy_text(*account.arguments) + ", " + smoothing_text(account) + ", energy " + number_text(result.energy);
  if (result.effective_degrees) line += ", " + number_text(*result.effective_degrees) + " effective degrees of freedom";
  return line;
}

std::string residual_line(const FitAccount& account) {
  const FitResult& result = *account.result;
  return "residual: rms " + number_text(result.rms_residual) + ", largest " + number_text(result.largest_residual) +
         ", " + place_of(*account.input, result.worst_point);
}

std::string cost_line(const FitAccount& account) {
  const FitResult& result = *account.result;
  std::string line = std::to_string(result.iterations) + " V-cycles";
  if (result.search_iterations > 0) line += " and " + std::to_string(result.search_iterations) + " in search of lambda";
  if (!account.seconds.empty()) line += ", " + number_text(account.seconds.back().seconds, 3) + " s";
  line += ", " + bytes_text(peak_memory()) + "; wrote";
  for (const std::string& file : output_files(*account.arguments)) line += ' ' + file;
  return line;
}

}  // namespace

std::string summary_of(const FitAccount& account) {
  const Solution& solution = account.result->solution;
  return points_line(account) + '\n' + grid_text(solution.region(), solution.degree(), solution.coefficients().size()) +
         '\n' + surface_line(account) + '\n' + residual_line(account) + '\n' + cost_line(account) + '\n';
}

}  // namespace batten
