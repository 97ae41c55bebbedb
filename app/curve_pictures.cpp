// SPDX-License-Identifier: MIT
#include <batten/app/chart_sheet.h>
#include <batten/app/curve_pictures.h>
#include <batten/fem/curve_multiresolution.h>

#include <algorithm>

namespace batten {
namespace {

constexpr int smooth_points = 400;  // of a curve that is drawn as its limit, about

std::vector<double> to_vector(const Eigen::VectorXd& v) { return {v.begin(), v.end()}; }

/// Parameters of the coefficients.
std::vector<double> parameters_of(const NaturalCubic& curve) {
  std::vector<double> knots = curve.knots();
  if (curve.is_closed()) knots.pop_back();
  return knots;
}

CurveSamples polygon_of(const NaturalCubic& curve, const std::string& name) {
  return curve_samples(name, curve.coefficients(), parameters_of(curve), curve.is_closed());
}

CurveSamples limit_of(const NaturalCubic& curve, const std::string& name) {
  return curve_samples(name, curve.values(), parameters_of(curve), curve.is_closed());
}

NaturalCubic refined(NaturalCubic curve, int levels) {
  for (int k = 0; k < levels; ++k) curve = curve.refined();
  return curve;
}

/// So often that it looks smooth.
NaturalCubic smoothly_refined(NaturalCubic curve) {
  while (curve.cells() < smooth_points) curve = curve.refined();
  return curve;
}

/// Lengths of the forces, with their sign on the line, over the parameter.
CurveSamples forces_of(const NaturalCubic& curve, const std::string& name) {
  const Eigen::MatrixXd forces = curve.forces();
  const Eigen::VectorXd lengths = curve.dimension() == 1 ? Eigen::VectorXd(forces.col(0)) : forces.rowwise().norm();
  return curve_samples(name, lengths, parameters_of(curve), false);
}

CurvePicture result_picture(const SubdivideArguments& a, const Eigen::MatrixXd& points, const NaturalCubic& curve) {
  const NaturalCubic fine = refined(curve, a.levels);
  const std::string title = "natural cubic, energy " + std::to_string(curve.energy());
  CurveChart chart{title, {}};
  const bool is_fitted = a.interpolate || a.smoothing || a.tolerance;
  if (is_fitted) chart.curves.push_back(curve_samples("points", points, parameters_of(curve), a.closed));
  chart.curves.push_back(polygon_of(curve, "control polygon"));
  chart.curves.push_back(a.limit ? limit_of(fine, "limit") : polygon_of(fine, "level " + std::to_string(a.levels)));
  return {curve.dimension(), {{chart}}};
}

CurvePicture rounds_picture(const SubdivideArguments& a, const NaturalCubic& curve, bool with_forces) {
  std::vector<CurveChart> rounds, forces;
  NaturalCubic fine = curve;
  for (int k = 0; k <= a.levels; ++k) {
    if (k > 0) fine = fine.refined();
    const std::string level = std::to_string(k);
    rounds.push_back({"p_" + level, {polygon_of(fine, "")}});
    forces.push_back({"E p_" + level, {forces_of(fine, "")}, true});
  }
  if (!with_forces) return {curve.dimension(), {rounds}};
  return {curve.dimension(), {forces, rounds}};
}

CurvePicture multiresolution_picture(const SubdivideArguments& a, const NaturalCubic& curve) {
  const auto parts = analysed(curve, a.levels);
  CurvePicture picture{curve.dimension(), {}};
  for (int k = a.levels; k >= 0; --k) {
    const NaturalCubic q = parts.level(k);
    const std::string name = "q_" + std::to_string(k);
    std::vector<CurveChart> row = {
        {name, {polygon_of(q, "")}},
        {name + ", energy " + std::to_string(q.energy()), {limit_of(smoothly_refined(q), "")}}};
    if (k > 0) {
      const NaturalCubic& r = parts.details[static_cast<std::size_t>(k - 1)];
      row.push_back({"r_" + std::to_string(k - 1) + ", energy " + std::to_string(r.energy()), {polygon_of(r, "")}});
    }
    picture.charts.push_back(std::move(row));
  }
  return picture;
}

}  // namespace

CurveSamples curve_samples(const std::string& name, const Eigen::MatrixXd& points,
                           const std::vector<double>& parameters, bool closed) {
  CurveSamples curve{.name = name, .closed = closed};
  const bool on_line = points.cols() == 1;
  curve.closed = closed && !on_line;
  curve.x = on_line ? parameters : to_vector(points.col(0));
  curve.y = to_vector(points.col(on_line ? 0 : 1));
  curve.z = points.cols() > 2 ? to_vector(points.col(2)) : std::vector<double>(curve.x.size());
  curve.arrays = {{"parameter", 1, parameters}};
  return curve;
}

CurvePicture natural_picture(const SubdivideArguments& a, const Eigen::MatrixXd& points, const NaturalCubic& curve) {
  if (a.show == "rounds") return rounds_picture(a, curve, false);
  if (a.show == "forces") return rounds_picture(a, curve, true);
  if (a.show == "multiresolution") return multiresolution_picture(a, curve);
  return result_picture(a, points, curve);
}

void write_curve_picture(const std::string& path, const CurvePicture& picture, const std::vector<std::string>& names) {
  const bool is_sheet = picture.charts.size() > 1 || picture.charts[0].size() > 1;
  std::vector<std::vector<Chart>> rows;
  for (const auto& row : picture.charts) {
    rows.emplace_back();
    for (const CurveChart& chart : row) {
      const bool is_graph = chart.is_graph || picture.dimension == 1;
      ChartOptions options;
      options.title = chart.title;
      options.equal_scale = !is_graph;
      options.x_name = is_graph ? "parameter" : names[0];
      options.y_name = chart.is_graph ? "" : names[picture.dimension == 1 ? 0 : 1];
      if (is_sheet) {
        options.width = 640;
        options.height = 480;
      }
      std::vector<ChartLine> lines;
      for (std::size_t k = 0; k < chart.curves.size(); ++k) {
        const bool with_points = k + 1 < chart.curves.size() || (is_sheet && chart.curves[k].x.size() < 80);
        lines.push_back({chart.curves[k], with_points ? ChartLine::Style::LineAndDots : ChartLine::Style::Line});
        if (chart.curves[k].name == "points") lines.back().style = ChartLine::Style::Dots;
      }
      rows.back().push_back(draw_chart(lines, options));
    }
  }
  write_chart_sheet(path, rows);
}

}  // namespace batten
