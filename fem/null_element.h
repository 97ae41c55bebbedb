// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/feasible_set.h>

#include <Eigen/Core>

#include <optional>

namespace batten {

/// Coefficients a with rows · a in the set, of functions without energy that have these rows: none where there are
/// none, or hardly. A few unknowns, any number of rows.
std::optional<Eigen::VectorXd> element_within(const Eigen::MatrixXd& rows, FeasibleSet& set);

}  // namespace batten
