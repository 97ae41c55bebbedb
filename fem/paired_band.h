// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace batten {

/// A symmetric band of pairs (value, bend) of unknowns, each of its diagonal blocks [a b; b -c] with a, c > 0 and these
/// parts definite as a whole: what a strip's values and second derivatives satisfy together. Pairs are eliminated one
/// after the other without exchanges: the determinants -(ac + b²) are sums of terms of one sign whatever the weights.
class PairedBand {
public:
  /// Pairs farther apart than `reach` have nothing to do with each other. Throws InvalidInput unless that is 1, 2, 3, 4
  /// or 6.
  PairedBand(std::size_t pairs, std::size_t reach);

  /// Rows value and bend of the later pair, columns of the earlier one.
  struct Block {
    double vv = 0, vb = 0, bv = 0, bb = 0;
  };
  /// The block of pairs p and p + offset.
  Block& at(std::size_t p, std::size_t offset) { return blocks_[p * (reach_ + 1) + offset]; }
  void clear();
  void factor();
  /// (value, bend) of pair after pair: right sides in, solutions out.
  std::vector<double> solved(std::vector<double> x) const;

private:
  std::size_t pairs_, reach_;
  std::vector<Block> blocks_;  // after `factor` inverses of diagonal blocks, and L; `reach` pairs more, which are 0
};

}  // namespace batten
