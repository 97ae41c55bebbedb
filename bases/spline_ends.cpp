// SPDX-License-Identifier: MIT
#include <batten/bases/spline_ends.h>

#include <algorithm>

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

}  // namespace

BandedRows subspace_restriction(int size, const EndConditions& ends) {
  BandedRows one;
  one.rows = one.columns = size;
  one.width = 3;
  for (int i = 0; i < size; ++i) {
    one.first.push_back(std::clamp(i - 1, 0, size - 3));
    for (int k = 0; k < 3; ++k) one.weights.push_back(one.first.back() + k == i ? 1. : 0.);
  }
  return with_constrained_rows(std::move(one), ends);
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
