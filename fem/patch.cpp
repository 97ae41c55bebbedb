// SPDX-License-Identifier: MIT
#include <batten/fem/patch.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace batten {
namespace {

using Matrix = Eigen::MatrixXd;
using Eigen::Index;

/// The functions of the patch's cells and their energy on it.
struct LocalEnergy {
  int begin_x, begin_y, width;  // of the block of functions
  std::vector<int> number;      // local number in the block, -1: none
  Matrix E;

  int local(int gx, int gy) const {
    const int i = gx - begin_x, j = gy - begin_y;
    const int height = static_cast<int>(number.size()) / width;
    return i < 0 || j < 0 || i >= width || j >= height ? -1 : number[static_cast<std::size_t>(i + j * width)];
  }
};

LocalEnergy assemble(const PatchedStep& step, const Patch& p) {
  const SplineLevel& fine = step.fine;
  const auto &bx = fine.x().breakpoints(), &by = fine.y().breakpoints();
  const int dx = fine.x().degree(), dy = fine.y().degree(), side = dx + 1;
  const int begin_x = bx.first_child(p.first_x), end_x = bx.first_child(p.last_x + 1);
  const int begin_y = fine.is_interval() ? 0 : by.first_child(p.first_y);
  const int end_y = fine.is_interval() ? 1 : by.first_child(p.last_y + 1);
  const int width = end_x - begin_x + dx, height = end_y - begin_y + dy;
  LocalEnergy local{begin_x, begin_y, width, std::vector<int>(static_cast<std::size_t>(width * height), -1), {}};
  const auto place = [&](int cx, int cy, int a) {
    return static_cast<std::size_t>(cx - begin_x + a % side + (cy - begin_y + a / side) * width);
  };
  const auto for_cells = [&](auto&& work) {
    for (int cy = begin_y; cy < end_y; ++cy)
      for (int cx = begin_x; cx < end_x; ++cx)
        if (fine.is_inside(cx, cy)) work(cx, cy);
  };
  for_cells([&](int cx, int cy) {
    for (int a = 0; a < fine.local_size(); ++a) local.number[place(cx, cy, a)] = 0;
  });
  int count = 0;
  for (int& n : local.number)
    if (n == 0) n = count++;
  local.E = Matrix::Zero(count, count);
  for_cells([&](int cx, int cy) {
    const auto e = fine.element(cx, cy);
    for (int b = 0; b < fine.local_size(); ++b)
      for (int a = 0; a < fine.local_size(); ++a)
        local.E(local.number[place(cx, cy, a)], local.number[place(cx, cy, b)]) += e(a, b);
  });
  return local;
}

/// A measurement in local numbers: w_p q_p + Σ w_a q_a = m, p its private function.
struct LocalMeasurement {
  int place, p;
  double pivot;
  std::vector<std::pair<int, double>> others;
};

/// Exchanges the variables q_p for the measurements' values m, q_p = (m - Σ w_a q_a) / w_p: the columns of E T for the
/// variables T (q, m) = q. Row and column p then belong to m.
void exchange_columns(Matrix& E, const std::vector<LocalMeasurement>& measurements) {
  for (const auto& m : measurements) {
    for (const auto& [a, w] : m.others) E.col(a) -= w / m.pivot * E.col(m.p);
    E.col(m.p) /= m.pivot;
  }
}

/// The measurement of a row of M; nothing if some function of it is not local.
std::optional<LocalMeasurement> local_measurement(const PatchedStep& step, int row, const LocalEnergy& local) {
  const int width = step.fine.x().size(), pivot = step.private_functions[static_cast<std::size_t>(row)];
  LocalMeasurement m{step.measurements.place[static_cast<std::size_t>(row)], -1, 0, {}};
  for (MeasurementMatrix::Matrix::InnerIterator e(step.measurements.M, row); e; ++e) {
    const int grid = step.fine.grid(static_cast<int>(e.col()));
    const int a = local.local(grid % width, grid / width);
    if (a < 0) return {};
    if (e.col() != pivot) {
      m.others.emplace_back(a, e.value());
    } else {
      m.p = a;
      m.pivot = e.value();
    }
  }
  return m;
}

std::vector<LocalMeasurement> local_measurements(const PatchedStep& step, const Patch& patch,
                                                 const LocalEnergy& local) {
  std::vector<LocalMeasurement> result;
  for (int j = patch.places_y.begin; j < patch.places_y.end; ++j)
    for (int i = patch.places_x.begin; i < patch.places_x.end; ++i) {
      const int row = step.measurements.row[static_cast<std::size_t>(i + j * step.measurements.places_x)];
      if (row < 0) continue;
      if (auto m = local_measurement(step, row, local)) result.push_back(std::move(*m));
    }
  return result;
}

/// K = U^T U, keeping to the profile of K: functions are numbered row by row, which leaves most of it zero.
class ProfileCholesky {
public:
  explicit ProfileCholesky(Matrix K) : U_(std::move(K)), first_(static_cast<std::size_t>(U_.cols())) {
    const double scale = U_.rows() == 0 ? 0 : U_.diagonal().maxCoeff();
    for (Index j = 0; j < U_.cols(); ++j) {
      Index& first = first_[static_cast<std::size_t>(j)];
      while (first < j && U_(first, j) == 0) ++first;
      for (Index i = first; i < j; ++i) {
        const Index start = std::max(first, first_[static_cast<std::size_t>(i)]);
        U_(i, j) -= U_.col(i).segment(start, i - start).dot(U_.col(j).segment(start, i - start));
        U_(i, j) /= U_(i, i);
      }
      const double pivot = U_(j, j) - U_.col(j).segment(first, j - first).squaredNorm();
      // The least pivot of a singular matrix is of the size of its rounding.
      is_definite_ = is_definite_ && pivot > 1e-12 * scale;
      if (!is_definite_) return;
      U_(j, j) = std::sqrt(pivot);
    }
  }

