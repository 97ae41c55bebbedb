// SPDX-License-Identifier: MIT
#include <batten/flows/quadratic_pairs.h>

#include <Eigen/Dense>

#include <algorithm>

namespace batten {
namespace {

using Row = Eigen::Matrix<double, 1, 6>;  // what is asked of c: p = c0 + c1 s + c2 t + c3 s² + c4 s t + c5 t²
enum class Asked { OfFunctions, OfVelocities };

void ask_value(std::vector<Row>& rows, bool is_s, double at, Asked asked) {
  Row constant, linear, square;
  if (is_s) {
    constant << 1, at, 0, at * at, 0, 0;
    linear << 0, 0, 1, 0, at, 0;
    square << 0, 0, 0, 0, 0, 1;
  } else {
    constant << 1, 0, at, 0, 0, at * at;
    linear << 0, 1, 0, 0, at, 0;
    square << 0, 0, 0, 1, 0, 0;
  }
  if (asked == Asked::OfFunctions) rows.push_back(constant);
  rows.insert(rows.end(), {linear, square});
}

void ask_slope(std::vector<Row>& rows, bool is_s, double at) {
  Row constant = Row::Zero(), linear = Row::Zero();
  constant[is_s ? 1 : 2] = 1;
  constant[is_s ? 3 : 5] = 2 * at;
  linear[4] = 1;
  rows.insert(rows.end(), {constant, linear});
}

void ask_period(std::vector<Row>& rows, bool is_s, Asked asked) {
  for (const int k : {is_s ? 1 : 2, is_s ? 3 : 5, 4}) {
    if (k < 3 && asked == Asked::OfVelocities) continue;
    rows.emplace_back(Row::Zero())[k] = 1;
  }
}

std::vector<Row> rows_of(const SpaceEnds& ends, double half_x, double half_y, Asked asked) {
  std::vector<Row> rows;
  const auto ask = [&](EndCondition condition, bool is_s, double at) {
    using enum EndCondition;
    if (condition == Zero || condition == Clamped) ask_value(rows, is_s, at, asked);
    if (condition == Flat || condition == Clamped) ask_slope(rows, is_s, at);
    if (condition == Periodic) ask_period(rows, is_s, asked);
  };
  ask(ends.x.lower, true, -half_x);
  ask(ends.x.upper, true, half_x);
  ask(ends.y.lower, false, -half_y);
  ask(ends.y.upper, false, half_y);
  return rows;
}

/// ψ_t + φ_s = 0 and φ_t - ψ_s = 0, coefficient by coefficient.
Eigen::Matrix<double, 6, 12> cancelling_rows() {
  Eigen::Matrix<double, 6, 12> m = Eigen::Matrix<double, 6, 12>::Zero();
  const auto set = [&](int row, int psi, double a, int phi, double b) {
    m(row, psi) = a;
    m(row, 6 + phi) = b;
  };
  set(0, 2, 1, 1, 1);
  set(1, 4, 1, 3, 2);
  set(2, 5, 2, 4, 1);
  set(3, 1, -1, 2, 1);
  set(4, 3, -2, 4, 1);
  set(5, 4, -1, 5, 2);
  return m;
}

std::vector<QuadraticPair> pairs(const Rectangle& region, const FlowSides& sides, Asked asked, bool cancel) {
  const auto &x = region.x, &y = region.y;
  const double length = std::max(x.length(), y.length());
  const auto rows = [&](bool is_potential) {
    return rows_of(side_conditions(sides, {is_potential, true}), x.length() / length / 2, y.length() / length / 2,
                   asked);
  };
  const auto psi = rows(false), phi = rows(true);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(psi.size() + phi.size()) + 9, 12);
  Eigen::Index next = 0;
  for (const Row& row : psi) m.row(next++).head<6>() = row;
  for (const Row& row : phi) m.row(next++).tail<6>() = row;
  if (cancel) m.middleRows<6>(next) = cancelling_rows();
  if (asked == Asked::OfVelocities) m(next + 6, 0) = m(next + 7, 6) = 1;  // no constants
  Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
  lu.setThreshold(1e-10);
  std::vector<QuadraticPair> result;
  if (lu.dimensionOfKernel() == 0) return result;
  const Eigen::MatrixXd kernel = lu.kernel();
  for (Eigen::Index k = 0; k < kernel.cols(); ++k) {
    QuadraticFunction q{{}, x.lower() + x.length() / 2, y.lower() + y.length() / 2, length}, p = q;
    std::copy_n(kernel.col(k).data(), 6, q.c.begin());
    std::copy_n(kernel.col(k).data() + 6, 6, p.c.begin());
    result.push_back({q, p});
  }
  return result;
}

}  // namespace

std::vector<QuadraticPair> unseen_pairs(const Rectangle& region, const FlowSides& sides) {
  return pairs(region, sides, Asked::OfFunctions, true);
}

std::vector<QuadraticPair> pairs_without_energy(const Rectangle& region, const FlowSides& sides) {
  return pairs(region, sides, Asked::OfFunctions, false);
}

std::vector<QuadraticPair> exchangeable_pairs(const Rectangle& region, const FlowSides& sides) {
  return pairs(region, sides, Asked::OfVelocities, true);
}

}  // namespace batten
