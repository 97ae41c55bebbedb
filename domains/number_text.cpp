// SPDX-License-Identifier: MIT
#include <batten/domains/number_text.h>

#include <array>
#include <cstdio>

namespace batten {

std::string number_text(double value, int digits) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

std::string bytes_text(double bytes) {
  constexpr std::array units = {"kB", "MB", "GB", "TB", "PB", "EB"};
  constexpr double step = 1000;
  double amount = bytes / step;
  std::size_t unit = 0;
  for (; amount >= step && unit + 1 < units.size(); ++unit) amount /= step;
  if (amount >= step) return "more than 1000 EB";
  return number_text(amount, amount < 100 ? 2 : 3) + ' ' + units[unit];
}

}  // namespace batten
