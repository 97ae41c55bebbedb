// SPDX-License-Identifier: MIT
#include <batten/app/nearest_name.h>
#include <batten/app/stokes_entries.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <array>
#include <string>

namespace batten {
namespace {

constexpr int digits = 10;
constexpr const char* what_a_side_is = "{u = ..., v = ...}, \"wall\", \"symmetry\" or \"free\"";

struct Reason {
  const char *key, *text;
};

/// Keys that are there for other problems.
void refuse_others(const TomlValue& table, std::span<const Reason> reasons) {
  for (const TomlValue& item : table.items)
    for (const auto& [key, text] : reasons)
      if (item.key == key) refuse(item, text);
}

double viscosity_of(const TomlValue& table) {
  static constexpr std::array known = {"mu"};
  const TomlEntries entries(table, known);
  const TomlValue* const mu = entries.find("mu");
  if (!mu) return 1;
  if (mu->kind == TomlValue::Kind::Table) refuse(*mu, "must be a number: the viscosity of a slow flow is constant");
  const double viscosity = constant_of(*mu);
  if (!(viscosity > 0)) refuse(*mu, "must be positive, found " + number_text(viscosity, digits));
  return viscosity;
}

StokesSide named_side(const TomlValue& entry) {
  static constexpr std::array words = {"wall", "symmetry", "free"};
  const std::string& word = entry.text;
  if (word == "wall") return StokesSide::wall();
  if (word == "symmetry") return StokesSide::symmetry();
  if (word == "free") return StokesSide::free();
  if (word == "periodic")
    refuse(entry,
           std::string("\"periodic\" is not for slow flows: how much flows through periodic sides is not determined "
                       "by them. A side is ") +
               what_a_side_is);
  refuse(entry, "unknown side \"" + word + "\"; did you mean \"" + nearest_name(word, words) + "\"? A side is " +
                    what_a_side_is);
}

StokesSide side_of(const TomlValue& entry, const FieldReader& fields, std::span<const Place> places) {
  static constexpr std::array known = {"u", "v"};
  if (entry.kind == TomlValue::Kind::Text) return named_side(entry);
  if (entry.kind != TomlValue::Kind::Table)
    refuse(entry, std::string(what_a_side_is) + " is expected, found " + found_text(entry));
  const TomlEntries entries(entry, known);
  const std::string both = "a velocity in both directions, {u = ..., v = ...},";
  return StokesSide::moving(fields.read(entries.require("u", both), places),
                            fields.read(entries.require("v", both), places));
}

void read_sides(const TomlValue& table, const FieldReader& fields, StokesProblem& problem) {
  static constexpr std::array names = {"left", "right", "bottom", "top"};
  const TomlEntries entries(table, names);
  const auto& [x, y] = fields.region();
  const std::array<Place, 4> corners = {
      Place{x.lower(), y.lower()}, {x.upper(), y.lower()}, {x.lower(), y.upper()}, {x.upper(), y.upper()}};
  const auto read = [&](const char* name, int from, int to) {
    return side_of(entries.require(name, what_a_side_is), fields,
                   places_on(corners[static_cast<std::size_t>(from)], corners[static_cast<std::size_t>(to)]));
  };
  problem.left = read("left", 0, 2);
  problem.right = read("right", 1, 3);
  problem.bottom = read("bottom", 0, 1);
  problem.top = read("top", 2, 3);
}

StokesProblem::PointForce point_force(const TomlValue& item, const Rectangle& region) {
  static constexpr std::array known = {"x", "y", "fx", "fy"};
  const TomlEntries entries(item, known);
  const auto number = [&](const char* key, const char* what) { return constant_of(entries.require(key, what)); };
  const StokesProblem::PointForce force{number("x", "a number"), number("y", "a number"), number("fx", "a force"),
                                        number("fy", "a force")};
  if (!region.contains(force.x, force.y))
    refuse(item, std::string("(") + number_text(force.x, digits) + ", " + number_text(force.y, digits) +
                     ") lies outside the region");
  return force;
}

void read_forces(const TomlValue& table, const FieldReader& fields, StokesProblem& problem) {
  static constexpr std::array known = {"fx", "fy", "points"};
  static constexpr std::array reasons = {
      Reason{"q", "is a load for plates and Poisson problems; the force per area on a flow is fx and fy"},
      Reason{"lines", "is for plates and Poisson problems; a slow flow takes fx, fy and points"},
      Reason{"patches", "is for plates and Poisson problems; a slow flow takes fx and fy, as in \"x < 0.5 ? 1 : 0\""}};
  refuse_others(table, reasons);
  const TomlEntries entries(table, known);
  const auto places = places_in(fields.region());
  if (const TomlValue* const fx = entries.find("fx")) problem.force_x = fields.read(*fx, places);
  if (const TomlValue* const fy = entries.find("fy")) problem.force_y = fields.read(*fy, places);
  const TomlValue* const points = entries.find("points");
  if (!points) return;
  expect_tables(*points, "x = 0.5, y = 0.5, fx = 1, fy = 0");
  for (const TomlValue& item : points->items) problem.point_forces.push_back(point_force(item, fields.region()));
}

/// What the library says about the sides together gets their place in the file.
void check(const TomlValue& sides, const StokesProblem& problem) {
  try {
    stream_function_problem(problem);
  } catch (const InvalidInput& error) {
    refuse(sides, error.what());
  }
}

}  // namespace

StokesProblem stokes_of(const TomlEntries& file, int degree, const FieldReader& fields) {
  static constexpr std::array reasons = {
      Reason{"supports", "is for plates and Poisson problems; a slow flow is held by its sides alone"},
      Reason{"modes", "is for plates and Poisson problems; a slow flow has no inertia and does not vibrate"},
      Reason{"time", "is for plates and Poisson problems; a slow flow has no inertia and follows its sides at once"}};
  refuse_others(file.table(), reasons);
  const TomlValue& sides = file.require("sides", "a table [sides] with left, right, bottom, top");
  StokesProblem problem{.region = fields.region(), .degree = degree};
  if (const TomlValue* const material = file.find("material")) problem.viscosity = viscosity_of(*material);
  read_sides(sides, fields, problem);
  if (const TomlValue* const load = file.find("load")) read_forces(*load, fields, problem);
  check(sides, problem);
  return problem;
}

}  // namespace batten
