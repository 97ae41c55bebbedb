// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/toml_tree.h>

#include <array>
#include <span>
#include <string>

namespace batten {

/// The entries of a table, of which all keys are known.
class TomlEntries {
public:
  /// Throws InvalidInput for a key that is not among `known`, with its line and the nearest known key; and if `table`
  /// is no table. It must outlive this.
  TomlEntries(const TomlValue& table, std::span<const char* const> known);

  /// nullptr if there is no such key.
  const TomlValue* find(const std::string& key) const;
  /// Throws InvalidInput if there is no such key; `what` says what it must hold.
  const TomlValue& require(const std::string& key, const std::string& what) const;
  const TomlValue& table() const { return *table_; }

private:
  const TomlValue* table_;
};

/// A number, or what a text says that is a constant expression ("2*pi"); finite. Throws InvalidInput.
double constant_of(const TomlValue& value);

/// A whole number that is at least `least`. Throws InvalidInput.
int whole_number_of(const TomlValue& value, int least);

/// Two constants [a, b]; `what` names them in messages. Throws InvalidInput.
std::array<double, 2> pair_of(const TomlValue& value, const std::string& what);

/// Two constants [a, b] with a < b. Throws InvalidInput.
std::array<double, 2> range_of(const TomlValue& value);

/// Throws InvalidInput unless the value is an array of tables: [{...}, {...}].
void expect_tables(const TomlValue& value, const std::string& example);

}  // namespace batten
