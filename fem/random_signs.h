// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace batten {

/// Vector number `k` of independent random signs ±1: a probe for traces and diagonals [Hutchinson 1990]. The same on
/// every machine.
inline std::vector<double> random_signs(std::size_t n, std::uint64_t seed, std::uint64_t k) {
  std::mt19937_64 random(seed * 0x9E3779B97F4A7C15ull + k);
  std::vector<double> signs(n);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 64 == 0) bits = random();
    signs[i] = bits >> (i % 64) & 1 ? 1. : -1.;
  }
  return signs;
}

}  // namespace batten
