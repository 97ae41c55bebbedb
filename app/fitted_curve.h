// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/curve_input.h>
#include <batten/app/progress.h>
#include <batten/fem/bounded_curve.h>

#include <optional>
#include <variant>

namespace batten {

/// The curve that is asked for with --scheme natural-cubic.
struct FittedCurve {
  std::variant<NaturalCubic, HermiteCurve> curve;  ///< HermiteCurve: --minimum or --maximum
  std::optional<CurveAccount> account;             ///< of curves under constraints
  Eigen::MatrixXd values;                          ///< at the points
  double energy = 0;                               ///< ∫ |p''|² with the parameters of the input
  double normalised_energy = 0;                    ///< with the parameter from 0 to 1
};

/// Throws UsageError for options of natural cubics that do not fit each other or the columns.
void check_fit(const SubdivideArguments& arguments);

/// With the points as coefficients, or through, near or within bounds of them. Throws InvalidInput that names the lines
/// of what cannot be kept.
FittedCurve fitted_curve(const SubdivideArguments& arguments, const CurveInput& input, Progress& progress);

/// Whether there are bounds that the curve keeps everywhere.
bool is_bounded(const SubdivideArguments& arguments);

}  // namespace batten
