// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/fem/curve_checks.h>
#include <batten/fem/natural_cubic.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace batten {

namespace {

/// Whether is_sound(begin, end) of each block of n numbers.
template <class Test>
bool all_blocks(int n, const Test& is_sound) {
  return sum_blocks(RowBlocks(n, 1), [&](int begin, int end) { return is_sound(begin, end) ? 0. : 1.; }) == 0;
}

bool increase(const std::vector<double>& knots) {
  return all_blocks(static_cast<int>(knots.size()) - 1,
                    [&](int begin, int end) { return increases(knots.data() + begin, end - begin); });
}

bool are_finite(const Eigen::MatrixXd& m) {
  return all_blocks(static_cast<int>(m.size()),
                    [&](int begin, int end) { return is_finite(m.data() + begin, end - begin); });
}

}  // namespace

NaturalCubic::NaturalCubic(std::vector<double> knots, Eigen::MatrixXd coefficients, bool closed)
    : knots_(std::move(knots)), coefficients_(std::move(coefficients)), closed_(closed) {
  require(knots_, coefficients_, closed_);
}

NaturalCubic NaturalCubic::of_checked(std::vector<double> knots, Eigen::MatrixXd coefficients, bool closed) {
  NaturalCubic curve;
  curve.knots_ = std::move(knots);
  curve.coefficients_ = std::move(coefficients);
  curve.closed_ = closed;
  return curve;
}

void NaturalCubic::require_sizes(const std::vector<double>& knots, const Eigen::MatrixXd& coefficients, bool closed) {
  const std::size_t least = closed ? 4 : 2;
  if (knots.size() < least)
    throw InvalidInput("NaturalCubic: at least " + std::to_string(least) + " knots are needed" +
                       (closed ? " for a closed curve" : "") + ", found " + std::to_string(knots.size()));
  const auto expected = static_cast<Eigen::Index>(knots.size()) - (closed ? 1 : 0);
  if (coefficients.rows() != expected)
    throw InvalidInput("NaturalCubic: " + std::to_string(knots.size()) + " knots have " + std::to_string(expected) +
                       " coefficients, found " + std::to_string(coefficients.rows()));
}

void NaturalCubic::require(const std::vector<double>& knots, const Eigen::MatrixXd& coefficients, bool closed) {
  require_sizes(knots, coefficients, closed);
  if (!increase(knots))
    for (std::size_t i = 0; i + 1 < knots.size(); ++i)
      if (!(knots[i] < knots[i + 1]) || !std::isfinite(knots[i + 1] - knots[i]))
        throw InvalidInput("NaturalCubic: knots must increase, found " + std::to_string(knots[i]) + " and " +
                           std::to_string(knots[i + 1]) + " at places " + std::to_string(i) + " and " +
                           std::to_string(i + 1));
  if (!are_finite(coefficients)) throw InvalidInput("NaturalCubic: coefficients must be finite, found one that is not");
}

double NaturalCubic::width(int cell) const {
  if (closed_)
    cell = (cell + 2 * cells()) % cells();
  else
    cell = std::clamp(cell, 0, cells() - 1);
  const auto k = static_cast<std::size_t>(cell);
  return knots_[k + 1] - knots_[k];
}

Eigen::Index NaturalCubic::row(int knot) const { return closed_ ? (knot + 2 * cells()) % cells() : knot; }

NaturalCubic NaturalCubic::from_values(std::vector<double> knots, const Eigen::MatrixXd& values,
                                       const Eigen::MatrixXd& second_derivatives, bool closed) {
  NaturalCubic curve(std::move(knots), values, closed);
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const auto f = values.col(c), g = second_derivatives.col(c);
    auto p = curve.coefficients_.col(c);
    for (int i = closed ? 0 : 1; i < curve.cells(); ++i) {
      const double before = curve.width(i - 1), after = curve.width(i);
      const Eigen::Index next = curve.row(i + 1);
      const double slope = (f[next] - f[i]) / after - after * (2 * g[i] + g[next]) / 6;
      p[i] = f[i] + slope * (after - before) / 3 - g[i] * before * after / 6;
    }
  }
  return curve;
}

NaturalCubic::Weights NaturalCubic::value_weights(int i) const {
  const double a = width(i - 2), b = width(i - 1), c = width(i), d = width(i + 1);
  return {c * c / ((a + b + c) * (b + c)), b * b / ((b + c + d) * (b + c))};
}

NaturalCubic::Weights NaturalCubic::bend_weights(int i) const {
  const double a = width(i - 2), b = width(i - 1), c = width(i), d = width(i + 1);
  return {6 / ((a + b + c) * (b + c)), 6 / ((b + c + d) * (b + c))};
}

Eigen::RowVectorXd NaturalCubic::value_at(int knot) const {
  const auto middle = coefficients_.row(row(knot));
  if (is_end(knot)) return middle;
  const Weights w = value_weights(knot);
  return middle + w.before * (coefficients_.row(row(knot - 1)) - middle) +
         w.after * (coefficients_.row(row(knot + 1)) - middle);
}

Eigen::RowVectorXd NaturalCubic::bend_at(int knot) const {
  if (is_end(knot)) return Eigen::RowVectorXd::Zero(dimension());
  const auto middle = coefficients_.row(row(knot));
  const Weights w = bend_weights(knot);
  return w.after * (coefficients_.row(row(knot + 1)) - middle) - w.before * (middle - coefficients_.row(row(knot - 1)));
}

