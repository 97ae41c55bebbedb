// SPDX-License-Identifier: MIT
#include <batten/bases/subdivide_flow.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace batten {
namespace {

struct Tap {
  int x, y;
  double weight;
};

std::vector<Tap> taps_of(const Mask2<double>& mask) {
  std::vector<Tap> taps;
  for (const Index<2>& i : indices_of<2>({mask.first(), mask.last()}))
    if (const double weight = mask[i]; weight != 0) taps.push_back({i[0], i[1], weight});
  return taps;
}

/// A coarse component and its mask. Its value (i, j) has the exponents 2 (i, j) + shift on the fine level.
struct Term {
  const Eigen::MatrixXd& coarse;
  Index<2> shift;
  std::vector<Tap> taps;
};

/// Adds to sum(m) what a term gives to the fine walls (first + 2 m, column).
void add_column(const Term& term, int first, int column, Eigen::VectorXd& sum) {
  for (const Tap& tap : term.taps) {
    const int x = first - term.shift[0] - tap.x, y = column - term.shift[1] - tap.y;
    if ((x & 1) == 0 && (y & 1) == 0) sum += tap.weight * term.coarse.col(y / 2).segment(x / 2, sum.size());
  }
}

/// The fine walls first .. first + size - 1.
Eigen::MatrixXd filtered(const std::vector<Term>& terms, const Index<2>& first, const Index<2>& size) {
  Eigen::MatrixXd fine(size[0], size[1]);
#pragma omp parallel for schedule(static)
  for (int j = 0; j < size[1]; ++j)
    for (int parity = 0; parity < 2; ++parity) {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero((size[0] - parity + 1) / 2);
      for (const Term& term : terms) add_column(term, first[0] + parity, first[1] + j, sum);
      fine.col(j)(Eigen::seqN(parity, sum.size(), Eigen::fix<2>)) = sum;
    }
  return fine;
}

/// One step of an open field.
StaggeredField refined(const FlowMasks<double>& masks, const StaggeredField& field) {
  const int lost = reach_in_cells(masks);
  const int nx = 2 * field.cells_x() - 2 * lost, ny = 2 * field.cells_y() - 2 * lost;
  if (nx < 1 || ny < 1)
    throw InvalidInput("subdivided: an open field of " + std::to_string(field.cells_x()) + " x " +
                       std::to_string(field.cells_y()) + " cells is too small for these masks, which take " +
                       std::to_string(lost) + " fine cells from each side");
  const double spacing = field.spacing / 2;
  const Index<2> of_u{0, 1}, of_v{1, 0};
  return {filtered({{field.u, of_u, taps_of(masks.s11)}, {field.v, of_v, taps_of(masks.s12())}}, {lost, lost},
                   {nx + 1, ny}),
          filtered({{field.u, of_u, taps_of(masks.s21)}, {field.v, of_v, taps_of(masks.s22())}}, {lost, lost},
                   {nx, ny + 1}),
          {field.start[0] + lost * spacing, field.start[1] + lost * spacing},
          spacing};
}

/// The largest |exponent|, twice.
int twice_reach(const Mask2<double>& mask) {
  int reach = 0;
  for (std::size_t axis : {0, 1})
    for (int i : {mask.first()[axis], mask.last()[axis]}) reach = std::max(reach, std::abs(2 * i + mask.half()[axis]));
  return reach;
}

void require_options(const StaggeredField& field, const FlowSubdivisionOptions& options) {
  require_field("subdivided", field);
  if (options.levels < 0)
    throw InvalidInput("subdivided: levels must not be negative, found " + std::to_string(options.levels));
  const double cells = std::ldexp(field.cells_x(), options.levels) * std::ldexp(field.cells_y(), options.levels);
  if (cells > 1 << 30)
    throw InvalidInput("subdivided: the result would have more than 2^30 cells, after " +
                       std::to_string(options.levels) + " levels");
}

}  // namespace

// Coarse walls that do not exist are nearest at -1 of the fine grid. A wall at `lost` meets none when lost - reach >
// -1.
int reach_in_cells(const FlowMasks<double>& masks) {
  return std::max(twice_reach(masks.s11), twice_reach(masks.s21)) / 2;
}

StaggeredField subdivided(const FlowMasks<double>& masks, const StaggeredField& field,
                          const FlowSubdivisionOptions& options) {
  require_options(field, options);
  if (options.levels == 0) return field;
  // A margin of so many cells as a step takes is renewed by it; another such margin beyond it doubles.
  const int lost = reach_in_cells(masks);
  StaggeredField fine = padded(field, options.sides == FieldSides::Zero ? 2 * lost : lost, options.sides);
  for (int k = 0; k < options.levels; ++k) fine = refined(masks, fine);
  return options.sides == FieldSides::Open ? fine : cropped(fine, lost);
}

}  // namespace batten
