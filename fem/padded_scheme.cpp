// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/polyharmonic_coefficients.h>
#include <batten/domains/errors.h>
#include <batten/fem/padded_scheme.h>
#include <batten/fem/variational_scheme.h>

#include <string>

namespace batten {
namespace {

void check_small(const VariationalDomain& small) {
  const auto fits = [](const Breakpoints& b) { return b.is_uniform() && b.cells() >= 4 && b.cells() % 2 == 0; };
  if (!small.coefficient.empty() || !small.inside.empty() || !fits(small.x) || (small.y && !fits(*small.y)))
    throw InvalidInput(
        "PaddedScheme: expected equal cells, at least 4 and an even number in each direction, without coefficient and "
        "mask, found " +
        std::to_string(small.x.cells()) + " x " + std::to_string(small.rows()) + " cells");
}

}  // namespace

PaddedScheme::PaddedScheme(const VariationalDomain& small) {
  check_small(small);
  const auto levels = spline_levels(small, 1);
  S_ = VariationalScheme(energy_levels(levels), 0).matrix();
  x_ = {small.x.cells() / 2, small.degree};
  if (small.y) y_ = {small.y->cells() / 2, small.degree};
}

/// The fine function of the small domain whose rule serves function i of a domain of n coarse cells, and by how many
/// coarse functions it moves: those near an end keep their distance to it, those inside take the middle's.
std::array<int, 2> PaddedScheme::Direction::place(int i, int n) const {
  if (cells == 0) return {0, 0};
  const int small = fine(cells), large = fine(n), middle = (small - 1) / 2;
  if (i <= middle) return {i, 0};
  if (large - 1 - i <= middle) return {i - (large - small), n - cells};
  const int inner = middle + (i - middle) % 2;
  return {inner, (i - inner) / 2};
}

PaddedScheme::Rule PaddedScheme::rule(std::array<int, 2> function, std::array<int, 2> cells) const {
  const auto x = x_.place(function[0], cells[0]), y = y_.place(function[1], cells[1]);
  return {{x[1], y[1]}, S_.row(x[0] + y[0] * x_.fine(x_.cells)).transpose()};
}

Eigen::VectorXd PaddedScheme::apply(const Eigen::VectorXd& p, std::array<int, 2> cells) const {
  if (cells[0] < x_.cells || cells[1] < y_.cells)
    throw InvalidInput("PaddedScheme::apply: expected at least " + std::to_string(x_.cells) + " x " +
                       std::to_string(y_.cells) + " coarse cells, found " + std::to_string(cells[0]) + " x " +
                       std::to_string(cells[1]));
  const int columns = x_.cells == 0 ? 1 : cells[0] + x_.degree, rows = y_.cells == 0 ? 1 : cells[1] + y_.degree;
  if (p.size() != static_cast<Eigen::Index>(columns) * rows)
    throw InvalidInput("PaddedScheme::apply: expected " + std::to_string(columns) + " x " + std::to_string(rows) +
                       " coefficients, found " + std::to_string(p.size()));
  const int nx = x_.fine(cells[0]), ny = y_.fine(cells[1]), wx = x_.coarse(), wy = y_.coarse();
  Eigen::VectorXd result(static_cast<Eigen::Index>(nx) * ny);
  for_blocks(RowBlocks(ny, nx * wx * wy), [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int i = 0; i < nx; ++i) {
        const auto x = x_.place(i, cells[0]), y = y_.place(j, cells[1]);
        const auto weights = S_.row(x[0] + y[0] * x_.fine(x_.cells));
        double sum = 0;
        for (int b = 0; b < wy; ++b)
          sum += weights.segment(b * wx, wx).dot(p.segment(x[1] + (y[1] + b) * static_cast<Eigen::Index>(columns), wx));
        result[i + j * static_cast<Eigen::Index>(nx)] = sum;
      }
  });
  return result;
}

double harmonic_quadrant_entry(int i1, int j1, int i2, int j2) {
  double sum = 0;
  for (int a : {-1, 1})
    for (int b : {-1, 1})
      if ((a > 0 || i2 > 0) && (b > 0 || j2 > 0)) sum += polyharmonic_coefficient(1, i1 + 2 * a * i2, j1 + 2 * b * j2);
  return sum;
}

}  // namespace batten
