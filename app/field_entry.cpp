// SPDX-License-Identifier: MIT
#include <batten/app/expression_entry.h>
#include <batten/app/field_entry.h>
#include <batten/app/field_table.h>
#include <batten/app/toml_entries.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr int most_cells = 256;  // sampled along a side
constexpr int digits = 10;

/// Every k-th breakpoint, and the last.
std::vector<double> coordinates_of(const Interval& interval) {
  const int step = (interval.cells() + most_cells - 1) / most_cells;
  std::vector<double> result;
  for (int i = 0; i < interval.cells(); i += step) result.push_back(interval.coordinate(i));
  result.push_back(interval.coordinate(interval.cells()));
  return result;
}

std::vector<Place> corners_and_centres(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Place> places;
  for (const double b : y)
    for (const double a : x) places.push_back({a, b});
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    for (std::size_t i = 0; i + 1 < x.size(); ++i) places.push_back({(x[i] + x[i + 1]) / 2, (y[j] + y[j + 1]) / 2});
  return places;
}

bool has_sign(double value, Sign sign) {
  return sign == Sign::Any || value > 0 || (sign == Sign::NotNegative && value == 0);
}

std::string rule_of(Sign sign) { return sign == Sign::Positive ? "must be positive" : "must not be negative"; }

std::string place_text(const Place& place) {
  return " at x = " + number_text(place[0], digits) + ", y = " + number_text(place[1], digits);
}

void check(const TomlValue& value, const Field& field, std::span<const Place> places, Sign sign) {
  for (const Place& place : field.is_constant() ? places.first(1) : places) {
    const double found = field(place[0], place[1]);
    const std::string where = field.is_constant() ? "" : place_text(place);
    if (!std::isfinite(found)) refuse(value, "must be finite, found " + number_text(std::abs(found)) + where);
    if (!has_sign(found, sign)) refuse(value, rule_of(sign) + ", found " + number_text(found, digits) + where);
  }
}

/// Adds the place in the file to what is wrong with a table.
TableField read_table_field(const TomlValue& name, const std::filesystem::path& file, const Rectangle& region) {
  try {
    return field_of_table(file, region);
  } catch (const Error& error) {
    refuse(name, error.what());
  }
}

}  // namespace

std::vector<Place> places_in(const Rectangle& region) {
  return corners_and_centres(coordinates_of(region.x), coordinates_of(region.y));
}

std::vector<Place> places_in(const std::array<double, 2>& x, const std::array<double, 2>& y) {
  constexpr int cells = 32;
  return places_in(Rectangle{Interval(x[0], x[1], cells), Interval(y[0], y[1], cells)});
}

std::vector<Place> places_on(const Place& from, const Place& to) {
  constexpr int steps = 2 * most_cells;
  std::vector<Place> places;
  for (int i = 0; i <= steps; ++i)
    places.push_back({std::lerp(from[0], to[0], i / double{steps}), std::lerp(from[1], to[1], i / double{steps})});
  return places;
}

Field FieldReader::table_field(const TomlValue& value, std::span<const Place> places) const {
  static constexpr std::array known = {"table"};
  const TomlValue& name = TomlEntries(value, known).require("table", "the name of a CSV file");
  if (name.kind != TomlValue::Kind::Text) refuse(name, "the name of a CSV file is expected, found " + found_text(name));
  const TableField table = read_table_field(name, folder_ / name.text, region_);
  const auto outside =
      std::find_if(places.begin(), places.end(), [&](const Place& p) { return std::isnan(table.field(p[0], p[1])); });
  if (outside == places.end()) return table.field;
  refuse(name, name.text + " covers " + table.extent + " only; a value is needed" + place_text(*outside));
}

Field FieldReader::read(const TomlValue& value, std::span<const Place> places, Sign sign) const {
  Field field;
  if (value.kind == TomlValue::Kind::Table) {
    field = table_field(value, places);
  } else if (value.kind == TomlValue::Kind::Text) {
    const Expression expression = expression_of(value);
    field = expression.is_constant() ? Field(expression(0, 0)) : Field(expression);
  } else if (value.kind == TomlValue::Kind::Number) {
    field = value.number;
  } else {
    refuse(value, "a number, an expression or {table = \"FILE.csv\"} is expected, found " + found_text(value));
  }
  check(value, field, places, sign);
  return field;
}

}  // namespace batten
