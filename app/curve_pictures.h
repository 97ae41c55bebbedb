// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>
#include <batten/fem/natural_cubic.h>
#include <batten/io/chart.h>

#include <string>
#include <vector>

namespace batten {

/// Curves to be drawn in one chart, the first with its points.
struct CurveChart {
  std::string title;
  std::vector<CurveSamples> curves;
  bool is_graph = false;  ///< values over the parameter, also where the curve lies in the plane
};

/// Charts in rows. The last curve of the last chart is the result.
struct CurvePicture {
  Eigen::Index dimension = 1;  ///< 1: values over the parameter; else points
  std::vector<std::vector<CurveChart>> charts;
};

/// Points with their parameters; points of the line are drawn over their parameters.
CurveSamples curve_samples(const std::string& name, const Eigen::MatrixXd& points,
                           const std::vector<double>& parameters, bool closed);

/// What --show asks for: the result, every round [Warren & Weimer 2001, fig. 6.6], rounds and forces [fig. 6.4], or the
/// multiresolution [fig. 6.8]. Throws InvalidInput when the levels do not fit the number of points.
CurvePicture natural_picture(const SubdivideArguments& arguments, const Eigen::MatrixXd& points,
                             const NaturalCubic& curve);

/// Draws it into a PNG file. `names` are those of the axes.
void write_curve_picture(const std::string& path, const CurvePicture& picture, const std::vector<std::string>& names);

}  // namespace batten
