// SPDX-License-Identifier: MIT
#include <batten/app/flow_side_arguments.h>
#include <batten/app/nearest_name.h>
#include <batten/app/usage_error.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <sstream>

namespace batten {
namespace {

constexpr std::array<const char*, 4> names = {"left", "right", "bottom", "top"};
constexpr std::array<const char*, 6> wall_names = {"left", "right", "bottom", "top", "closed", "none"};
constexpr std::array<const char*, 3> axis_names = {"x", "y", "none"};
constexpr std::array<FlowSide FlowSides::*, 4> members = {&FlowSides::left, &FlowSides::right, &FlowSides::bottom,
                                                          &FlowSides::top};

/// The words of a list with commas, each one of the names.
std::vector<std::string> words_of(const char* option, const std::string& list, std::span<const char* const> allowed) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) {
    if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
      throw UsageError(std::string(option) + ": there is no '" + word + "'; did you mean '" +
                       nearest_name(word, allowed) + "'? Expected " + name_list(allowed) + " or some with commas");
    words.push_back(word);
  }
  return words;
}

void set(FlowSides& sides, std::size_t k, FlowSide kind, const char* option) {
  FlowSide& side = sides.*members[k];
  if (side != FlowSide::Free)
    throw UsageError(std::string(option) + ": the side " + names[k] + " is " + side_name(side) + " already");
  side = kind;
}

void set_walls(FlowSides& sides, const char* option, const std::string& list, FlowSide kind) {
  for (const std::string& word : words_of(option, list, wall_names))
    for (std::size_t k = 0; k < names.size(); ++k)
      if (word == "closed" || word == names[k]) set(sides, k, kind, option);
}

}  // namespace

void add_side_options(CLI::App& parser, FlowSideArguments& a, const std::string& group) {
  const auto add = [&](const char* name, std::string& target, const char* text, const char* values) {
    parser.add_option(name, target, text)->option_text(values)->group(group);
  };
  add("--walls", a.walls,
      "nothing flows through these sides: none (default), closed (all), or some of left,right,bottom,top", "SIDES");
  add("--no-slip", a.no_slip, "nothing moves at these sides: as --walls", "SIDES");
  add("--periodic", a.periodic, "what leaves at one side enters at the opposite one: x, y or x,y", "AXES");
}

FlowSides sides_of(const FlowSideArguments& arguments) {
  FlowSides sides;
  set_walls(sides, "--walls", arguments.walls, FlowSide::Wall);
  set_walls(sides, "--no-slip", arguments.no_slip, FlowSide::NoSlip);
  for (const std::string& word : words_of("--periodic", arguments.periodic, axis_names))
    for (std::size_t k = 0; k < names.size() && word != "none"; ++k)
      if ((word == "x") == (k < 2)) set(sides, k, FlowSide::Periodic, "--periodic");
  return sides;
}

const char* side_name(FlowSide side) {
  constexpr std::array<const char*, 4> texts = {"free", "wall", "no-slip", "periodic"};
  return texts[static_cast<std::size_t>(side)];
}

}  // namespace batten
