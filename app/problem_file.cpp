// SPDX-License-Identifier: MIT
#include <batten/app/field_entry.h>
#include <batten/app/load_entries.h>
#include <batten/app/memory_estimate.h>
#include <batten/app/nearest_name.h>
#include <batten/app/problem_file.h>
#include <batten/app/side_entries.h>
#include <batten/app/stokes_entries.h>
#include <batten/app/toml_entries.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

constexpr int digits = 10;

/// An inline or empty stand-in for a table that may be left out.
const TomlValue& table_or_empty(const TomlEntries& entries, const std::string& key) {
  static const TomlValue empty;
  const TomlValue* const found = entries.find(key);
  return found ? *found : empty;
}

enum class Kind { Poisson, Plate, Stokes };
constexpr const char* kinds_text = "\"poisson\", \"plate\" or \"stokes\"";

Kind kind_of(const TomlValue& entry) {
  static constexpr std::array kinds = {"poisson", "plate", "stokes"};  // in the order of Kind
  if (entry.kind != TomlValue::Kind::Text)
    refuse(entry, std::string(kinds_text) + " is expected, found " + found_text(entry));
  const auto found = std::find(kinds.begin(), kinds.end(), entry.text);
  if (found != kinds.end()) return static_cast<Kind>(found - kinds.begin());
  refuse(entry, "unknown problem \"" + entry.text + "\"; did you mean \"" + nearest_name(entry.text, kinds) +
                    "\"? Known are " + name_list(kinds));
}

int degree_of(const TomlEntries& file, Kind kind) {
  constexpr int usual = 3, most = 5;
  const TomlValue* const entry = file.find("degree");
  if (!entry) return usual;
  const int least = kind == Kind::Poisson ? 1 : 2;
  const double degree = constant_of(*entry);
  for (int d = least; d <= most; ++d)
    if (degree == d) return d;
  const std::string whose = kind == Kind::Plate ? " for a plate" : kind == Kind::Stokes ? " for a flow" : "";
  refuse(*entry, "a degree from " + std::to_string(least) + " to " + std::to_string(most) + " is expected" + whose +
                     ", found " + number_text(degree, digits));
}

/// Throws InvalidInput if there is not enough memory for so many cells.
void expect_room(const TomlValue& cells, const SolveSize& size) {
  try {
    check_memory(size);
  } catch (const InvalidInput& error) {
    refuse(cells, error.what());
  }
}

bool varies(const Conduction& material) { return !material.k.is_constant() || !material.c.is_constant(); }

bool varies(const KirchhoffPlate& material) {
  return !material.rigidity.is_constant() || !material.foundation.is_constant() || !material.tension.is_constant();
}

Rectangle region_of(const TomlEntries& file, int degree) {
  constexpr const char* range = "a range [lower, upper]";
  const auto x = range_of(file.require("x", range)), y = range_of(file.require("y", range));
  const TomlValue& cells = file.require("cells", "the numbers of cells [NX, NY]");
  pair_of(cells, "the numbers of cells [NX, NY]");
  const int nx = whole_number_of(cells.items[0], 2), ny = whole_number_of(cells.items[1], 2);
  expect_room(cells, {static_cast<double>(nx), static_cast<double>(ny), degree});
  return {Interval(x[0], x[1], nx), Interval(y[0], y[1], ny)};
}

/// What stands under a key that may be left out.
void read_field(const TomlEntries& entries, const char* key, const FieldReader& fields, Sign sign, Field& field) {
  if (const TomlValue* const entry = entries.find(key)) field = fields.read(*entry, places_in(fields.region()), sign);
}

KirchhoffPlate plate_of(const TomlValue& table, const FieldReader& fields) {
  static constexpr std::array known = {"D", "nu", "foundation", "tension"};
  const TomlEntries entries(table, known);
  KirchhoffPlate plate;
  read_field(entries, "D", fields, Sign::Positive, plate.rigidity);
  read_field(entries, "foundation", fields, Sign::NotNegative, plate.foundation);
  read_field(entries, "tension", fields, Sign::NotNegative, plate.tension);
  if (const TomlValue* const entry = entries.find("nu")) {
    constexpr double least = -1, most = 0.5;
    plate.poisson_ratio = constant_of(*entry);
    if (!(plate.poisson_ratio > least && plate.poisson_ratio <= most))
      refuse(*entry, "Poisson's ratio must lie in (-1, 0.5], found " + number_text(plate.poisson_ratio, digits));
  }
  return plate;
}

Conduction conduction_of(const TomlValue& table, const FieldReader& fields) {
  static constexpr std::array known = {"k", "c"};
  const TomlEntries entries(table, known);
  Conduction conduction;
  read_field(entries, "k", fields, Sign::Positive, conduction.k);
  read_field(entries, "c", fields, Sign::NotNegative, conduction.c);
  return conduction;
}

