// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/difference_form.h>

#include <omp.h>

#include <algorithm>
#include <utility>

namespace batten {
namespace {

using Vector = std::vector<double>;

struct Grid {
  int columns = 0, rows = 0;
  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

/// Calls work(j) for all rows of the grid.
template <typename Work>
void for_rows(const Grid& grid, Work&& work) {
  for_blocks(RowBlocks(grid.rows, grid.columns), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) work(static_cast<std::ptrdiff_t>(j));
  });
}

Vector x_differences(const Vector& c, Grid from, const Vector& slope) {
  const Grid to{from.columns - 1, from.rows};
  Vector result(to.size());
  for_rows(to, [&](std::ptrdiff_t j) {
    const double* in = c.data() + j * from.columns;
    double* out = result.data() + j * to.columns;
    for (int i = 0; i < to.columns; ++i) out[i] = slope[static_cast<std::size_t>(i)] * (in[i + 1] - in[i]);
  });
  return result;
}

Vector y_differences(const Vector& c, Grid from, const Vector& slope) {
  const Grid to{from.columns, from.rows - 1};
  Vector result(to.size());
  for_rows(to, [&](std::ptrdiff_t j) {
    const double* in = c.data() + j * from.columns;
    double* out = result.data() + j * to.columns;
    for (int i = 0; i < to.columns; ++i) out[i] = slope[static_cast<std::size_t>(j)] * (in[i + from.columns] - in[i]);
  });
  return result;
}

/// Some rows of a grid, from `first` on.
struct Rows {
  int first = 0, count = 0, columns = 0;
  Vector values;

  /// Rows begin .. end - 1 of this width, of unspecified values.
  void reshape(int begin, int end, int width) {
    first = begin;
    count = end - begin;
    columns = width;
    values.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(width));
  }
  int end() const { return first + count; }
  double* row(int j) { return values.data() + static_cast<std::ptrdiff_t>(j - first) * columns; }
  const double* row(int j) const { return values.data() + static_cast<std::ptrdiff_t>(j - first) * columns; }
};

/// What a thread needs for a block, kept from block to block.
struct Scratch {
  Rows differences, products, next;
  std::vector<const double*> in;
};

TensorSum mass(const SplineSpace& space, int a, int b) {
  return TensorSum({{1., lowered(space.y, b).inner_products(0), lowered(space.x, a).inner_products(0)}});
}

/// D^T M D of one term of an energy, by blocks of rows that stay in the cache.
class DifferenceTerm {
public:
  DifferenceTerm(const SplineSpace& space, int a, int b)
      : nx_(space.x.size()), ny_(space.y.size()), a_(a), b_(b), mass_(mass(space, a, b)) {
    for (int k = 0; k < a; ++k) x_slopes_.push_back(derivative_slopes(lowered(space.x, k)));
    for (int k = 0; k < b; ++k) y_slopes_.push_back(derivative_slopes(lowered(space.y, k)));
  }

