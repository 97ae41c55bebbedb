// SPDX-License-Identifier: MIT
#include <batten/fem/banded_system.h>

namespace batten {

std::array<double, 2> BandedFactor::forward(int count, int start, int step, RowMatrix& x, Eigen::Index column) const {
  double next = 0, second = 0;
  for (int i = 0; i < count; ++i) {
    const int at = start + step * i;
    const Entry& e = entries_[static_cast<std::size_t>(at)];
    const double value = x(at, column) + next;
    x(at, column) = value;
    next = second - e.first * value;
    second = -e.second * value;
  }
  return {next, second};
}

void BandedFactor::backward(int count, int start, int step, RowMatrix& x) const {
  for (int i = count - 1; i >= 0; --i) {
    const int at = start + step * i;
    const Entry& e = entries_[static_cast<std::size_t>(at)];
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      x(at, c) = x(at, c) * e.inverse - e.first * x(at + step, c) - e.second * x(at + 2 * step, c);
  }
}

void BandedFactor::solve(RowMatrix& x) const {
  const std::array counts = {middle_, size_ - 2 - middle_}, starts = {0, size_ - 1}, steps = {1, -1};
  std::array<RowMatrix, 2> rest;
#pragma omp parallel for schedule(static) num_threads(2) if (size_ > smallest_shared)
  for (std::size_t side = 0; side < 2; ++side) {
    rest[side].resize(2, x.cols());
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      const auto sums = forward(counts[side], starts[side], steps[side], x, c);
      rest[side].col(c) << sums[0], sums[1];
    }
  }
  x.row(middle_) += rest[0].row(0) + rest[1].row(1);
  x.row(middle_ + 1) += rest[0].row(1) + rest[1].row(0);
  x.middleRows(middle_, 2) = core_.inverse() * x.middleRows(middle_, 2);
#pragma omp parallel for schedule(static) num_threads(2) if (size_ > smallest_shared)
  for (std::size_t side = 0; side < 2; ++side) backward(counts[side], starts[side], steps[side], x);
}

}  // namespace batten
