// SPDX-License-Identifier: MIT
#include <batten/app/nearest_name.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace batten {
namespace {

std::string small_letters(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);  // distances of the first letters of a to all beginnings of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string nearest_name(std::string_view word, std::span<const char* const> names) {
  const std::string wanted = small_letters(word);
  const auto distance = [&](const char* name) { return edit_distance(wanted, small_letters(name)); };
  const auto nearest = std::min_element(names.begin(), names.end(),
                                        [&](const char* a, const char* b) { return distance(a) < distance(b); });
  return nearest == names.end() ? "" : *nearest;
}

std::string name_list(std::span<const char* const> names) {
  std::string list;
  for (const char* const name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

}  // namespace batten
