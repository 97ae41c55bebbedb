// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/toml_tree.h>
#include <batten/domains/rectangle.h>
#include <batten/fem/boundary_problem.h>

#include <array>
#include <filesystem>
#include <span>
#include <vector>

namespace batten {

using Place = std::array<double, 2>;

/// The corners of the cells, at most 257 x 257 of them with the ends, and the centres between them.
std::vector<Place> places_in(const Rectangle& region);
/// Corners and centres of 32 x 32 cells.
std::vector<Place> places_in(const std::array<double, 2>& x, const std::array<double, 2>& y);
/// 513 places of a line, the ends included.
std::vector<Place> places_on(const Place& from, const Place& to);

enum class Sign { Any, NotNegative, Positive };

/// Makes fields of what a file says: a number, a text with an expression, or {table = "f.csv"} (see field_table.h).
class FieldReader {
public:
  /// Tables are looked for in `folder`.
  FieldReader(const Rectangle& region, std::filesystem::path folder) : region_(region), folder_(std::move(folder)) {}

  /// An expression without x and y gives a constant. Throws InvalidInput, with the place, if it is not finite or has
  /// the wrong sign at one of the places; IoError for tables that cannot be read.
  Field read(const TomlValue& value, std::span<const Place> places, Sign sign = Sign::Any) const;

  const Rectangle& region() const { return region_; }

private:
  Field table_field(const TomlValue& value, std::span<const Place> places) const;

  Rectangle region_;
  std::filesystem::path folder_;
};

}  // namespace batten
