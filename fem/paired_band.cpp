// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/paired_band.h>

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>

namespace batten {
namespace {

using Block = PairedBand::Block;

/// Of a symmetric block.
Block inverse(const Block& d) {
  const double determinant = d.vb * d.vb - d.vv * d.bb;
  return {-d.bb / determinant, d.vb / determinant, d.vb / determinant, -d.vv / determinant};
}

Block product(const Block& a, const Block& b) {
  return {a.vv * b.vv + a.vb * b.bv, a.vv * b.vb + a.vb * b.bb, a.bv * b.vv + a.bb * b.bv, a.bv * b.vb + a.bb * b.bb};
}

/// target -= a bᵀ
void subtract(Block& target, const Block& a, const Block& b) {
  target.vv -= a.vv * b.vv + a.vb * b.vb;
  target.vb -= a.vv * b.bv + a.vb * b.bb;
  target.bv -= a.bv * b.vv + a.bb * b.vb;
  target.bb -= a.bv * b.bv + a.bb * b.bb;
}

template <std::size_t reach>
void factor_band(Block* blocks, std::size_t pairs) {
  constexpr std::size_t stride = reach + 1;
  for (std::size_t p = 0; p < pairs; ++p) {
    Block* const column = blocks + p * stride;
    column[0] = inverse(column[0]);
    std::array<Block, reach> below;
    for (std::size_t j = 0; j < reach; ++j) below[j] = product(column[j + 1], column[0]);
    for (std::size_t k = 0; k < reach; ++k)
      for (std::size_t j = k; j < reach; ++j) subtract(column[(k + 1) * stride + j - k], below[j], column[k + 1]);
    std::copy(below.begin(), below.end(), column + 1);
  }
}

template <std::size_t reach>
void solve_band(const Block* blocks, std::size_t pairs, double* x) {
  constexpr std::size_t stride = reach + 1;
  for (std::size_t p = 0; p < pairs; ++p)
    for (std::size_t j = 1; j <= reach; ++j) {
      const Block& l = blocks[p * stride + j];
      x[2 * (p + j)] -= l.vv * x[2 * p] + l.vb * x[2 * p + 1];
      x[2 * (p + j) + 1] -= l.bv * x[2 * p] + l.bb * x[2 * p + 1];
    }
  for (std::size_t p = pairs; p-- > 0;) {
    const Block& d = blocks[p * stride];
    double v = d.vv * x[2 * p] + d.vb * x[2 * p + 1], b = d.bv * x[2 * p] + d.bb * x[2 * p + 1];
    for (std::size_t j = 1; j <= reach; ++j) {
      const Block& l = blocks[p * stride + j];
      v -= l.vv * x[2 * (p + j)] + l.bv * x[2 * (p + j) + 1];
      b -= l.vb * x[2 * (p + j)] + l.bb * x[2 * (p + j) + 1];
    }
    x[2 * p] = v;
    x[2 * p + 1] = b;
  }
}

/// Calls work with the reach as a constant.
template <typename Work>
void with_reach(std::size_t reach, Work&& work) {
  switch (reach) {
    case 1:
      return work(std::integral_constant<std::size_t, 1>());
    case 2:
      return work(std::integral_constant<std::size_t, 2>());
    case 3:
      return work(std::integral_constant<std::size_t, 3>());
    case 4:
      return work(std::integral_constant<std::size_t, 4>());
    case 6:
      return work(std::integral_constant<std::size_t, 6>());
    default:
      throw InvalidInput("PairedBand: reach must be 1, 2, 3, 4 or 6, found " + std::to_string(reach));
  }
}

}  // namespace

PairedBand::PairedBand(std::size_t pairs, std::size_t reach)
    : pairs_(pairs), reach_(reach), blocks_((pairs + reach) * (reach + 1)) {
  with_reach(reach, [](auto) {});
}

void PairedBand::clear() { std::fill(blocks_.begin(), blocks_.end(), Block{}); }

void PairedBand::factor() {
  with_reach(reach_, [this](auto reach) { factor_band<reach>(blocks_.data(), pairs_); });
}

std::vector<double> PairedBand::solved(std::vector<double> x) const {
  x.resize(2 * (pairs_ + reach_));
  with_reach(reach_, [&](auto reach) { solve_band<reach>(blocks_.data(), pairs_, x.data()); });
  x.resize(2 * pairs_);
  return x;
}

}  // namespace batten
