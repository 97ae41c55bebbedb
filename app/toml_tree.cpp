// SPDX-License-Identifier: MIT
#include <batten/app/toml_tree.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/io/number_reader.h>
#include <batten/io/text_source.h>

#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

namespace batten {
namespace {

int number_of(toml::source_index index) { return static_cast<int>(index); }

TomlValue::Kind kind_of(const toml::node& node) {
  if (node.is_table()) return TomlValue::Kind::Table;
  if (node.is_array()) return TomlValue::Kind::Array;
  if (node.is_string()) return TomlValue::Kind::Text;
  if (node.is_number()) return TomlValue::Kind::Number;
  return node.is_boolean() ? TomlValue::Kind::Boolean : TomlValue::Kind::Date;
}

TomlValue value_of(const toml::node& node, const std::string& path, const std::string& file) {
  TomlValue value;
  value.kind = kind_of(node);
  value.path = path;
  value.file = file;
  value.line = number_of(node.source().begin.line);
  value.column = number_of(node.source().begin.column);
  if (const auto* const text = node.as_string()) value.text = text->get();
  if (const auto* const truth = node.as_boolean()) value.text = truth->get() ? "true" : "false";
  if (node.is_number()) value.number = *node.value<double>();
  value.is_whole = node.is_integer();
  if (const auto* const array = node.as_array()) {
    for (const toml::node& item : *array)
      value.items.push_back(value_of(item, path + '[' + std::to_string(value.items.size()) + ']', file));
  }
  if (const auto* const table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      const std::string name(key.str());
      TomlValue item = value_of(child, path.empty() ? name : path + '.' + name, file);
      item.key = name;
      item.key_line = number_of(key.source().begin.line);
      item.key_column = number_of(key.source().begin.column);
      value.items.push_back(std::move(item));
    }
    std::sort(value.items.begin(), value.items.end(), [](const TomlValue& a, const TomlValue& b) {
      return std::tie(a.key_line, a.key_column) < std::tie(b.key_line, b.key_column);
    });
  }
  return value;
}

std::string place_of(const std::string& file, int line, int column) {
  return file + ':' + std::to_string(line) + ':' + std::to_string(column);
}

}  // namespace

TomlValue parse_toml(std::string_view text, const std::string& name) {
  try {
    return value_of(toml::parse(text), "", name);
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    throw InvalidInput(place_of(name, number_of(at.line), number_of(at.column)) +
                       ": is not TOML: " + std::string(error.description()));
  }
}

TomlValue read_toml(const std::filesystem::path& path) {
  const TextSource source(path);
  return parse_toml(source.utf8_text(), source.name());
}

void refuse(const TomlValue& value, const std::string& text) {
  if (value.path.empty()) throw InvalidInput(value.file + ": " + text);
  throw InvalidInput(place_of(value.file, value.line, value.column) + ": " + value.path + ": " + text);
}

std::string found_text(const TomlValue& value) {
  constexpr int digits = 10;
  switch (value.kind) {
    case TomlValue::Kind::Number:
      return "the number " + number_text(value.number, digits);
    case TomlValue::Kind::Text:
      return "the text " + quoted_excerpt(value.text);
    case TomlValue::Kind::Boolean:
      return value.text;
    case TomlValue::Kind::Date:
      return "a date or time";
    case TomlValue::Kind::Array:
      return "an array of " + std::to_string(value.items.size());
    case TomlValue::Kind::Table:
      break;
  }
  return "a table";
}

}  // namespace batten
