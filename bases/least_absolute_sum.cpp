// SPDX-License-Identifier: MIT
#include <batten/bases/least_absolute_sum.h>
#include <batten/domains/errors.h>

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <string>

namespace batten {
namespace {

constexpr double tolerance = 1e-8;  // relative, of prices against costs

/// Dual prices y tell the column to enter: y·A_j may not exceed costs_j in magnitude. The basis holds signed columns,
/// so that all values are >= 0.
class Simplex {
public:
  Simplex(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b,
          const Eigen::Ref<const Eigen::VectorXd>& costs)
      : a_(a), costs_(costs.head(a.cols())), inverse_(Eigen::MatrixXd::Zero(a.rows(), a.rows())), values_(b) {
    const double size = std::max(b.cwiseAbs().maxCoeff(), 1.);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      // Shaken a little, all different, so that no step is of length zero and the search cannot go in circles.
      const double shaken = b[i] + 1e-7 * size * (0.5 + std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.));
      inverse_(i, i) = (shaken < 0 ? -1 : 1) / std::abs(a(i, i));  // of the column with the sign of b_i
      basis_.push_back(static_cast<int>(i));
      values_[i] = std::abs(shaken / a(i, i));
    }
  }

  /// One exchange; false at the optimum.
  bool improve() {
    Eigen::VectorXd basic_costs(a_.rows());
    for (Eigen::Index i = 0; i < a_.rows(); ++i) basic_costs[i] = costs_[basis_[static_cast<std::size_t>(i)]];
    const Eigen::VectorXd prices = a_.transpose() * (inverse_.transpose() * basic_costs);
    Eigen::Index entering = 0;
    if (prices.cwiseAbs().cwiseQuotient(costs_).maxCoeff(&entering) <= 1 + tolerance) return false;
    const double sign = prices[entering] < 0 ? -1 : 1;
    const Eigen::VectorXd direction = inverse_ * (sign * a_.col(entering));
    exchange(entering, leaving_row(direction), direction);
    return true;
  }

  const std::vector<int>& basis() const { return basis_; }

private:
  Eigen::Index leaving_row(const Eigen::VectorXd& direction) const {
    Eigen::Index row = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < direction.size(); ++i) {
      if (direction[i] <= 1e-9 || values_[i] / direction[i] >= least) continue;
      least = values_[i] / direction[i];
      row = i;
    }
    if (row < 0) throw SolverError("least_absolute_sum: found a direction without end, costs must be positive");
    return row;
  }

  void exchange(Eigen::Index entering, Eigen::Index row, const Eigen::VectorXd& direction) {
    const double length = values_[row] / direction[row];
    values_ = (values_ - length * direction).cwiseMax(0.);
    values_[row] = length;
    inverse_.row(row) /= direction[row];
    const Eigen::RowVectorXd pivot = inverse_.row(row);
    Eigen::VectorXd others = direction;
    others[row] = 0;
    inverse_.noalias() -= others * pivot;
    basis_[static_cast<std::size_t>(row)] = static_cast<int>(entering);
  }

  const Eigen::Ref<const Eigen::MatrixXd>& a_;
  Eigen::VectorXd costs_;
  Eigen::MatrixXd inverse_;
  Eigen::VectorXd values_;
  std::vector<int> basis_;
};

}  // namespace

BasicSolution least_absolute_sum(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                                 const Eigen::Ref<const Eigen::VectorXd>& costs) {
  if (a.rows() != b.size() || a.cols() < a.rows() || costs.size() < a.cols())
    throw InvalidInput("least_absolute_sum: sizes must fit, found " + std::to_string(a.rows()) + " x " +
                       std::to_string(a.cols()) + ", " + std::to_string(b.size()) + " and " +
                       std::to_string(costs.size()));
  if (a.rows() == 0) return {};
  Simplex simplex(a, b, costs);
  for (Eigen::Index steps = 0; simplex.improve(); ++steps)
    if (steps > 50 * (a.rows() + a.cols()))
      throw SolverError("least_absolute_sum: no optimum in " + std::to_string(steps) + " steps");
  BasicSolution solution{simplex.basis(), {}, 0};
  Eigen::MatrixXd basis(a.rows(), a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) basis.col(i) = a.col(solution.basis[static_cast<std::size_t>(i)]);
  solution.values = basis.partialPivLu().solve(b);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    solution.cost += costs[solution.basis[static_cast<std::size_t>(i)]] * std::abs(solution.values[i]);
  return solution;
}

}  // namespace batten
