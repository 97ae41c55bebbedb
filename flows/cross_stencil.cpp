// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/flows/cross_stencil.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

constexpr int most_lanes = 16;

/// The rows of partners of one coefficient, `height` of them one grid row apart, the entries `width` apart.
struct Partners {
  const double* entries;
  int width, height;
  std::ptrdiff_t stride;  // of the grid
  const double* in;
  double* out;
};

template <int width>
[[gnu::always_inline]] inline double multiply(const Partners& p, double c) {
  std::array<double, width> sums{};
  for (int r = 0; r < p.height; ++r) {
    const double* __restrict entries = p.entries + r * width;
    const double* in = p.in + r * p.stride;
    double* __restrict out = p.out + r * p.stride;
#pragma omp simd
    for (int k = 0; k < width; ++k) {
      sums[static_cast<std::size_t>(k)] += entries[k] * in[k];
      out[k] += entries[k] * c;
    }
  }
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

/// Σ of the entries times `in`, and out += c entries, for `count` coefficients one after another.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void multiply_row(Partners p, double factor, const double* c, double* own, int count, std::ptrdiff_t step) {
  for (int i = 0; i < count; ++i, ++p.in, ++p.out, p.entries += step) {
    const double scaled = factor * c[i];
    own[i] += factor * (p.width == 8 ? multiply<8>(p, scaled) : multiply<most_lanes>(p, scaled));
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_multiple(double factor, const double* __restrict in, double* __restrict out, int n) {
#pragma omp simd
  for (int k = 0; k < n; ++k) out[k] += factor * in[k];
}

}  // namespace

CrossStencil::CrossStencil(int rows, int columns, int degree)
    : rows_(rows), columns_(columns), degree_(degree), width_((2 * degree + lanes) / lanes * lanes) {
  entries_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) *
                  static_cast<std::size_t>(block()));
}

CrossStencil::CrossStencil(const SplineSpace& space, const DataTerm& first, const DataTerm& second,
                           const CrossWeights& weights)
    : CrossStencil(space.y.size(), space.x.size(), space.x.degree()) {
  const RowBlocks blocks(space.y.interval().cells(), columns_, std::max(4, degree_));
  for_alternating_blocks(blocks, [&](int begin, int end) {
    for (int r = begin; r < end; ++r) accumulate(r, first, second, weights);
  });
}

void CrossStencil::accumulate(int cell_row, const DataTerm& first, const DataTerm& second,
                              const CrossWeights& weights) {
  for (std::size_t i = first.first_point(cell_row); i < first.first_point(cell_row + 1); ++i) {
    const PointRow a = first.row(i);
    add_product(weights.own[i], a, second.row(i));
    if (!weights.beside.empty()) add_product(weights.beside[i], a, second.row(i % 2 == 0 ? i + 1 : i - 1));
  }
}

/// Adds weight a b^T.
void CrossStencil::add_product(double weight, const PointRow& a, const PointRow& b) {
  for (int s = 0; s <= degree_; ++s)
    for (int p = 0; p <= degree_; ++p) {
      const double w = weight * a.y[static_cast<std::size_t>(s)] * a.x[static_cast<std::size_t>(p)];
      double* entries = row(a.first_x + p, a.first_y + s, -s) + degree_ - p;
      for (int t = 0; t <= degree_; ++t, entries += width_) {
        const double v = w * b.y[static_cast<std::size_t>(t)];
        for (int q = 0; q <= degree_; ++q) entries[q] += v * b.x[static_cast<std::size_t>(q)];
      }
    }
}

/// For rows begin .. end - 1 of this stencil and each coarse column: [row][column][dy + d][dx + d], dy fine and dx
/// coarse.
std::vector<double> CrossStencil::reduce_columns(const BandedRows& first, const BandedRows& second, int begin,
                                                 int end) const {
  const int d = degree_, reach = first.width + 2 * d, stride = reach + width_;
  std::vector<double> result(static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(first.rows) *
                             static_cast<std::size_t>(block()));
  std::vector<double> met(static_cast<std::size_t>((2 * d + 1) * stride));  // [dy + d][fine partner]
  double* out = result.data();
  for (int j = begin; j < end; ++j)
    for (int i = 0; i < first.rows; ++i, out += block()) {
      const int fine = first.first[static_cast<std::size_t>(i)];
      std::fill(met.begin(), met.end(), 0.);
      for (int p = 0; p < first.width; ++p)
        for (int dy = 0; dy <= 2 * d; ++dy)
          add_multiple(first.row(i)[static_cast<std::size_t>(p)], row(fine + p, j, dy - d),
                       met.data() + dy * stride + p, width_);
      for (int dx = std::max(-d, -i); dx <= std::min(d, second.rows - 1 - i); ++dx) {
        const auto weights = second.row(i + dx);
        const int partner = second.first[static_cast<std::size_t>(i + dx)] - fine + d;
        for (int q = std::max(0, -partner); q < std::min(second.width, reach - partner); ++q)
          for (int dy = 0; dy <= 2 * d; ++dy)
            out[dy * width_ + dx + d] +=
                weights[static_cast<std::size_t>(q)] * met[static_cast<std::size_t>(dy * stride + partner + q)];
      }
    }
  return result;
}

