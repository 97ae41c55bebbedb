// SPDX-License-Identifier: MIT
#include <batten/app/point_columns.h>
#include <batten/io/row_scanner.h>
#include <batten/io/text_source.h>

#include <algorithm>
#include <filesystem>

namespace batten {

std::vector<std::string> point_columns(const std::string& file) {
  const std::vector<std::string> named = {"x", "y"};
  if (file == "-" || !std::filesystem::is_regular_file(file)) return named;
  const TextSource source(file);
  std::string_view text = source.text();
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  RowScanner scanner(text, find_delimiter(text));
  std::vector<std::string> header;
  if (scanner.next()) {
    for (const std::string_view field : scanner.fields()) header.push_back(unquote(field));
  }
  const bool has_named = std::all_of(named.begin(), named.end(), [&](const std::string& name) {
    return std::find(header.begin(), header.end(), name) != header.end();
  });
  return has_named ? named : std::vector<std::string>{"1", "2"};
}

}  // namespace batten
