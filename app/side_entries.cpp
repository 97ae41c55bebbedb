// SPDX-License-Identifier: MIT
#include <batten/app/nearest_name.h>
#include <batten/app/side_entries.h>
#include <batten/app/toml_entries.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace batten {
namespace {

constexpr std::array words = {"simply-supported", "clamped", "free", "symmetry", "periodic"};
constexpr std::array side_names = {"left", "right", "bottom", "top"};

const char* what_a_side_is(bool is_plate) {
  if (!is_plate) return "\"free\", \"symmetry\", \"periodic\", {value = ...} or {normal = ...}";
  return "\"simply-supported\", \"clamped\", \"free\", \"symmetry\", \"periodic\", {value = ...}, {normal = ...} or "
         "{value = ..., normal = ...}";
}

Side named_side(const TomlValue& entry, bool is_plate) {
  const std::string& word = entry.text;
  if (word == "free") return Side::free();
  if (word == "symmetry") return Side::symmetry();
  if (word == "periodic") return Side::repeated();
  if (word == "simply-supported" || word == "clamped") {
    if (!is_plate) refuse(entry, "\"" + word + "\" is for plates; a Poisson problem takes {value = 0}");
    return word == "clamped" ? Side::clamped() : Side::simply_supported();
  }
  refuse(entry, "unknown side \"" + word + "\"; did you mean \"" + nearest_name(word, words) + "\"? A side is " +
                    what_a_side_is(is_plate));
}

Side prescribed_side(const TomlValue& entry, bool is_plate, const FieldReader& fields, std::span<const Place> places) {
  static constexpr std::array known = {"value", "normal"};
  const TomlEntries entries(entry, known);
  const TomlValue *const value = entries.find("value"), *const normal = entries.find("normal");
  if (!value && !normal) refuse(entry, "is empty; {value = ...} or {normal = ...} is expected, or \"free\"");
  if (value && normal && !is_plate)
    refuse(entry, "is over-determined: a Poisson problem takes the value or the normal derivative, not both");
  Side side;
  if (value) side.value = fields.read(*value, places);
  if (normal) side.normal = fields.read(*normal, places);
  return side;
}

Side side_of(const TomlValue& entry, bool is_plate, const FieldReader& fields, std::span<const Place> places) {
  if (entry.kind == TomlValue::Kind::Text) return named_side(entry, is_plate);
  if (entry.kind == TomlValue::Kind::Table) return prescribed_side(entry, is_plate, fields, places);
  refuse(entry, std::string(what_a_side_is(is_plate)) + " is expected, found " + found_text(entry));
}

std::vector<Place> places_of(std::string_view side, const Rectangle& region) {
  const double left = region.x.lower(), right = region.x.upper();
  const double bottom = region.y.lower(), top = region.y.upper();
  if (side == "left") return places_on({left, bottom}, {left, top});
  if (side == "right") return places_on({right, bottom}, {right, top});
  if (side == "bottom") return places_on({left, bottom}, {right, bottom});
  return places_on({left, top}, {right, top});
}

}  // namespace

Sides sides_of(const TomlValue& table, bool is_plate, const FieldReader& fields) {
  const TomlEntries entries(table, side_names);
  std::array<Side, side_names.size()> sides;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const TomlValue& entry = entries.require(side_names[s], what_a_side_is(is_plate));
    sides[s] = side_of(entry, is_plate, fields, places_of(side_names[s], fields.region()));
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const std::size_t opposite = s ^ 1;  // left and right, bottom and top stand side by side
    if (sides[s].periodic && !sides[opposite].periodic)
      refuse(*entries.find(side_names[s]),
             std::string("is periodic, so ") + side_names[opposite] + " must be \"periodic\" too");
  }
  return {sides[0], sides[1], sides[2], sides[3]};
}

}  // namespace batten
