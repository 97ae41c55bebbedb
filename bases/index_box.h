// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace batten {

/// floor(a / b), b > 0.
template <std::signed_integral T>
T floor_quotient(T a, std::type_identity_t<T> b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// i - j.
template <std::size_t N>
std::array<int, N> difference(std::array<int, N> i, const std::array<int, N>& j) {
  for (std::size_t d = 0; d < N; ++d) i[d] -= j[d];
  return i;
}

/// The indices first .. last in each direction; empty where last < first.
template <int D>
struct IndexBox {
  Index<D> first{}, last{};
};

template <int D>
Index<D> size_of(const IndexBox<D>& box) {
  Index<D> size{};
  for (std::size_t d = 0; d < D; ++d) size[d] = std::max(0, box.last[d] - box.first[d] + 1);
  return size;
}

/// All indices of a box, x fastest.
template <int D>
std::vector<Index<D>> indices_of(const IndexBox<D>& box) {
  std::vector<Index<D>> all;
  const int rows = D == 1 ? 1 : size_of(box)[D - 1];
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < size_of(box)[0]; ++x) {
      Index<D> i = box.first;
      i[0] += x;
      if constexpr (D == 2) i[1] += y;
      all.push_back(i);
    }
  return all;
}

}  // namespace batten
