// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

// The least ½ x·G x - a·x with n_i·x >= b_i by dual active sets [Goldfarb & Idnani 1983]: dense, exact to rounding, and
// nothing in common with interior points.
namespace batten::test {

struct HalfSpace {
  Eigen::VectorXd normal;
  double bound;
};

/// The constraint that x violates most, if any by more than what is rounding to the caller.
using MostViolated = std::function<const HalfSpace*(const Eigen::VectorXd& x)>;

class QuadraticProgram {
public:
  /// G symmetric and positive definite.
  QuadraticProgram(const Eigen::MatrixXd& g, const Eigen::VectorXd& a) : inverse_(g), x_(inverse_.solve(a)) {}

  Eigen::VectorXd solve(const MostViolated& most_violated) {
    for (int k = 0; k < 20000; ++k) {
      const HalfSpace* const next = most_violated(x_);
      if (next == nullptr) return x_;
      add(*next);
    }
    throw std::runtime_error("QuadraticProgram: no end");
  }

private:
  void add(const HalfSpace& one) {
    double own = 0;  // multiplier
    const Eigen::VectorXd image = inverse_.solve(one.normal);
    for (;;) {
      const auto count = static_cast<Eigen::Index>(active_.size());
      Eigen::MatrixXd normals(x_.size(), count), images(x_.size(), count);
      for (Eigen::Index j = 0; j < count; ++j) {
        normals.col(j) = active_[static_cast<std::size_t>(j)].normal;
        images.col(j) = images_[static_cast<std::size_t>(j)];
      }
      const Eigen::VectorXd r =
          count == 0 ? Eigen::VectorXd()
                     : Eigen::VectorXd((normals.transpose() * images).ldlt().solve(images.transpose() * one.normal));
      const Eigen::VectorXd z = count == 0 ? image : Eigen::VectorXd(image - images * r);
      const double along = z.dot(one.normal);
      double dual = std::numeric_limits<double>::infinity();
      std::size_t leaves = 0;
      for (std::size_t j = 0; j < active_.size(); ++j) {
        const double change = r[static_cast<Eigen::Index>(j)];
        if (change > 0 && multipliers_[j] / change < dual) dual = multipliers_[j] / change, leaves = j;
      }
      const bool is_free = along > 1e-14 * image.dot(one.normal);
      const double primal =
          is_free ? (one.bound - one.normal.dot(x_)) / along : std::numeric_limits<double>::infinity();
      const double step = std::min(primal, dual);
      if (!std::isfinite(step)) throw std::runtime_error("QuadraticProgram: no point is feasible");
      if (is_free) x_ += step * z;
      own += step;
      for (std::size_t j = 0; j < active_.size(); ++j) multipliers_[j] -= step * r[static_cast<Eigen::Index>(j)];
      if (primal <= dual) break;
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(leaves));
      images_.erase(images_.begin() + static_cast<std::ptrdiff_t>(leaves));
      multipliers_.erase(multipliers_.begin() + static_cast<std::ptrdiff_t>(leaves));
    }
    active_.push_back(one);
    images_.push_back(image);
    multipliers_.push_back(own);
  }

  Eigen::LLT<Eigen::MatrixXd> inverse_;
  Eigen::VectorXd x_;
  std::vector<HalfSpace> active_;
  std::vector<Eigen::VectorXd> images_;  // G^-1 of their normals
  std::vector<double> multipliers_;
};

}  // namespace batten::test
