// SPDX-License-Identifier: MIT
#include <batten/app/grid_text.h>
#include <batten/domains/number_text.h>

namespace batten {
namespace {

std::string interval_text(const Interval& interval) {
  return number_text(interval.lower(), 6) + " to " + number_text(interval.upper(), 6);
}

}  // namespace

std::string grid_text(const Rectangle& region, int degree, std::size_t unknowns) {
  return std::to_string(region.x.cells()) + " x " + std::to_string(region.y.cells()) + " cells of degree " +
         std::to_string(degree) + " on x " + interval_text(region.x) + ", y " + interval_text(region.y) + ", " +
         std::to_string(unknowns) + " unknowns";
}

}  // namespace batten
