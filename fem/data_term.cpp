// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/blossom.h>
#include <batten/bases/wavefront.h>
#include <batten/domains/errors.h>
#include <batten/fem/data_term.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace batten {
namespace {

/// Blocks of cell rows; the rows of coefficients that a block adds to reach `degree` rows into the next block.
RowBlocks cell_row_blocks(const SplineSpace& space) {
  return {space.y.interval().cells(), space.x.size(), std::max(4, space.y.degree())};
}

}  // namespace

// A counting sort by row, then by column within rows.
std::vector<std::size_t> cell_order(const GridPoints& p, const SplineSpace& space) {
  std::vector<std::uint64_t> cell(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    cell[i] = static_cast<std::uint64_t>(space.y.interval().cell_of(p.y[i])) << 32 |
              static_cast<std::uint64_t>(space.x.interval().cell_of(p.x[i]));
  std::vector<std::size_t> start(static_cast<std::size_t>(space.y.interval().cells()) + 1, 0), order(p.size());
  for (auto c : cell) ++start[(c >> 32) + 1];
  for (std::size_t r = 1; r < start.size(); ++r) start[r] += start[r - 1];
  auto next = start;
  for (std::size_t i = 0; i < p.size(); ++i) order[next[cell[i] >> 32]++] = i;
  for (std::size_t r = 0; r + 1 < start.size(); ++r)
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(start[r]),
              order.begin() + static_cast<std::ptrdiff_t>(start[r + 1]),
              [&](std::size_t a, std::size_t b) { return std::tie(cell[a], a) < std::tie(cell[b], b); });
  return order;
}

bool GridPoints::are_slopes() const {
  const auto sees_constants = [](Measured m) { return m == Measured::Value || m == Measured::Coefficient; };
  return !kind.empty() && std::none_of(kind.begin(), kind.end(), sees_constants);
}

bool GridPoints::have_coefficients() const {
  return std::find(kind.begin(), kind.end(), Measured::Coefficient) != kind.end();
}

bool GridPoints::have_slopes() const {
  const auto is_slope = [](Measured m) { return m == Measured::SlopeX || m == Measured::SlopeY; };
  return std::any_of(kind.begin(), kind.end(), is_slope);
}

DataTerm::DataTerm(const SplineSpace& space, const GridPoints& points, bool stored)
    : space_(space), points_(&points), stored_(stored || points.size() > space.size() || points.have_coefficients()) {
  const auto& y = space.y.interval();
  row_start_.assign(static_cast<std::size_t>(y.cells()) + 1, 0);
  for (double t : points.y) ++row_start_[static_cast<std::size_t>(y.cell_of(t)) + 1];
  for (std::size_t r = 1; r < row_start_.size(); ++r) row_start_[r] += row_start_[r - 1];
  if (stored_ && !points.have_coefficients()) return;  // blossoms cost more than to keep them
  std::vector<PointRow> rows(points.size());
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(points.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) rows[static_cast<std::size_t>(i)] = row(static_cast<std::size_t>(i));
  rows_ = std::move(rows);
}

PointRow DataTerm::row(std::size_t point) const {
  if (!rows_.empty()) return rows_[point];
  const Measured kind = points_->kind.empty() ? Measured::Value : points_->kind[point];
  const bool slope_x = kind == Measured::SlopeX, slope_y = kind == Measured::SlopeY;
  const bool is_coefficient = kind == Measured::Coefficient;
  const auto local = [&](const SplineBasis& basis, double t, bool is_slope) {
    return is_coefficient ? refined_coefficient(basis, t, points_->spacing) : basis.at(t, is_slope);
  };
  const auto x = local(space_.x, points_->x[point], slope_x), y = local(space_.y, points_->y[point], slope_y);
  PointRow result{x.first, y.first, {}, {}};
  result.x = x.values;
  result.y = y.values;
  if (slope_x)
    for (double& v : result.x) v /= space_.hx;
  if (slope_y)
    for (double& v : result.y) v /= space_.hy;
  return result;
}

PointRow DataTerm::absolute_row(std::size_t point) const {
  PointRow result = row(point);
  for (auto* part : {&result.x, &result.y})
    for (double& v : *part) v = std::abs(v);
  return result;
}

