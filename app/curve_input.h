// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace batten {

/// The points of a curve, one row each, and their parameters (one more when closed).
struct CurveInput {
  std::vector<std::string> names;  ///< of the columns
  Eigen::MatrixXd points;
  std::vector<double> knots;
  std::vector<double> tolerances;  ///< of --tolerance-column
  std::vector<std::size_t> lines;  ///< of the file, of each point
};

/// Throws UsageError for options that do not fit, InvalidInput and IoError as read_table and curve_parameters do.
CurveInput read_curve(const SubdivideArguments& arguments);

/// Whether the file is a table with a header; standard input is taken for one without.
bool has_header(const std::string& file);

}  // namespace batten
