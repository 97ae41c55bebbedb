// SPDX-License-Identifier: MIT
// A stranger's program: a plane through four points, found with Batten's libraries. Exits with 0 when it is right.
#include <batten/domains/errors.h>
#include <batten/fem/fit.h>
#include <batten/io/table.h>

#include <cmath>
#include <cstdlib>

namespace {

bool fits_a_plane() {
  batten::Observations points{{0, 1, 0, 1}, {0, 0, 1, 1}, {1, 3, 0, 2}, {}};  // z = 1 + 2 x - y
  const batten::Rectangle unit_square{{0, 1, 8}, {0, 1, 8}};
  const batten::FitResult fit = batten::fit_surface(points, unit_square, {.smoothing = batten::Smoothing::fixed(1e-3)});
  return std::abs(fit.solution.value(0.25, 0.5) - 1) < 1e-9;
}

bool reports_a_missing_file() {
  try {
    batten::read_table("no such file.csv", {});
    return false;
  } catch (const batten::IoError&) {
    return true;
  }
}

}  // namespace

int main() { return fits_a_plane() && reports_a_missing_file() ? EXIT_SUCCESS : EXIT_FAILURE; }