CrossStencil CrossStencil::galerkin(const TensorSum& first, const TensorSum& second) const {
  const auto& [scale, y, x] = first.terms().front();
  const auto& [other_scale, other_y, other_x] = second.terms().front();
  CrossStencil result(y.rows, x.rows, degree_);
  const int d = degree_, reach = y.width + 2 * d;
  for_blocks(RowBlocks(y.rows, x.rows * 16, 4), [&, &y = y, &x = x, &other_y = other_y, &other_x = other_x,
                                                 factor = scale * other_scale](int begin, int end) {
    const int from = y.first[static_cast<std::size_t>(begin)];
    const auto half = reduce_columns(x, other_x, from, y.first[static_cast<std::size_t>(end - 1)] + y.width);
    std::vector<double> met(static_cast<std::size_t>(reach * width_));  // [fine partner][dx + d]
    for (int j = begin; j < end; ++j)
      for (int i = 0; i < x.rows; ++i) {
        const int fine = y.first[static_cast<std::size_t>(j)];
        std::fill(met.begin(), met.end(), 0.);
        for (int p = 0; p < y.width; ++p)
          add_multiple(factor * y.row(j)[static_cast<std::size_t>(p)],
                       half.data() + ((fine + p - from) * x.rows + i) * block(), met.data() + p * width_,
                       static_cast<int>(block()));
        for (int dy = std::max(-d, -j); dy <= std::min(d, other_y.rows - 1 - j); ++dy) {
          const auto weights = other_y.row(j + dy);
          const int partner = other_y.first[static_cast<std::size_t>(j + dy)] - fine + d;
          for (int q = std::max(0, -partner); q < std::min(other_y.width, reach - partner); ++q)
            add_multiple(weights[static_cast<std::size_t>(q)], met.data() + (partner + q) * width_,
                         result.row(i, j, dy), width_);
        }
      }
  });
  return result;
}

void CrossStencil::add_products(double factor, std::span<const double> first_c, std::span<const double> second_c,
                                std::span<double> first, std::span<double> second) const {
  const int d = degree_, beyond = width_ - d;  // partners of i end before i + beyond
  const std::ptrdiff_t n = columns_, step = block();
  const auto one_by_one = [&](int i, int j, int dy) {
    const std::ptrdiff_t own = j * n + i, partner = own + dy * n;
    const double* entries = row(i, j, dy) + d;
    for (int dx = std::max(-d, -i); dx <= std::min(d, columns_ - 1 - i); ++dx) {
      const double e = factor * entries[dx];
      first[static_cast<std::size_t>(own)] += e * second_c[static_cast<std::size_t>(partner + dx)];
      second[static_cast<std::size_t>(partner + dx)] += e * first_c[static_cast<std::size_t>(own)];
    }
  };
  for_alternating_blocks(RowBlocks(rows_, columns_, 2 * d), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) {
      const int low = std::max(-d, -j), high = std::min(d, rows_ - 1 - j);
      const int from = std::min(d, columns_), to = std::max(from, columns_ - beyond + 1);
      for (int dy = low; dy <= high; ++dy) {
        for (int i = 0; i < from; ++i) one_by_one(i, j, dy);
        for (int i = to; i < columns_; ++i) one_by_one(i, j, dy);
      }
      if (from == to) continue;
      const std::ptrdiff_t own = j * n + from, partner = own + low * n - d;
      multiply_row({row(from, j, low), width_, high - low + 1, n, second_c.data() + partner, second.data() + partner},
                   factor, first_c.data() + own, first.data() + own, to - from, step);
    }
  });
}

void CrossStencil::add_absolute_sums(std::span<double> first, std::span<double> second) const {
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i)
      for (int dy = std::max(-degree_, -j); dy <= std::min(degree_, rows_ - 1 - j); ++dy)
        for (int dx = std::max(-degree_, -i); dx <= std::min(degree_, columns_ - 1 - i); ++dx) {
          const double e = std::abs(entry(i, j, dx, dy));
          first[static_cast<std::size_t>(j * columns_ + i)] += e;
          second[static_cast<std::size_t>((j + dy) * columns_ + i + dx)] += e;
        }
}

}  // namespace batten
