// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace batten {

/// The coefficients of σ^0 .. σ^(terms - 1) in exp(A + B σ): the first block column of the exponential of the block
/// bidiagonal Toeplitz matrix with A on the diagonal and B below. One term is exp(A). By scaling and squaring of the
/// Taylor series; the relative error grows like ε |A|.
std::vector<Eigen::MatrixXcd> shift_exponential(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B,
                                                std::size_t terms);

}  // namespace batten
