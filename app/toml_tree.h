// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// A value of a TOML file, and where it stands.
struct TomlValue {
  enum class Kind { Number, Text, Boolean, Date, Array, Table };
  Kind kind = Kind::Table;
  std::string key;           ///< its own, in the table that holds it
  std::string path;          ///< "sides.left", "load.points[1].x", the first item being 0; empty for the whole file
  std::string file;          ///< the name of the file as messages give it
  int line = 0, column = 0;  ///< of the value, from 1
  int key_line = 0, key_column = 0;  ///< of its key, if it has one
  double number = 0;
  bool is_whole = false;         ///< the number is written without a point
  std::string text;              ///< of a text; "true" or "false"
  std::vector<TomlValue> items;  ///< of an array; of a table in the order of the file
};

/// Reads a TOML file. Throws IoError if it cannot be read, InvalidInput with file, line and column if it is not TOML.
TomlValue read_toml(const std::filesystem::path& path);

/// The same for a text that stands in no file; `name` stands for that of the file in messages.
TomlValue parse_toml(std::string_view text, const std::string& name);

/// Throws InvalidInput: "FILE:LINE:COLUMN: PATH: text".
[[noreturn]] void refuse(const TomlValue& value, const std::string& text);

/// What stands there, for messages: "the number 3", "the text 'abc'", "a table".
std::string found_text(const TomlValue& value);

}  // namespace batten