Eigen::MatrixXd NaturalCubic::values() const {
  Eigen::MatrixXd result(rows(), dimension());
  for (Eigen::Index i = 0; i < rows(); ++i) result.row(i) = value_at(static_cast<int>(i));
  return result;
}

Eigen::MatrixXd NaturalCubic::second_derivatives() const {
  Eigen::MatrixXd result(rows(), dimension());
  for (Eigen::Index i = 0; i < rows(); ++i) result.row(i) = bend_at(static_cast<int>(i));
  return result;
}

Eigen::MatrixXd NaturalCubic::forces() const {
  const Eigen::MatrixXd g = second_derivatives();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows(), dimension());
  for (int cell = 0; cell < cells(); ++cell) {
    const Eigen::Index left = row(cell), right = row(cell + 1);
    const Eigen::RowVectorXd third = (g.row(right) - g.row(left)) / width(cell);
    result.row(left) += third;
    result.row(right) -= third;
  }
  return result;
}

double NaturalCubic::energy() const {
  const Eigen::MatrixXd g = second_derivatives();
  double sum = 0;
  for (int cell = 0; cell < cells(); ++cell) {
    const auto left = g.row(row(cell)), right = g.row(row(cell + 1));
    sum += width(cell) * (left.squaredNorm() + left.dot(right) + right.squaredNorm()) / 3;
  }
  return sum;
}

NaturalCubic NaturalCubic::refined() const {
  NaturalCubic fine;
  fine.closed_ = closed_;
  for (int cell = 0; cell < cells(); ++cell) {
    const auto k = static_cast<std::size_t>(cell);
    fine.knots_.push_back(knots_[k]);
    fine.knots_.push_back(std::midpoint(knots_[k], knots_[k + 1]));
  }
  fine.knots_.push_back(knots_.back());
  fine.coefficients_.resize(2 * rows() - (closed_ ? 0 : 1), dimension());
  for (int i = 0; i < cells(); ++i) {  // (t_i, m_i, t_(i+1)) lies between the blossoms at t_(i-1) and at t_(i+2)
    const double b = width(i - 1), c = width(i), d = width(i + 1), w = (b + c / 2) / (b + c + d);
    fine.coefficients_.row(2 * i + 1) = (1 - w) * coefficients_.row(i) + w * coefficients_.row(row(i + 1));
  }
  for (int i = 0; i <= cells() - (closed_ ? 1 : 0); ++i) {
    if (!closed_ && (i == 0 || i == cells())) {
      fine.coefficients_.row(2 * i) = coefficients_.row(i);
      continue;
    }
    // (m_(i-1), t_i, m_i) lies between (t_(i-1), t_i, m_i) and (t_(i+1), t_i, m_i)
    const double a = width(i - 2), b = width(i - 1), c = width(i);
    const double w = (a + b + c / 2) / (a + b + c), v = b / 2 / (b + c);
    const Eigen::RowVectorXd left = (1 - w) * coefficients_.row(row(i - 1)) + w * coefficients_.row(i);
    fine.coefficients_.row(2 * i) = (1 - v) * left + v * fine.coefficients_.row(2 * i + 1);
  }
  return fine;
}

Eigen::MatrixXd NaturalCubic::bezier() const {
  const Eigen::MatrixXd f = values(), g = second_derivatives();
  Eigen::MatrixXd points(3 * cells() + 1, dimension());
  for (int cell = 0; cell < cells(); ++cell) {
    const double h = width(cell);
    const auto left = f.row(row(cell)), right = f.row(row(cell + 1));
    const auto bend_left = g.row(row(cell)), bend_right = g.row(row(cell + 1));
    points.row(3 * cell) = left;
    points.row(3 * cell + 1) = (2 * left + right) / 3 - h * h * (2 * bend_left + bend_right) / 18;
    points.row(3 * cell + 2) = (left + 2 * right) / 3 - h * h * (bend_left + 2 * bend_right) / 18;
  }
  points.row(3 * cells()) = f.row(row(cells()));
  return points;
}

Eigen::VectorXd NaturalCubic::derivative(double t, int order) const {
  if (!std::isfinite(t) || order < 0)
    throw InvalidInput("NaturalCubic::derivative: t must be finite and the order not negative, found " +
                       std::to_string(t) + " and " + std::to_string(order));
  const double period = knots_.back() - knots_.front();
  if (closed_) t -= period * std::floor((t - knots_.front()) / period);
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
  const int cell = static_cast<int>(above - knots_.begin()) - 1;
  const double h = width(cell), u = t - knots_[static_cast<std::size_t>(cell)];
  Eigen::RowVectorXd value = value_at(cell), bend = bend_at(cell);
  const Eigen::RowVectorXd next = value_at(cell + 1), bend_next = bend_at(cell + 1);
  Eigen::RowVectorXd slope = (next - value) / h - h * (2 * bend + bend_next) / 6, third = (bend_next - bend) / h;
  double from = u;  // beyond the ends the polynomial is a straight line from there
  if (!closed_ && (t < knots_.front() || t > knots_.back())) {
    if (t > knots_.back()) {
      slope += h * (bend + h / 2 * third);
      value = next;
      from = t - knots_.back();
    }
    bend.setZero();
    third.setZero();
  }
  if (order == 0) return value + from * (slope + from / 2 * (bend + from / 3 * third));
  if (order == 1) return slope + from * (bend + from / 2 * third);
  if (order == 2) return bend + from * third;
  return order == 3 ? third : Eigen::RowVectorXd::Zero(dimension());
}

}  // namespace batten
