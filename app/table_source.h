// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace batten {

/// The rows of a table that became points.
struct PointCounts {
  std::size_t used = 0, skipped = 0, outside = 0, merged = 0;
};

/// How messages call a file: "standard input" for "-".
std::string source_name(const std::string& file);

/// "line 17 at (2.5, 3)": where a row comes from.
std::string place_text(std::size_t line, double x, double y);

/// "wind.csv: 4800 vectors, 3 rows skipped": `noun` is what a row holds.
std::string counts_text(const std::string& file, const PointCounts& counts, const std::string& noun);

/// Throw InvalidInput with the line of the first weight below 0, and of the first tolerance that is not above 0.
void check_weights(const std::string& file, std::span<const std::size_t> lines, std::span<const double> weights);
void check_tolerances(const std::string& file, std::span<const std::size_t> lines, std::span<const double> tolerances);

}  // namespace batten
