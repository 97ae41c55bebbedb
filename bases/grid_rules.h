// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/subdivision_rules.h>

#include <array>
#include <vector>

namespace batten {

/// The rules of one step on a grid: how a new row comes from old ones.
///
/// Old rows that have the same weights in a new row, as masks that are symmetric in y have them in pairs, are added
/// before they are weighted, which halves the products. The symmetries in x and about the diagonal are of no use here:
/// each product that they spare costs a sum, and a product is done in one instruction with its sum.
class GridRules {
public:
  GridRules(const Mask2<double>& mask, int arity);

  const AxisRules& x() const { return x_; }
  const AxisRules& y() const { return y_; }

  /// Old points at equal distances and what they give to the new points of their groups.
  struct Tap {
    const double* old;
    std::array<double, 3> weights;
  };
  /// What one thread needs to fill rows.
  struct Work {
    std::vector<double> rows, sums;
    std::vector<Tap> taps;
  };
  Work work(std::ptrdiff_t old_row_length) const;

  /// The new row of this residue in all groups along x: x().arity * groups numbers into out. The old rows that its
  /// group in y uses begin at `old`, each `stride` numbers behind the one before, and are groups + x().width - 1 long.
  /// Allocates nothing.
  void fill_row(int residue, const double* old, std::ptrdiff_t stride, std::ptrdiff_t groups, Work& work,
                double* out) const;

private:
  /// The old row `first`, or the sum of two, counted from the first one that a group uses.
  struct Row {
    int first;
    int second;                   // -1: there is none
    std::vector<double> weights;  // [arity * q + r]: of old point g - reach + q in new point arity g + r
  };
  static std::vector<Row> rows_of(const std::vector<double>* sets, int count);
  void collect_taps(const Row& row, const double* old, std::vector<Tap>& taps) const;

  AxisRules x_, y_;
  std::vector<std::vector<Row>> rows_;  // by residue in y
};

}  // namespace batten
