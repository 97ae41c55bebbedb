// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

namespace batten {

/// Calls work(std::integral_constant<int, n>()), so that kernels can be compiled for each width from `least` to `most`;
/// numbers beyond take the kernel of `most`. Inlined wholly, and so compiled for the caller's instruction set.
template <int least, int most, typename Work>
[[gnu::always_inline]] inline void with_constant(int n, Work&& work) {
  if constexpr (least < most) {
    if (n != least) return with_constant<least + 1, most>(n, work);
  }
  work(std::integral_constant<int, least>());
}

}  // namespace batten
