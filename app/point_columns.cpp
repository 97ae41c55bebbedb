// SPDX-License-Identifier: MIT
#include <batten/app/point_columns.h>
#include <batten/io/row_scanner.h>
#include <batten/io/text_source.h>

#include <algorithm>
#include <filesystem>

namespace batten {

std::vector<std::string> first_row(const std::string& file) {
  if (file == "-" || !std::filesystem::is_regular_file(file)) return {};
  const TextSource source(file);
  const std::string_view text = source.utf8_text();
  RowScanner scanner(text, find_delimiter(text));
  std::vector<std::string> fields;
  if (scanner.next())
    for (const std::string_view field : scanner.fields()) fields.push_back(unquote(field));
  return fields;
}

std::vector<std::string> point_columns(const std::string& file) {
  const std::vector<std::string> named = {"x", "y"};
  const auto header = first_row(file);
  const bool has_named = std::all_of(named.begin(), named.end(), [&](const std::string& name) {
    return std::find(header.begin(), header.end(), name) != header.end();
  });
  return has_named || header.empty() ? named : std::vector<std::string>{"1", "2"};
}

}  // namespace batten