void DataTerm::add_absolute_adjoint(std::span<const double> v, std::span<double> c) const {
  for_alternating_blocks(cell_row_blocks(space_), [&](int begin, int end) {
    for (std::size_t i = first_point(begin); i < first_point(end); ++i) {
      const PointRow one = absolute_row(i);
      add_point_values(grid(), {&one, 1}, v.data() + i, c.data());
    }
  });
}

std::vector<double> DataTerm::compliance(std::span<const double> inverse) const {
  std::vector<double> result(size());
  if (size() == 0) return result;
  if (!points_->have_slopes()) {
    std::vector<double> ones(size(), 1.), sum(space_.size());
    add_adjoint(ones, sum);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] *= inverse[i];
    fill_images(space_, sum);
    values(sum, result);
    return result;
  }
  for_blocks(cell_row_blocks(space_), [&](int begin, int end) {
    for (std::size_t i = first_point(begin); i < first_point(end); ++i) {
      PointRow squares = row(i);
      for (auto* part : {&squares.x, &squares.y})
        for (double& v : *part) v *= v;
      point_values(grid(), {&squares, 1}, inverse.data(), result.data() + i);
    }
  });
  return result;
}

std::vector<double> DataTerm::lumped() const {
  const bool are_values = !points_->have_slopes();
  if (stored_ && (!are_values || are_paired_)) return stencil_.absolute_row_sums();
  std::vector<double> result(space_.size());
  if (stored_) {
    stencil_.add_product(1, std::vector<double>(result.size(), 1.), result);
    return result;
  }
  std::vector<double> weights = weights_.lumped();
  if (are_values) {
    add_adjoint(weights, result);
    return result;
  }
  for (std::size_t i = 0; i < size(); ++i) {  // w_i Σ_j |b_i[j]|
    const PointRow one = absolute_row(i);
    weights[i] =
        weights[i] * std::accumulate(one.x.begin(), one.x.end(), 0.) * std::accumulate(one.y.begin(), one.y.end(), 0.);
  }
  add_absolute_adjoint(weights, result);
  return result;
}

