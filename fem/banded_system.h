// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>
#include <vector>

namespace batten {

/// Row i of a symmetric matrix with two bands beside the diagonal: the entries (i, i), (i, i + 1) and (i, i + 2).
struct BandRow {
  double diagonal, first, second;
};

/// Several right-hand sides or solutions, each row contiguous.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A factorisation L D L^T of a symmetric positive definite band matrix from both ends towards the middle: two threads,
/// and the same bits whether there are two or one [van der Vorst 1987].
class BandedFactor {
public:
  /// `row(i)` gives row i, 0 <= i < size; size >= 4.
  template <class Row>
  BandedFactor(int size, const Row& row)
      : size_(size), middle_((size - 2) / 2), entries_(static_cast<std::size_t>(size)) {
    const auto turned = [&](int i) {  // rows counted from the other end
      const int j = size - 1 - i;
      return BandRow{row(j).diagonal, j > 0 ? row(j - 1).first : 0, j > 1 ? row(j - 2).second : 0};
    };
    std::array<Rest, 2> rest;
#pragma omp parallel for schedule(static) num_threads(2) if (size_ > smallest_shared)
    for (int side = 0; side < 2; ++side)
      rest[static_cast<std::size_t>(side)] =
          side == 0 ? eliminate(middle_, row, 0, 1) : eliminate(size - 2 - middle_, turned, size - 1, -1);
    const BandRow a = row(middle_), b = row(middle_ + 1);
    core_ << a.diagonal + rest[0].here + rest[1].next, a.first + rest[0].between + rest[1].between, 0,
        b.diagonal + rest[0].next + rest[1].here;
    core_(1, 0) = core_(0, 1);
  }

  /// Replaces right-hand sides by solutions, size() rows.
  void solve(RowMatrix& x) const;

  int size() const { return size_; }

private:
  /// Row i of L and D: multipliers of the next two rows, and 1 / D.
  struct Entry {
    double first, second, inverse;
  };
  /// What elimination has added to the next two rows.
  struct Rest {
    double here = 0, between = 0, next = 0;
  };
  template <class Row>
  Rest eliminate(int count, const Row& row, int start, int step) {
    Rest rest;
    for (int i = 0; i < count; ++i) {
      const BandRow a = row(i);
      const double inverse = 1 / (a.diagonal + rest.here), u = a.first + rest.between;
      const double l = u * inverse, m = a.second * inverse;
      rest = {rest.next - l * u, -m * u, -m * a.second};
      entries_[static_cast<std::size_t>(start + step * i)] = {l, m, inverse};
    }
    return rest;
  }
  /// Rows before the middle; what they add to the next two rows.
  std::array<double, 2> forward(int count, int start, int step, RowMatrix& x, Eigen::Index column) const;
  void backward(int count, int start, int step, RowMatrix& x) const;

  static constexpr int smallest_shared = 4096;  // below, waking a thread takes longer

  int size_, middle_;  // rows middle_ and middle_ + 1 are solved last
  std::vector<Entry> entries_;
  Eigen::Matrix2d core_;
};

}  // namespace batten
