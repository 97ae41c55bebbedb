// SPDX-License-Identifier: MIT
#include <batten/app/load_entries.h>
#include <batten/app/toml_entries.h>
#include <batten/domains/number_text.h>

#include <array>
#include <cmath>

namespace batten {
namespace {

constexpr int digits = 10;

std::string range_text(const Interval& interval) {
  return number_text(interval.lower(), digits) + " to " + number_text(interval.upper(), digits);
}

void expect_inside(const TomlValue& value, const Place& place, const Rectangle& region) {
  if (region.contains(place[0], place[1])) return;
  refuse(value, std::string("(") + number_text(place[0], digits) + ", " + number_text(place[1], digits) +
                    ") lies outside the region, x " + range_text(region.x) + ", y " + range_text(region.y));
}

Place point_of(const TomlEntries& entries, const Rectangle& region) {
  const Place place = {constant_of(entries.require("x", "a number")), constant_of(entries.require("y", "a number"))};
  expect_inside(entries.table(), place, region);
  return place;
}

struct Ends {
  Place from, to;
};

Ends ends_of(const TomlEntries& entries, const Rectangle& region) {
  const TomlValue &from = entries.require("from", "a point [x, y]"), &to = entries.require("to", "a point [x, y]");
  const Ends ends{pair_of(from, "a point [x, y]"), pair_of(to, "a point [x, y]")};
  expect_inside(from, ends.from, region);
  expect_inside(to, ends.to, region);
  if (ends.from == ends.to) refuse(entries.table(), "the line has no length: from and to are the same point");
  return ends;
}

/// A line with a value along it, of a load or a support.
template <class Line>
Line line_of(const TomlValue& item, const FieldReader& fields, bool needs_value) {
  static constexpr std::array known = {"from", "to", "value"};
  const TomlEntries entries(item, known);
  const auto [from, to] = ends_of(entries, fields.region());
  const TomlValue* const value = needs_value ? &entries.require("value", "a load per length") : entries.find("value");
  return {from, to, value ? fields.read(*value, places_on(from, to)) : Field(0)};
}

Loads::Point load_point(const TomlValue& item, const FieldReader& fields) {
  static constexpr std::array known = {"x", "y", "value"};
  const TomlEntries entries(item, known);
  const auto [x, y] = point_of(entries, fields.region());
  return {x, y, constant_of(entries.require("value", "a force"))};
}

Loads::Patch patch_of(const TomlValue& item, const FieldReader& fields) {
  static constexpr std::array known = {"x", "y", "q"};
  const TomlEntries entries(item, known);
  const auto x = range_of(entries.require("x", "a range [lower, upper]"));
  const auto y = range_of(entries.require("y", "a range [lower, upper]"));
  expect_inside(item, {x[0], y[0]}, fields.region());
  expect_inside(item, {x[1], y[1]}, fields.region());
  return {x, y, fields.read(entries.require("q", "a load per area"), places_in(x, y))};
}

Supports::Point support_point(const TomlValue& item, bool is_plate, const FieldReader& fields) {
  static constexpr std::array known = {"x", "y", "value", "radius"};
  const TomlEntries entries(item, known);
  const auto [x, y] = point_of(entries, fields.region());
  const TomlValue *const value = entries.find("value"), *const radius = entries.find("radius");
  if (!radius && !is_plate)
    refuse(
        item,
        "a support of a Poisson problem needs a radius: the value at a bare point is not bounded in two dimensions and "
        "would hold nothing");
  if (radius && is_plate) refuse(*radius, "is for Poisson problems; a plate is held at the point itself");
  const Supports::Point point{x, y, value ? constant_of(*value) : 0, radius ? constant_of(*radius) : 0};
  if (radius && !(point.radius > 0)) refuse(*radius, "must be positive, found " + number_text(point.radius, digits));
  return point;
}

}  // namespace

Loads loads_of(const TomlValue& table, bool is_plate, const FieldReader& fields) {
  static constexpr std::array known = {"q", "points", "lines", "patches"};
  const TomlEntries entries(table, known);
  Loads loads;
  if (const TomlValue* const q = entries.find("q")) loads.area = fields.read(*q, places_in(fields.region()));
  if (const TomlValue* const points = entries.find("points")) {
    if (!is_plate)
      refuse(
          *points,
          "loads at points are for plates: the solution of a Poisson problem is not bounded there in two dimensions; "
          "take a patch or a line");
    expect_tables(*points, "x = 0.5, y = 0.5, value = 1");
    for (const TomlValue& item : points->items) loads.points.push_back(load_point(item, fields));
  }
  if (const TomlValue* const lines = entries.find("lines")) {
    expect_tables(*lines, "from = [0, 0], to = [1, 1], value = 1");
    for (const TomlValue& item : lines->items) loads.lines.push_back(line_of<Loads::Line>(item, fields, true));
  }
  if (const TomlValue* const patches = entries.find("patches")) {
    expect_tables(*patches, "x = [0, 0.5], y = [0, 0.5], q = 1");
    for (const TomlValue& item : patches->items) loads.patches.push_back(patch_of(item, fields));
  }
  return loads;
}

Supports supports_of(const TomlValue& table, bool is_plate, const FieldReader& fields) {
  static constexpr std::array known = {"points", "lines"};
  const TomlEntries entries(table, known);
  Supports supports;
  if (const TomlValue* const points = entries.find("points")) {
    expect_tables(*points, is_plate ? "x = 0.5, y = 0.5" : "x = 0.5, y = 0.5, radius = 0.02");
    for (const TomlValue& item : points->items) supports.points.push_back(support_point(item, is_plate, fields));
  }
  if (const TomlValue* const lines = entries.find("lines")) {
    expect_tables(*lines, "from = [0, 0.5], to = [1, 0.5]");
    for (const TomlValue& item : lines->items) supports.lines.push_back(line_of<Supports::Line>(item, fields, false));
  }
  return supports;
}

}  // namespace batten
