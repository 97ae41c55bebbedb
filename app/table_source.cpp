// SPDX-License-Identifier: MIT
#include <batten/app/table_source.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

namespace batten {
namespace {

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& rule, double found) {
  throw InvalidInput(source_name(file) + ": line " + std::to_string(line) + ": " + rule + ", found " +
                     number_text(found, 10));
}

}  // namespace

std::string source_name(const std::string& file) { return file == "-" ? "standard input" : file; }

std::string place_text(std::size_t line, double x, double y) {
  return "line " + std::to_string(line) + " at (" + number_text(x, 6) + ", " + number_text(y, 6) + ")";
}

std::string counts_text(const std::string& file, const PointCounts& counts, const std::string& noun) {
  std::string text = source_name(file) + ": " + std::to_string(counts.used) + " " + noun;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + ' ' + what;
  };
  add(counts.skipped, "rows skipped");
  add(counts.outside, "outside the region");
  add(counts.merged, "averaged into others");
  return text;
}

void check_weights(const std::string& file, std::span<const std::size_t> lines, std::span<const double> weights) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] < 0) refuse(file, lines[i], "weights must not be negative", weights[i]);
  }
}

void check_tolerances(const std::string& file, std::span<const std::size_t> lines, std::span<const double> tolerances) {
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    if (tolerances[i] <= 0) refuse(file, lines[i], "tolerances must be positive", tolerances[i]);
  }
}

}  // namespace batten
