// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/measurement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace batten {
namespace {

using Row = std::vector<Eigen::Triplet<double>>;  // of one direction or of M

/// In one direction, the weights of the fine functions in the values at given positions.
std::vector<Row> values_at(const KnotSplines& fine, const std::vector<double>& positions) {
  std::vector<Row> result;
  result.reserve(positions.size());
  for (double t : positions) {
    const int cell = fine.cell_of(t);
    const auto n = fine.at(cell, t - fine.breakpoints().positions()[static_cast<std::size_t>(cell)]);
    Row row;
    for (int a = 0; a <= fine.degree(); ++a)
      if (n[a] != 0) row.emplace_back(0, cell + a, n[a]);
    result.push_back(row);
  }
  return result;
}

/// The values themselves are asked where knots meet, and so must not see a function that ends there.
std::vector<Row> without_rounding(std::vector<Row> rows) {
  for (Row& row : rows) std::erase_if(row, [](const auto& entry) { return std::abs(entry.value()) < 1e-14; });
  return rows;
}

std::vector<double> centres(const KnotSplines& coarse, const KnotSplines& fine) {
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(coarse.cells()));
  for (int c = 0; c < coarse.cells(); ++c)
    result.push_back(fine.breakpoints().positions()[static_cast<std::size_t>(fine.breakpoints().first_child(c) + 1)]);
  return result;
}

std::vector<Row> values_in_direction(const KnotSplines& coarse, const KnotSplines& fine, Measurement kind) {
  if (coarse.degree() == 0) return {Row{{0, 0, 1.}}};  // the idle direction of an interval
  return without_rounding(
      values_at(fine, kind == Measurement::GrevilleValues ? coarse.greville() : centres(coarse, fine)));
}

std::string place_text(int i, int j) { return "(" + std::to_string(i) + ", " + std::to_string(j) + ")"; }

/// Entries of the place (i, j); nothing where the domain has no such place.
Row value_entries(const SplineLevel& coarse, const SplineLevel& fine, bool greville, std::array<int, 2> place,
                  const Row& x, const Row& y) {
  const auto [i, j] = place;
  if (greville ? coarse.function(i, j) < 0 : !coarse.is_inside(i, j)) return {};
  Row row;
  for (const auto& b : y)
    for (const auto& a : x) {
      const int function = fine.function(static_cast<int>(a.col()), static_cast<int>(b.col()));
      if (function < 0)
        throw InvalidInput("measurement_matrix: expected every place to lie in the domain, found place " +
                           place_text(i, j) +
                           " outside (Greville values need degree 1 and a mask of whole coarse "
                           "cells; centre values or cell averages take any mask of an even number of cells)");
      row.emplace_back(0, function, a.value() * b.value());
    }
  return row;
}

/// Average over the children of coarse cell (I, J) that meet the domain.
Row average_entries(const SplineLevel& coarse, const SplineLevel& fine, int I, int J) {
  if (!coarse.is_inside(I, J)) return {};
  const auto& bx = fine.x().breakpoints();
  const auto& by = fine.y().breakpoints();
  const int first_y = fine.is_interval() ? 0 : by.first_child(J),
            last_y = fine.is_interval() ? 1 : by.first_child(J + 1);
  const int side = fine.x().degree() + 1;
  Row row;
  double area = 0;
  for (int cy = first_y; cy < last_y; ++cy)
    for (int cx = bx.first_child(I); cx < bx.first_child(I + 1); ++cx) {
      if (!fine.is_inside(cx, cy)) continue;
      const auto w = fine.cell_moments(cx, cy, {0, 0});
      for (int a = 0; a < fine.local_size(); ++a)
        row.emplace_back(0, fine.function(cx + a % side, cy + a / side), w[a]);
      area += w.sum();
    }
  for (auto& entry : row) entry = {0, entry.col(), entry.value() / area};
  return row;
}

}  // namespace

MeasurementMatrix measurement_matrix(const SplineLevel& coarse, const SplineLevel& fine, Measurement kind) {
  if (kind == Measurement::CellAverages && fine.x().degree() != 1)
    throw InvalidInput("measurement_matrix: expected degree 1 for cell averages, found " +
                       std::to_string(fine.x().degree()) + " (use centre values)");
  const bool greville = kind == Measurement::GrevilleValues;
  MeasurementMatrix result;
  result.places_x = greville ? coarse.x().size() : coarse.x().cells();
  result.places_y = greville ? coarse.y().size() : coarse.y().cells();
  const auto x = values_in_direction(coarse.x(), fine.x(), kind), y = values_in_direction(coarse.y(), fine.y(), kind);
  Row entries;
  for (int j = 0; j < result.places_y; ++j)
    for (int i = 0; i < result.places_x; ++i) {
      const Row row = kind == Measurement::CellAverages
                          ? average_entries(coarse, fine, i, j)
                          : value_entries(coarse, fine, greville, {i, j}, x[static_cast<std::size_t>(i)],
                                          y[static_cast<std::size_t>(j)]);
      const int number = static_cast<int>(result.place.size());
      result.row.push_back(row.empty() ? -1 : number);
      if (!row.empty()) result.place.push_back(i + j * result.places_x);
      for (const auto& e : row) entries.emplace_back(number, e.col(), e.value());
    }
  result.M.resize(static_cast<Eigen::Index>(result.place.size()), fine.size());
  result.M.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::vector<int> private_functions(const MeasurementMatrix::Matrix& M) {
  std::vector<int> rows_of(static_cast<std::size_t>(M.cols()), 0), result;
  using Entry = MeasurementMatrix::Matrix::InnerIterator;
  for (int r = 0; r < M.rows(); ++r)
    for (Entry e(M, r); e; ++e) ++rows_of[static_cast<std::size_t>(e.col())];
  for (int r = 0; r < M.rows(); ++r) {
    int best = -1;
    double largest = 0;
    for (Entry e(M, r); e; ++e)
      if (rows_of[static_cast<std::size_t>(e.col())] == 1 && std::abs(e.value()) > largest * (1 + 1e-9)) {
        best = static_cast<int>(e.col());
        largest = std::abs(e.value());
      }
    if (best < 0)
      throw InvalidInput(
          "private_functions: expected a function that only one measurement sees, found none for "
          "measurement " +
          std::to_string(r));
    result.push_back(best);
  }
  return result;
}

std::vector<PlaceRange> places_around(const KnotSplines& coarse, Measurement kind, int layers) {
  std::vector<PlaceRange> result;
  const auto places = coarse.greville();
  const auto t = coarse.breakpoints().positions();
  for (int c = 0; c < coarse.cells(); ++c) {
    const int first = std::max(0, c - layers), last = std::min(coarse.cells() - 1, c + layers);
    PlaceRange range = {first, last + 1};
    if (coarse.degree() > 0 && kind == Measurement::GrevilleValues) {
      const double lower = t[static_cast<std::size_t>(first)], upper = t[static_cast<std::size_t>(last + 1)];
      const double slack = 1e-9 * (upper - lower);
      range.end = last + 1 + coarse.degree();
      while (first > 0 && places[static_cast<std::size_t>(range.begin)] < lower - slack) ++range.begin;
      while (last + 1 < coarse.cells() && places[static_cast<std::size_t>(range.end - 1)] > upper + slack) --range.end;
    }
    result.push_back(range);
  }
  return result;
}

}  // namespace batten