ModeRequest modes_of(const TomlValue& table, const FieldReader& fields) {
  static constexpr std::array known = {"count", "density"};
  const TomlEntries entries(table, known);
  ModeRequest modes;
  if (const TomlValue* const count = entries.find("count")) {
    constexpr double cells_for_each = 8;  // fewer do not resolve the highest mode
    const double most = std::floor(fields.region().x.cells() / cells_for_each * fields.region().y.cells());
    modes.count = whole_number_of(*count, 1);
    if (modes.count > most)
      refuse(*count, "at most " + number_text(most, digits) +
                         " modes are found on these cells, one for each 8, found " + std::to_string(modes.count));
  }
  read_field(entries, "density", fields, Sign::Positive, modes.density);
  return modes;
}

/// The end and the step of the motion.
void read_times(const TomlEntries& entries, Motion& motion) {
  constexpr double most_steps = 99999;  // the names of the files have five digits at most
  const TomlValue &end = entries.require("end", "the last time"), &step = entries.require("step", "a time step");
  motion.end = constant_of(end);
  motion.step = constant_of(step);
  if (!(motion.step > 0)) refuse(step, "must be positive, found " + number_text(motion.step, digits));
  if (!(motion.end >= motion.step))
    refuse(end, "must not be less than the step " + number_text(motion.step, digits) + ", found " +
                    number_text(motion.end, digits));
  if (motion.end / motion.step > most_steps)
    refuse(step, "makes " + number_text(motion.end / motion.step) + " steps, of which each is a file; at most " +
                     number_text(most_steps, digits) + " are made");
}

Motion motion_of(const TomlValue& table, bool plate, const FieldReader& fields) {
  static constexpr std::array of_plates = {"end", "step", "initial", "velocity", "damping", "density"};
  static constexpr std::array of_heat = {"end", "step", "initial", "density"};
  const TomlEntries entries = plate ? TomlEntries(table, of_plates) : TomlEntries(table, of_heat);
  Motion motion;
  read_times(entries, motion);
  read_field(entries, "initial", fields, Sign::Any, motion.initial);
  read_field(entries, "velocity", fields, Sign::Any, motion.velocity);
  read_field(entries, "density", fields, Sign::Positive, motion.density);
  if (const TomlValue* const damping = entries.find("damping")) {
    motion.damping = constant_of(*damping);
    if (!(motion.damping >= 0)) refuse(*damping, "must not be negative, found " + number_text(motion.damping, digits));
  }
  return motion;
}

IterationLimits limits_of(const TomlValue& table) {
  static constexpr std::array known = {"accuracy"};
  const TomlEntries entries(table, known);
  IterationLimits limits;
  if (const TomlValue* const accuracy = entries.find("accuracy")) {
    limits.accuracy = constant_of(*accuracy);
    if (!(limits.accuracy > 0 && limits.accuracy < 1))
      refuse(*accuracy, "must lie between 0 and 1, found " + number_text(limits.accuracy, digits));
  }
  return limits;
}

/// What a plate or Poisson problem is made of, and what is asked of it.
void read_boundary_problem(const TomlEntries& entries, bool plate, const FieldReader& fields, ProblemFile& result) {
  BoundaryProblem& problem = result.problem;
  problem.sides = sides_of(entries.require("sides", "a table [sides] with left, right, bottom, top"), plate, fields);
  const TomlValue& material = table_or_empty(entries, "material");
  if (plate) {
    problem.material = plate_of(material, fields);
  } else {
    problem.material = conduction_of(material, fields);
  }
  const bool stores_stencils = std::visit([](const auto& m) { return varies(m); }, problem.material);
  expect_room(*entries.find("cells"),
              {static_cast<double>(fields.region().x.cells()), static_cast<double>(fields.region().y.cells()),
               problem.degree, stores_stencils});
  problem.loads = loads_of(table_or_empty(entries, "load"), plate, fields);
  problem.supports = supports_of(table_or_empty(entries, "supports"), plate, fields);
  const TomlValue *const modes = entries.find("modes"), *const time = entries.find("time");
  if (modes && time) refuse(*time, "is there beside [modes]; a file asks for modes or for motion, not for both");
  if (modes) result.modes = modes_of(*modes, fields);
  if (time) result.motion = motion_of(*time, plate, fields);
}

ProblemFile problem_of(const TomlValue& file, const std::filesystem::path& folder) {
  static constexpr std::array known = {"problem", "x",     "y",        "cells", "degree", "material",
                                       "load",    "sides", "supports", "modes", "time",   "solver"};
  const TomlEntries entries(file, known);
  const Kind kind = kind_of(entries.require("problem", kinds_text));
  const int degree = degree_of(entries, kind);
  const FieldReader fields(region_of(entries, degree), folder);
  // Nothing that throws stands in these braces: g++ 12 would destroy the region twice.
  ProblemFile result{.problem = {.material = {}, .region = fields.region(), .degree = degree}};
  result.limits = limits_of(table_or_empty(entries, "solver"));
  if (kind == Kind::Stokes) {
    result.flow = stokes_of(entries, degree, fields);
    result.problem = stream_function_problem(*result.flow);
  } else {
    read_boundary_problem(entries, kind == Kind::Plate, fields, result);
  }
  return result;
}

}  // namespace

ProblemFile read_problem(const std::filesystem::path& file) { return problem_of(read_toml(file), file.parent_path()); }

ProblemFile parse_problem(std::string_view text, const std::string& name) {
  return problem_of(parse_toml(text, name), "");
}

}  // namespace batten