  /// out += factor (rows begin .. end - 1 of D^T M D c); out[0] is the first of them.
  void add_rows(int begin, int end, double factor, const double* c, double* out, Scratch& scratch) const {
    multiply(begin, end, c, scratch);
    transpose_differences(begin, end, scratch);
    const Rows& g = scratch.products;
    for (int j = begin; j < end; ++j) {
      const double* in = g.row(j);
      double* to = out + static_cast<std::ptrdiff_t>(j - begin) * nx_;
#pragma omp simd
      for (int i = 0; i < nx_; ++i) to[i] += factor * in[i];
    }
  }

private:
  /// d = the rows of D c from `begin` to `end`.
  void differentiate(int begin, int end, const double* c, Rows& d) const {
    d.reshape(begin, end + b_, nx_);
    std::copy_n(c + static_cast<std::ptrdiff_t>(begin) * nx_, d.values.size(), d.values.begin());
    for (int j = begin; j < end + b_; ++j) {
      double* row = d.row(j);
      for (int k = 0; k < a_; ++k) {
        const double* slope = x_slopes_[static_cast<std::size_t>(k)].data();
#pragma omp simd
        for (int i = 0; i < nx_ - k - 1; ++i) row[i] = slope[i] * (row[i + 1] - row[i]);
      }
    }
    for (int k = 0; k < b_; ++k)
      for (int j = begin; j < end + b_ - k - 1; ++j) {
        const double slope = y_slopes_[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
        double* row = d.row(j);
        const double* next = d.row(j + 1);
#pragma omp simd
        for (int i = 0; i < nx_ - a_; ++i) row[i] = slope * (next[i] - row[i]);
      }
  }

  /// The rows of M D c that rows begin .. end - 1 of the result need.
  void multiply(int begin, int end, const double* c, Scratch& scratch) const {
    auto& [d, g, next, in] = scratch;
    g.reshape(std::max(0, begin - b_), std::min(end, ny_ - b_), nx_ - a_);
    if (g.count == 0) return;
    const int height = mass_.band_height(), last = mass_.first_row(g.end() - 1) + height;
    differentiate(mass_.first_row(g.first), last, c, d);
    in.resize(static_cast<std::size_t>(height));
    for (int j = g.first; j < g.end(); ++j) {
      for (int q = 0; q < height; ++q) in[static_cast<std::size_t>(q)] = d.row(mass_.first_row(j) + q);
      mass_.row(j, in.data(), {0, nx_ - a_}, g.row(j));
    }
  }

  /// Replaces the products g by D^T g, the transposed differences slope_{j-1} g_{j-1} - slope_j g_j of both directions.
  void transpose_differences(int begin, int end, Scratch& scratch) const {
    Rows &g = scratch.products, &next = scratch.next;
    for (int k = b_ - 1; k >= 0; --k) {
      const auto& slopes = y_slopes_[static_cast<std::size_t>(k)];
      next.reshape(std::max(0, begin - k), std::min(end, ny_ - k), nx_ - a_);
      std::fill(next.values.begin(), next.values.end(), 0.);
      for (int j = next.first; j < next.end(); ++j)
        for (const int from : {j - 1, j}) {
          if (from < 0 || from >= ny_ - k - 1) continue;
          const double slope = (from < j ? 1 : -1) * slopes[static_cast<std::size_t>(from)];
          const double* in = g.row(from);
          double* out = next.row(j);
#pragma omp simd
          for (int i = 0; i < nx_ - a_; ++i) out[i] += slope * in[i];
        }
      std::swap(g, next);
    }
    for (int k = a_ - 1; k >= 0; --k) {
      const double* slope = x_slopes_[static_cast<std::size_t>(k)].data();
      const int n = nx_ - k - 1;
      next.reshape(g.first, g.end(), n + 1);
      for (int j = g.first; j < g.end(); ++j) {
        const double* in = g.row(j);
        double* out = next.row(j);
        out[0] = -slope[0] * in[0];
#pragma omp simd
        for (int i = 1; i < n; ++i) out[i] = slope[i - 1] * in[i - 1] - slope[i] * in[i];
        out[n] = slope[n - 1] * in[n - 1];
      }
      std::swap(g, next);
    }
  }

  int nx_, ny_, a_, b_;
  TensorSum mass_;
  std::vector<Vector> x_slopes_, y_slopes_;
};

}  // namespace

SplineBasis lowered(const SplineBasis& basis, int order) {
  return {basis.interval(), basis.degree() - order, basis.is_periodic() ? basis.ends() : EndConditions{}};
}

Vector derivative_slopes(const SplineBasis& basis) {
  const BandedRows rows = basis.differences();
  Vector result;
  for (int i = 0; i < rows.rows; ++i) result.push_back(rows(i, i + 1));
  return result;
}

std::vector<double> differentiated(const SplineSpace& space, std::span<const double> coefficients, int a, int b) {
  Vector c(coefficients.begin(), coefficients.end());
  for (int k = 0; k < a; ++k)
    c = x_differences(c, {space.x.size() - k, space.y.size()}, derivative_slopes(lowered(space.x, k)));
  for (int k = 0; k < b; ++k)
    c = y_differences(c, {space.x.size() - a, space.y.size() - k}, derivative_slopes(lowered(space.y, k)));
  return c;
}

std::vector<double> apply_by_differences(const Energy& energy, const SplineSpace& space,
                                         std::span<const double> coefficients, std::vector<double> memory) {
  constexpr int least_rows = 32;  // a block takes in a few rows more on each side
  Vector result = apply_curvature(energy.curvature(), space, coefficients, std::move(memory));
  std::vector<DifferenceTerm> terms;
  for (const auto& t : energy.terms()) terms.emplace_back(space, t.x_order, t.y_order);
  std::vector<Scratch> scratch(static_cast<std::size_t>(omp_get_max_threads()));
  for_blocks(RowBlocks(space.y.size(), space.x.size(), least_rows), [&](int begin, int end) {
    Scratch& own = scratch[static_cast<std::size_t>(omp_get_thread_num())];
    double* out = result.data() + static_cast<std::ptrdiff_t>(begin) * space.x.size();
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const auto& t = energy.terms()[k];
      terms[k].add_rows(begin, end, t.weight * space.cell_factor(t.x_order, t.y_order), coefficients.data(), out, own);
    }
  });
  return result;
}

double evaluate_energy(const Energy& energy, const SplineSpace& space, std::span<const double> coefficients) {
  const Vector c(coefficients.begin(), coefficients.end());
  double sum = energy.curvature() == 0 ? 0 : dot(c, apply_curvature(energy.curvature(), space, c));
  for (const auto& t : energy.terms()) {
    const Vector derivative = differentiated(space, c, t.x_order, t.y_order);
    Vector product(derivative.size());
    mass(space, t.x_order, t.y_order).apply(derivative, product);
    sum += t.weight * space.cell_factor(t.x_order, t.y_order) * dot(derivative, product);
  }
  return sum;
}

}  // namespace batten
