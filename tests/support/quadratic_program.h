// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

// The least ½ x·G x - a·x with n_i·x >= b_i by dual active sets [Goldfarb & Idnani 1983]: dense, in long doubles, and
// nothing in common with interior points.
namespace batten::test {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct HalfSpace {
  Eigen::VectorXd normal;
  double bound;
};

/// The constraint that x violates most, if any by more than what is rounding to the caller.
using MostViolated = std::function<const HalfSpace*(const Eigen::VectorXd& x)>;

class QuadraticProgram {
public:
  /// G symmetric and positive definite.
  QuadraticProgram(const Eigen::MatrixXd& g, const Eigen::VectorXd& a) : inverse_(LongMatrix(g.cast<long double>())) {
    const LongVector right = a.cast<long double>();
    x_ = inverse_.solve(right);
  }

  Eigen::VectorXd solve(const MostViolated& most_violated) {
    for (int k = 0; k < 20000; ++k) {
      const HalfSpace* const next = most_violated(x_.cast<double>());
      if (next == nullptr) return x_.cast<double>();
      add(next->normal.cast<long double>(), next->bound);
    }
    throw std::runtime_error("QuadraticProgram: no end");
  }

private:
  struct Constraint {
    LongVector normal, image;  // G^-1 of the normal
    long double multiplier = 0;
  };
  static constexpr long double infinity = std::numeric_limits<long double>::infinity();

  /// How much the active multipliers must change for each unit of a new one, so that active constraints stay.
  LongVector response(const LongVector& image) const {
    const auto count = static_cast<Eigen::Index>(active_.size());
    LongMatrix products(count, count);
    LongVector right(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const LongVector& normal = active_[static_cast<std::size_t>(i)].normal;
      right[i] = normal.dot(image);
      for (Eigen::Index j = 0; j < count; ++j) products(i, j) = normal.dot(active_[static_cast<std::size_t>(j)].image);
    }
    return count == 0 ? right : LongVector(products.ldlt().solve(right));
  }

  void add(const LongVector& normal, long double bound) {
    Constraint one{normal, inverse_.solve(normal), 0};
    for (;;) {
      const LongVector r = response(one.image);
      LongVector z = one.image;
      long double dual = infinity;
      std::size_t leaves = 0;
      for (std::size_t j = 0; j < active_.size(); ++j) {
        const long double change = r[static_cast<Eigen::Index>(j)];
        z -= change * active_[j].image;
        if (!(change > 0) || !(active_[j].multiplier / change < dual)) continue;
        dual = active_[j].multiplier / change;
        leaves = j;
      }
      const long double along = z.dot(normal);
      const bool is_free = along > 1e-17L * one.image.dot(normal);
      const long double primal = is_free ? (bound - normal.dot(x_)) / along : infinity;
      const long double step = std::min(primal, dual);
      if (step == infinity) throw std::runtime_error("QuadraticProgram: no point is feasible");
      if (is_free) x_ += step * z;
      one.multiplier += step;
      for (std::size_t j = 0; j < active_.size(); ++j) active_[j].multiplier -= step * r[static_cast<Eigen::Index>(j)];
      if (primal <= dual) break;
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(leaves));
    }
    active_.push_back(one);
  }

  Eigen::LLT<LongMatrix> inverse_;
  LongVector x_;
  std::vector<Constraint> active_;
};

}  // namespace batten::test