  bool is_definite() const { return is_definite_; }
  /// Replaces the columns of B by K^-1 B.
  void solve(Matrix& B) const {
    for (Index c = 0; c < B.cols(); ++c) {
      auto b = B.col(c);
      for (Index j = 0; j < U_.cols(); ++j) b[j] = (b[j] - above(j).dot(b.segment(first(j), j - first(j)))) / U_(j, j);
      for (Index j = U_.cols(); j-- > 0;) {
        b[j] /= U_(j, j);
        b.segment(first(j), j - first(j)) -= b[j] * above(j);
      }
    }
  }

private:
  Index first(Index j) const { return first_[static_cast<std::size_t>(j)]; }
  Matrix::ConstColXpr::ConstSegmentReturnType above(Index j) const { return U_.col(j).segment(first(j), j - first(j)); }

  Matrix U_;
  std::vector<Index> first_;  // row of the first entry of each column
  bool is_definite_ = true;
};

}  // namespace

PatchSolution solve_patch(const PatchedStep& step, const Patch& patch, const std::vector<int>& functions) {
  LocalEnergy local = assemble(step, patch);
  const auto measurements = local_measurements(step, patch, local);
  exchange_columns(local.E, measurements);
  local.E.transposeInPlace();
  exchange_columns(local.E, measurements);
  PatchSolution result;
  std::vector<int> measured, unknowns, position(static_cast<std::size_t>(local.E.rows()), 0);
  for (const auto& m : measurements) {
    result.places.push_back(m.place);
    measured.push_back(m.p);
    position[static_cast<std::size_t>(m.p)] = -1;
  }
  for (std::size_t a = 0; a < position.size(); ++a) {
    if (position[a] < 0) continue;
    position[a] = static_cast<int>(unknowns.size());
    unknowns.push_back(static_cast<int>(a));
  }
  const ProfileCholesky factor(local.E(unknowns, unknowns));
  if (!factor.is_definite()) return {};
  const int width = step.fine.x().size();
  Matrix asked = Matrix::Zero(static_cast<Eigen::Index>(unknowns.size()), static_cast<Eigen::Index>(functions.size()));
  for (std::size_t f = 0; f < functions.size(); ++f) {
    const int grid = step.fine.grid(functions[f]);
    const int a = local.local(grid % width, grid / width);
    asked(position[static_cast<std::size_t>(a)], static_cast<Eigen::Index>(f)) = 1;
  }
  factor.solve(asked);
  result.weights = -asked.transpose() * local.E(unknowns, measured);
  return result;
}

}  // namespace batten
