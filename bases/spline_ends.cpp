// SPDX-License-Identifier: MIT
#include <batten/bases/spline_ends.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

double& entry(BandedRows& m, int i, int j) {
  return m.weights[static_cast<std::size_t>(i) * static_cast<std::size_t>(m.width) +
                   static_cast<std::size_t>(j - m.first[static_cast<std::size_t>(i)])];
}

bool is_kept(const BandedRows& m, int i, int j) {
  const int k = j - m.first[static_cast<std::size_t>(i)];
  return k >= 0 && k < m.width;
}

/// Calls work(end, next, condition) for both ends: the numbers of the first two functions counted from there.
template <typename Work>
void for_ends(const EndConditions& ends, int size, Work&& work) {
  if (ends.lower != EndCondition::Free) work(0, 1, ends.lower);
  if (ends.upper != EndCondition::Free) work(size - 1, size - 2, ends.upper);
}

void clear_column(BandedRows& m, int j) {
  for (int i = 0; i < m.rows; ++i)
    if (is_kept(m, i, j)) entry(m, i, j) = 0;
}

void clear_row(BandedRows& m, int i) {
  for (int k = 0; k < m.width; ++k) m.weights[static_cast<std::size_t>(i * m.width + k)] = 0;
}

/// The identity with room for `reach` entries on both sides of the diagonal.
BandedRows wide_identity(int size, int reach) {
  BandedRows one;
  one.rows = one.columns = size;
  one.width = std::min(size, 2 * reach + 1);
  for (int i = 0; i < size; ++i) {
    one.first.push_back(std::clamp(i - reach, 0, size - one.width));
    for (int k = 0; k < one.width; ++k) one.weights.push_back(one.first.back() + k == i ? 1. : 0.);
  }
  return one;
}

}  // namespace

BandedRows subspace_restriction(int size, int degree, const EndConditions& ends) {
  if (!ends.is_periodic()) return with_constrained_rows(wide_identity(size, 1), ends);
  BandedRows result = wide_identity(size, degree);
  const auto a = periodic_end(degree);
  for (int j = 0; j < degree; ++j)
    for (int k = 0; k < degree; ++k) {
      const double weight = a[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)].convert_to<double>();
      entry(result, k, j) = weight;
      entry(result, size - 1 - k, size - 1 - j) = weight;
    }
  find_repeating_rows(result);
  return result;
}

// Values of the blossom of the polynomial on the cell [0, 1] at consecutive knots, begun by more and more zeros: its
// values at knots of the uniform spline become those at the repeated knots of the whole basis.
std::vector<std::vector<Rational>> periodic_end(int degree) {
  const auto d = static_cast<std::size_t>(degree);
  std::vector<std::vector<Rational>> result(d, std::vector<Rational>(d));
  for (std::size_t k = 0; k < d; ++k) {
    std::vector<Rational> blossom(d + 1);
    blossom[k] = 1;
    for (int zeros = 1; zeros <= degree; ++zeros) {
      const int length = degree - zeros + 1;
      for (std::size_t q = 0; q + 1 < blossom.size(); ++q) {
        const int start = static_cast<int>(q) + 1 - length;  // of the knots that blossom[q] belongs to
        blossom[q] = (blossom[q] * (length + start) - blossom[q + 1] * start) / length;
      }
      blossom.pop_back();
      result[d - static_cast<std::size_t>(zeros)][k] = blossom.back();
    }
  }
  return result;
}

// Function j is Σ_k 2^-d (d + 1 over k) of the fine functions 2 j - d + k.
BandedRows periodic_refinement(int cells, int degree) {
  std::vector<double> binomial = {1};
  for (int k = 0; k <= degree; ++k) binomial.push_back(binomial.back() * (degree + 1 - k) / (k + 1));
  BandedRows result;
  result.rows = 2 * cells + degree;
  result.columns = cells + degree;
  result.width = degree / 2 + 1 + degree % 2;
  result.period = 2;
  result.scale = std::ldexp(1., -degree);
  for (int i = 0; i < result.rows; ++i) {
    const int first = std::min(i / 2, result.columns - result.width);
    result.first.push_back(first);
    for (int j = first; j < first + result.width; ++j) {
      const int k = i + degree - 2 * j;
      result.weights.push_back(k < 0 || k > degree + 1 ? 0. : binomial[static_cast<std::size_t>(k)]);
    }
  }
  find_repeating_rows(result);
  return result;
}

BandedRows with_constrained_columns(BandedRows m, const EndConditions& ends) {
  for_ends(ends, m.columns, [&](int end, int next, EndCondition condition) {
    if (condition == EndCondition::Flat)
      for (int i = 0; i < m.rows; ++i)
        if (is_kept(m, i, end) && entry(m, i, end) != 0) entry(m, i, next) += entry(m, i, end);
    clear_column(m, end);
    if (condition == EndCondition::Clamped) clear_column(m, next);
  });
  find_repeating_rows(m);
  return m;
}

BandedRows with_constrained_rows(BandedRows m, const EndConditions& ends) {
  for_ends(ends, m.rows, [&](int end, int next, EndCondition condition) {
    if (condition == EndCondition::Flat)
      for (int j = 0; j < m.columns; ++j)
        if (is_kept(m, end, j) && entry(m, end, j) != 0) entry(m, next, j) += entry(m, end, j);
  });
  return without_removed_rows(std::move(m), ends);
}

BandedRows without_removed_rows(BandedRows m, const EndConditions& ends) {
  for_ends(ends, m.rows, [&](int end, int next, EndCondition condition) {
    clear_row(m, end);
    if (condition == EndCondition::Clamped) clear_row(m, next);
  });
  find_repeating_rows(m);
  return m;
}

}  // namespace batten
