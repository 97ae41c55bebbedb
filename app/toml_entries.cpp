// SPDX-License-Identifier: MIT
#include <batten/app/expression_entry.h>
#include <batten/app/nearest_name.h>
#include <batten/app/toml_entries.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace batten {
namespace {

constexpr int digits = 10;

std::string name_of(const TomlValue& table) { return table.path.empty() ? "the file" : '[' + table.path + ']'; }

[[noreturn]] void refuse_key(const TomlValue& item, const TomlValue& table, std::span<const char* const> known) {
  throw InvalidInput(item.file + ':' + std::to_string(item.key_line) + ':' + std::to_string(item.key_column) +
                     ": unknown key '" + item.key + "' in " + name_of(table) + "; did you mean '" +
                     nearest_name(item.key, known) + "'? Known are " + name_list(known));
}

}  // namespace

TomlEntries::TomlEntries(const TomlValue& table, std::span<const char* const> known) : table_(&table) {
  if (table.kind != TomlValue::Kind::Table)
    refuse(table, "a table with the keys " + name_list(known) + " is expected, found " + found_text(table));
  for (const TomlValue& item : table.items) {
    if (std::find(known.begin(), known.end(), std::string_view(item.key)) == known.end())
      refuse_key(item, table, known);
  }
}

const TomlValue* TomlEntries::find(const std::string& key) const {
  const auto found =
      std::find_if(table_->items.begin(), table_->items.end(), [&](const TomlValue& item) { return item.key == key; });
  return found == table_->items.end() ? nullptr : &*found;
}

const TomlValue& TomlEntries::require(const std::string& key, const std::string& what) const {
  if (const TomlValue* const found = find(key)) return *found;
  refuse(*table_, "the key '" + key + "' is missing; " + what + " is expected");
}

double constant_of(const TomlValue& value) {
  double number = value.number;
  if (value.kind == TomlValue::Kind::Text) {
    const Expression expression = expression_of(value);
    if (!expression.is_constant())
      refuse(value, "a constant is expected, found an expression in x or y, " + found_text(value));
    number = expression(0, 0);
  } else if (value.kind != TomlValue::Kind::Number) {
    refuse(value, "a number or a constant expression is expected, found " + found_text(value));
  }
  if (!std::isfinite(number)) refuse(value, "a finite number is expected, found " + number_text(number));
  return number;
}

int whole_number_of(const TomlValue& value, int least) {
  const double number = constant_of(value);
  constexpr int most = std::numeric_limits<int>::max() / 2;
  if (number != std::floor(number) || number < least || number > most)
    refuse(value, "a whole number of at least " + std::to_string(least) + " is expected, found " +
                      number_text(number, digits));
  return static_cast<int>(number);
}

std::array<double, 2> pair_of(const TomlValue& value, const std::string& what) {
  if (value.kind != TomlValue::Kind::Array || value.items.size() != 2)
    refuse(value, what + " is expected, found " + found_text(value));
  return {constant_of(value.items[0]), constant_of(value.items[1])};
}

std::array<double, 2> range_of(const TomlValue& value) {
  const auto [lower, upper] = pair_of(value, "a range [lower, upper]");
  if (!(lower < upper))
    refuse(value, "the lower end must be less than the upper, found [" + number_text(lower, digits) + ", " +
                      number_text(upper, digits) + "]");
  return {lower, upper};
}

void expect_tables(const TomlValue& value, const std::string& example) {
  const bool is_array = value.kind == TomlValue::Kind::Array;
  if (!is_array || std::any_of(value.items.begin(), value.items.end(),
                               [](const TomlValue& item) { return item.kind != TomlValue::Kind::Table; }))
    refuse(value, "an array of tables [{" + example + "}, ...] is expected, found " +
                      (is_array ? "other items in it" : found_text(value)));
}

}  // namespace batten