Eigen::SparseMatrix<double> DataTerm::columns() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < size(); ++i) {
    const PointRow point = row(i);
    for (int b = 0; b <= space_.y.degree(); ++b)
      for (int a = 0; a <= space_.x.degree(); ++a) {
        const double value = point.x[static_cast<std::size_t>(a)] * point.y[static_cast<std::size_t>(b)];
        if (value != 0)
          entries.emplace_back(static_cast<int>(space_.original(point.first_x + a, point.first_y + b)),
                               static_cast<int>(i), value);
      }
  }
  Eigen::SparseMatrix<double> result(static_cast<Eigen::Index>(space_.size()), static_cast<Eigen::Index>(size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Calls work(first point, rows) for the points of cell rows begin .. end - 1: all at once where the rows are kept,
/// else in pieces that are made on the spot.
template <typename Work>
void DataTerm::for_rows(int begin, int end, Work&& work) const {
  const std::size_t from = first_point(begin), to = first_point(end);
  if (!rows_.empty()) return work(from, std::span(rows_).subspan(from, to - from));
  std::array<PointRow, 64> piece;
  for (std::size_t first = from; first < to; first += piece.size()) {
    const std::size_t n = std::min(piece.size(), to - first);
    for (std::size_t i = 0; i < n; ++i) piece[i] = row(first + i);
    work(first, std::span<const PointRow>(piece.data(), n));
  }
}

void DataTerm::set_weights(PairWeights weights) {
  if (revision_ > 0 && weights == weights_) return;
  for (std::size_t i = 0; weights.are_paired() && i < size(); i += 2)
    if (points_->x[i] != points_->x[i + 1] || points_->y[i] != points_->y[i + 1])
      throw InvalidInput("DataTerm: expected rows " + std::to_string(i + 1) + " and " + std::to_string(i + 2) +
                         ", which have a weight beside the diagonal, at one point");
  weights_ = std::move(weights);
  are_paired_ = weights_.are_paired();
  ++revision_;
  finer_revision_ = 0;
  if (!stored_) return;
  stencil_ = SymmetricStencil(space_.y.size(), space_.x.size(), space_.x.degree());
  for_alternating_blocks(cell_row_blocks(space_), [&](int begin, int end) {
    for (int r = begin; r < end; ++r) accumulate_cell_row(r);
  });
}

void DataTerm::set_from_finer(const DataTerm& finer, const TensorSum& restriction) {
  if (finer_revision_ == finer.revision_) return;
  weights_ = {};
  are_paired_ = finer.are_paired_;
  ++revision_;
  finer_revision_ = finer.revision_;
  stencil_ = finer.stencil_.galerkin(restriction);
}

void DataTerm::accumulate_cell_row(int cell_row) {
  const auto& interval = space_.x.interval();
  const std::size_t from = first_point(cell_row), to = first_point(cell_row + 1);
  const std::size_t n = static_cast<std::size_t>(space_.x.degree()) + 1;
  std::vector<std::size_t> order(to - from), start(static_cast<std::size_t>(interval.cells()) + 1, 0);
  for (std::size_t i = from; i < to; ++i) ++start[static_cast<std::size_t>(interval.cell_of(points_->x[i])) + 1];
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  auto next = start;
  for (std::size_t i = from; i < to; ++i) order[next[static_cast<std::size_t>(interval.cell_of(points_->x[i]))]++] = i;

  for (std::size_t cell = 0; cell + 1 < start.size(); ++cell) {
    if (start[cell] == start[cell + 1]) continue;
    CellSum sum;
    std::fill_n(sum.begin(), n * n * n * n, 0.);
    for (std::size_t k = start[cell]; k < start[cell + 1]; ++k) {
      const PointRow point = row(order[k]);
      add_to_cell_sum(static_cast<int>(n), {&point, 1}, {&weights_.diagonal[order[k]], 1}, sum);
    }
    if (are_paired_) add_pairs(std::span(order).subspan(start[cell], start[cell + 1] - start[cell]), sum);
    for (std::size_t b = 0; b < n; ++b)
      for (std::size_t f = b; f < n; ++f)
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t e = f == b ? a : 0; e < n; ++e)
            stencil_.entries(cell_row + static_cast<int>(b), static_cast<int>(e) - static_cast<int>(a),
                             static_cast<int>(f - b))[cell + a] += sum[(b * n + f) * n * n + a * n + e];
  }
}

/// What stands beside the weights of some points, pair by pair.
void DataTerm::add_pairs(std::span<const std::size_t> points, CellSum& sum) const {
  for (std::size_t k = 0; k < points.size(); k += 2)
    add_pair_to_cell_sum(space_.x.degree() + 1, row(points[k]), row(points[k + 1]), weights_.beside[points[k] / 2],
                         sum);
}

void DataTerm::values(std::span<const double> c, std::span<double> out) const {
  for_blocks(cell_row_blocks(space_), [&](int begin, int end) {
    for_rows(begin, end, [&](std::size_t first, std::span<const PointRow> rows) {
      point_values(grid(), rows, c.data(), out.data() + first);
    });
  });
}

void DataTerm::add_adjoint(std::span<const double> v, std::span<double> c) const {
  for_alternating_blocks(cell_row_blocks(space_), [&](int begin, int end) {
    for_rows(begin, end, [&](std::size_t first, std::span<const PointRow> rows) {
      add_point_values(grid(), rows, v.data() + first, c.data());
    });
  });
  fold_images(space_, c);
}

void DataTerm::add_normal(double factor, std::span<const double> c, std::span<double> out) const {
  Wavefront(space_.y.size(), 1, space_.y.degree()).run([&](int, int j, RowRange range) {
    add_normal_row(j, range, factor, c, out);
  });
  fold_images(space_, out);
}

void DataTerm::add_normal_row(int j, RowRange range, double factor, std::span<const double> c,
                              std::span<double> out) const {
  if (size() == 0) return;
  if (stored_) return stencil_.add_row(j, factor, c, out.data() + static_cast<std::ptrdiff_t>(j) * space_.x.size());
  // cell row j adds to rows j .. j + d; the first row of the range also needs those before it
  const int first = j > range.begin ? j : std::max(0, j - space_.y.degree());
  for_rows(
      std::min(first, space_.y.interval().cells()), std::min(j + 1, space_.y.interval().cells()),
      [&](std::size_t point, std::span<const PointRow> rows) {
        const double* w = weights_.diagonal.data() + point;
        if (are_paired_)
          add_pair_products(grid(), rows, {w, weights_.beside.data() + point / 2}, factor, c.data(), out.data(), range);
        else
          add_point_products(grid(), rows, w, factor, c.data(), out.data(), range);
      });
}

}  // namespace batten
