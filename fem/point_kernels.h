// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/grid_ranges.h>

#include <array>
#include <cstddef>
#include <span>

namespace batten {

/// Values at one point of the degree + 1 functions in x and in y that live in its cell; the rest is 0.
struct PointRow {
  int first_x = 0, first_y = 0;
  std::array<double, 6> x{}, y{};
};

/// Where a grid of coefficients lies in memory and how many functions meet at a point.
struct PointGrid {
  std::ptrdiff_t stride = 0;  ///< coefficients in a row
  int functions = 4;          ///< degree + 1 in each direction, 2 to 6
};

/// out[i] = Σ_j b_i[j] c_j for the given rows.
void point_values(const PointGrid& grid, std::span<const PointRow> rows, const double* c, double* out);
/// c += Σ_i v_i b_i
void add_point_values(const PointGrid& grid, std::span<const PointRow> rows, const double* v, double* c);
/// out += factor Σ_i w_i b_i (b_i · c), in the rows `within` of out only.
void add_point_products(const PointGrid& grid, std::span<const PointRow> rows, const double* w, double factor,
                        const double* c, double* out, RowRange within);
/// The same for rows that go in pairs, two after each other: out += factor Σ_ij w_ij b_i (b_j · c), w_ij the entries of
/// the blocks [[w_2k, x_k], [x_k, w_2k+1]].
struct PairPointers {
  const double *w, *x;
};
void add_pair_products(const PointGrid& grid, std::span<const PointRow> rows, const PairPointers& weights,
                       double factor, const double* c, double* out, RowRange within);

/// Sum of the products of one cell's points: entry [b][f][a][e] is Σ_i w_i y_b y_f x_a x_e, for b <= f; functions^4
/// entries are used.
using CellSum = std::array<double, 1296>;
void add_to_cell_sum(int functions, std::span<const PointRow> rows, std::span<const double> w, CellSum& sum);
/// What numbers x beside a pair's weights add: that of x (b_0 b_1^T + b_1 b_0^T).
void add_pair_to_cell_sum(int functions, const PointRow& b_0, const PointRow& b_1, double x, CellSum& sum);

}  // namespace batten
