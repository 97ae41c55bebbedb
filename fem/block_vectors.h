// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <span>

namespace batten {

// Products of long vectors and of tall matrices, a few columns of many rows. Rows are cut into fixed blocks: all
// threads, the same bits for every number of them.

double dot(std::span<const double> a, std::span<const double> b);

/// y = a x + b y.
void combine(double a, std::span<const double> x, double b, std::span<double> y);

/// A^T B.
Eigen::MatrixXd tall_products(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);

/// Replaces the first columns of `a` by A C.
void recombine(Eigen::Ref<Eigen::MatrixXd> a, const Eigen::MatrixXd& c);

/// A -= B C.
void subtract_product(Eigen::Ref<Eigen::MatrixXd> a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      const Eigen::MatrixXd& c);

/// T with T^T G T = I for the Gram matrix G of some vectors, as many columns as they are numerically independent: G
/// with unit diagonal is diagonalised, and what lies below rounding left out [Stathopoulos & Wu 2002].
Eigen::MatrixXd orthonormalisation(const Eigen::MatrixXd& gram);

}  // namespace batten
