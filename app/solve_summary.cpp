// SPDX-License-Identifier: MIT
#include <batten/app/fit_report.h>
#include <batten/app/grid_text.h>
#include <batten/app/solve_account.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace batten {
namespace {

constexpr std::array side_names = {"left", "right", "bottom", "top"};

std::string side_word(const Side& side, bool is_plate) {
  if (side.periodic) return "periodic";
  if (side.value && side.normal) return "clamped";
  if (side.value) return is_plate ? "supported" : "fixed";
  if (side.normal) return is_plate ? "sloped" : "with a flux";
  return "free";
}

std::string side_word(const StokesSide& side) {
  if (side.kind == StokesSide::Kind::Symmetry) return "symmetry";
  if (side.kind == StokesSide::Kind::Free) return "free";
  return side.u.is_zero() && side.v.is_zero() ? "a wall" : "moving";
}

std::array<std::string, 4> side_words(const SolveAccount& account) {
  if (account.file->flow) {
    const StokesProblem& p = *account.file->flow;
    return {side_word(p.left), side_word(p.right), side_word(p.bottom), side_word(p.top)};
  }
  const auto& [left, right, bottom, top] = account.problem().sides;
  const bool plate = account.is_plate();
  return {side_word(left, plate), side_word(right, plate), side_word(bottom, plate), side_word(top, plate)};
}

/// "all sides clamped", or each of them.
std::string sides_text(const SolveAccount& account) {
  const auto words = side_words(account);
  if (std::all_of(words.begin(), words.end(), [&](const std::string& word) { return word == words[0]; }))
    return "all sides " + words[0];
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : ", ") + std::string(side_names[k]) + ' ' + words[k];
  return text;
}

std::string problem_line(const SolveAccount& account) {
  const char* const kind = account.file->flow ? "slow flow" : account.is_plate() ? "plate" : "Poisson problem";
  return account.arguments->problem + ": " + kind + ", " + sides_text(account);
}

template <class Place>
std::string place_text(const Place& place) {
  return number_text(place.value, 6) + " at (" + number_text(place.x, 6) + ", " + number_text(place.y, 6) + ")";
}

std::string extremes_line(const SolveAccount& account, const Extremes& extremes) {
  return std::string(account.file->unknown()) + " from " + place_text(extremes.least) + " to " +
         place_text(extremes.largest);
}

std::string energy_line(const SolveAccount& account) {
  const BoundaryResult& result = *account.result;
  std::string line = "energy " + number_text(result.energy, 6) + ", work of the loads " +
                     number_text(result.compliance, 6) + "; reactions:";
  for (std::size_t k = 0; k < side_names.size(); ++k)
    line += (k == 0 ? " " : ", ") + std::string(side_names[k]) + ' ' + number_text(result.side_reactions[k]);
  return line;
}

/// Seconds, memory and files; of many files the first and the last.
std::string cost_text(const SolveAccount& account) {
  constexpr std::size_t most = 6;
  std::string line = account.seconds.empty() ? "" : number_text(account.seconds.back().seconds, 3) + " s, ";
  line += bytes_text(peak_memory()) + "; wrote";
  const auto& files = account.files;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files.size() > most && i > 1 && i + 2 < files.size()) {
      if (i == 2) line += " ...";
      continue;
    }
    line += ' ' + files[i];
  }
  return line;
}

std::string result_text(const SolveAccount& account) {
  const BoundaryResult& result = *account.result;
  return extremes_line(account, account.extremes.front()) + '\n' + energy_line(account) + '\n' +
         std::to_string(result.iterations) + " V-cycles, accuracy " + number_text(result.accuracy, 2) + ", ";
}

std::string flow_text(const SolveAccount& account) {
  const auto& [result, stream, streamlines] = *account.flow;
  std::string text = "psi from " + place_text(stream.least) + " to " + place_text(stream.largest) + '\n';
  text += "dissipation " + number_text(result.dissipation, 6) + ", power of the forces " +
          number_text(result.power, 6) + ", inflow " + number_text(result.inflow, 6) + "; divergence at most " +
          number_text(result.largest_divergence, 2) + " of |grad v|\n";
  text += std::to_string(result.iterations) + " V-cycles, accuracy " + number_text(result.accuracy, 2) + ", ";
  if (streamlines > 0) text += std::to_string(streamlines) + " streamlines, ";
  return text;
}

std::string modes_text(const SolveAccount& account) {
  std::string text = " mode      frequency   angular freq.     eigenvalue\n";
  for (std::size_t k = 0; k < account.modes.size(); ++k) {
    const double eigenvalue = account.modes[k].eigenvalue;
    std::array<char, 128> row;
    std::snprintf(row.data(), row.size(), "%5zu %14.8g %15.8g %14.8g\n", k + 1, frequency(eigenvalue),
                  angular_frequency(eigenvalue), eigenvalue);
    text += row.data();
  }
  return text;
}

std::string motion_text(const SolveAccount& account) {
  if (account.frames.empty()) return "";
  const FrameAccount& last = account.frames.back();
  return std::to_string(account.frames.size()) + " states to time " + number_text(last.time, 6) + ", where " +
         extremes_line(account, last.extremes) + '\n';
}

}  // namespace

double angular_frequency(double eigenvalue) { return std::sqrt(std::max(eigenvalue, 0.)); }
double frequency(double eigenvalue) { return angular_frequency(eigenvalue) / (2 * std::numbers::pi); }

std::string summary_of(const SolveAccount& account) {
  std::string text = problem_line(account) + '\n';
  text += grid_text(account.problem().region, account.problem().degree, account.unknowns()) + '\n';
  if (account.result) text += result_text(account);
  if (account.flow) text += flow_text(account);
  if (account.file->modes) text += modes_text(account);
  if (account.file->motion) text += motion_text(account);
  return text + cost_text(account) + '\n';
}

}  // namespace batten
