// SPDX-License-Identifier: MIT
#include <batten/bases/banded_rows.h>

#include <algorithm>

namespace batten {
namespace {

/// True if row i + period is row i moved by shift.
bool repeats(const BandedRows& m, int i) {
  if (i < 0 || i + m.period >= m.rows) return false;
  const auto a = m.row(i), b = m.row(i + m.period);
  return m.first[static_cast<std::size_t>(i + m.period)] == m.first[static_cast<std::size_t>(i)] + m.shift &&
         std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace

void find_repeating_rows(BandedRows& m) {
  const int middle = std::max(0, m.rows / 2 - m.period);
  m.begin = m.end = middle;
  if (!repeats(m, middle)) return;
  while (repeats(m, m.begin - 1)) --m.begin;
  while (repeats(m, m.end)) ++m.end;
  m.end += m.period;
}

BandedRows transposed(const BandedRows& matrix) {
  std::vector<int> first(static_cast<std::size_t>(matrix.columns), matrix.rows), last(first.size(), -1);
  for (int i = 0; i < matrix.rows; ++i)
    for (int k = 0; k < matrix.width; ++k) {
      if (matrix.row(i)[static_cast<std::size_t>(k)] == 0) continue;
      const auto j = static_cast<std::size_t>(matrix.first[static_cast<std::size_t>(i)] + k);
      first[j] = std::min(first[j], i);
      last[j] = std::max(last[j], i);
    }
  for (std::size_t j = first.size() - 1; j-- > 0;)  // empty columns go with their neighbours
    if (last[j] < 0) first[j] = first[j + 1];
  for (std::size_t j = 1; j < first.size(); ++j)
    if (last[j] < 0 && first[j] == matrix.rows) first[j] = first[j - 1];
  BandedRows result;
  result.rows = matrix.columns;
  result.columns = matrix.rows;
  result.scale = matrix.scale;
  result.period = matrix.shift;
  result.shift = matrix.period;
  for (std::size_t j = 0; j < first.size(); ++j) result.width = std::max(result.width, last[j] - first[j] + 1);
  for (std::size_t j = 0; j < first.size(); ++j) {
    result.first.push_back(std::max(0, std::min(first[j], result.columns - result.width)));
    for (int k = 0; k < result.width; ++k) {
      const int i = result.first.back() + k, c = static_cast<int>(j) - matrix.first[static_cast<std::size_t>(i)];
      result.weights.push_back(c < 0 || c >= matrix.width ? 0. : matrix.row(i)[static_cast<std::size_t>(c)]);
    }
  }
  find_repeating_rows(result);
  return result;
}

BandedRows identity_rows(int size) {
  BandedRows one;
  one.rows = one.columns = one.end = size;
  one.width = 1;
  one.weights.assign(static_cast<std::size_t>(size), 1.);
  for (int i = 0; i < size; ++i) one.first.push_back(i);
  return one;
}

}  // namespace batten
