// SPDX-License-Identifier: MIT
#include <batten/app/output_names.h>
#include <batten/app/scheme_pictures.h>
#include <batten/app/usage_error.h>
#include <batten/bases/non_stationary_values.h>
#include <batten/bases/scaling_values.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/errors.h>
#include <batten/io/chart.h>
#include <batten/io/curve_file.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr int curve_points = 1000, grid_points = 160, limit_points = 4000;  // about so many

/// The level on which a support of this length has about `points` points.
int level_for(double length, int arity, int points) {
  return std::max(1, static_cast<int>(std::lround(std::log(points / length) / std::log(arity))));
}

/// Values of the scaling function or a derivative on the grid of a level, exact ones rounded.
template <int D>
LaurentPolynomial<double, D> samples(const SubdivisionScheme<D>& scheme, int level, const Index<D>& derivative) {
  if (scheme.is_exact()) return to_double(values_at_level(scheme, level, derivative));
  return bounded_values_at_level(scheme, level).values;
}

/// Derivatives that exist, none if the masks are not rational.
std::vector<LaurentPolynomial<double, 1>> derivatives(const Scheme& scheme, int level) {
  constexpr int most = 2;
  std::vector<LaurentPolynomial<double, 1>> found;
  try {
    for (int r = 1; r <= most && scheme.is_exact(); ++r) found.push_back(samples<1>(scheme, level, {r}));
  } catch (const InvalidInput&) {  // this one does not exist
  }
  return found;
}

/// The scaling function over its support, with its derivatives as arrays.
CurveSamples scaling_curve(const Scheme& scheme) {
  const auto support = scheme.support();
  const double low = static_cast<double>(support.lower[0]), high = static_cast<double>(support.upper[0]);
  const int level = level_for(high - low, scheme.arity(), curve_points);
  const double step = std::pow(scheme.arity(), -level);
  std::vector<LaurentPolynomial<double, 1>> values = {samples<1>(scheme, level, {})};
  for (auto& derivative : derivatives(scheme, level)) values.push_back(std::move(derivative));
  CurveSamples curve{.name = "n"};
  for (std::size_t r = 0; r < values.size(); ++r)
    curve.arrays.push_back({r == 0 ? "n" : r == 1 ? "derivative" : "second derivative", 1, {}});
  const int first = static_cast<int>(std::floor(low / step)), last = static_cast<int>(std::ceil(high / step));
  for (int i = first; i <= last; ++i) {
    curve.x.push_back(i * step);
    curve.y.push_back(values[0][i]);
    curve.z.push_back(0);
    for (std::size_t r = 0; r < values.size(); ++r) curve.arrays[r].values.push_back(values[r][i]);
  }
  return curve;
}

void draw_scaling(const Scheme& scheme, const SchemeArguments& arguments) {
  const CurveSamples curve = scaling_curve(scheme);
  if (!arguments.output.empty()) write_curves(arguments.output, std::array{curve});
  if (arguments.picture.empty()) return;
  std::vector<ChartLine> lines;
  for (const PointArray& array : curve.arrays) {
    lines.push_back({curve});
    lines.back().curve.name = array.name;
    lines.back().curve.y = array.values;
  }
  ChartOptions options;
  options.title = "scaling function of " + scheme.name();
  options.y_name = "";
  write_chart(arguments.picture, lines, options);
}

/// Blanks zeros among zeros: what lies outside the support, where the picture shows nothing.
void blank_outside(GridSamples& grid) {
  const auto [nx, ny] = grid.points;
  std::vector<double>& values = grid.arrays[0].values;
  const std::vector<double> before = values;
  const auto all_zero = [&, nx = nx, ny = ny](int i, int j) {
    for (int b = std::max(0, j - 1); b <= std::min(ny - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(nx - 1, i + 1); ++a)
        if (before[static_cast<std::size_t>(a + b * nx)] != 0) return false;
    return true;
  };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      if (all_zero(i, j)) values[static_cast<std::size_t>(i + j * nx)] = std::numeric_limits<double>::quiet_NaN();
}

void draw_scaling(const Scheme2& scheme, const SchemeArguments& arguments) {
  const auto support = scheme.support();
  std::array<double, 2> low{}, high{};
  for (std::size_t d = 0; d < 2; ++d) {
    low[d] = static_cast<double>(support.lower[d]);
    high[d] = static_cast<double>(support.upper[d]);
  }
  const int level = level_for(std::max(high[0] - low[0], high[1] - low[1]), scheme.arity(), grid_points);
  const double step = std::pow(scheme.arity(), -level);
  const auto values = samples<2>(scheme, level, {});
  GridSamples grid;
  std::array<int, 2> first{};
  for (std::size_t d = 0; d < 2; ++d) {
    first[d] = static_cast<int>(std::floor(low[d] / step));
    grid.points[d] = static_cast<int>(std::ceil(high[d] / step)) - first[d] + 1;
    grid.origin[d] = first[d] * step;
    grid.spacing[d] = step;
  }
  grid.arrays = {{"value", 1, {}}};
  for (int j = 0; j < grid.points[1]; ++j)
    for (int i = 0; i < grid.points[0]; ++i) grid.arrays[0].values.push_back(values[{first[0] + i, first[1] + j}]);
  if (!arguments.output.empty()) {
    Record record{.kind = "scaling function", .region = {low[0], high[0], low[1], high[1]}};
    record.texts["scheme"] = scheme.name();
    write_image(arguments.output, grid, record);
  }
  if (arguments.picture.empty()) return;
  blank_outside(grid);
  PictureOptions options;
  options.title = std::string("scaling function of ") + scheme.name();
  options.value_name = std::string("n");
  write_picture(arguments.picture, grid, {}, options);
}

/// "x,y;x,y;..."
ControlPolygon parse_control(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    while (at < end && *at == ' ') ++at;
    double value = 0;
    const auto found = std::from_chars(at, end, value);
    at = found.ptr;
    const bool odd = numbers.size() % 2 == 1;
    const bool ends_well = at == end ? odd : *at == (odd ? ';' : ',');
    if (found.ec != std::errc() || !ends_well)
      throw UsageError("--control: expected points as in \"0,0;1,2;3,1\", found '" + text + "'");
    numbers.push_back(value);
    ++at;
  }
  ControlPolygon polygon;
  polygon.points.resize(static_cast<Eigen::Index>(numbers.size() / 2), 2);
  for (Eigen::Index i = 0; i < polygon.points.rows(); ++i)
    for (Eigen::Index c = 0; c < 2; ++c) polygon.points(i, c) = numbers[static_cast<std::size_t>(2 * i + c)];
  return polygon;
}

CurveSamples curve_of(const ControlPolygon& polygon, std::string name, bool closed) {
  CurveSamples curve{.name = std::move(name), .closed = closed};
  curve.arrays = {{"parameter", 1, {}}};
  for (Eigen::Index i = 0; i < polygon.points.rows(); ++i) {
    curve.x.push_back(polygon.points(i, 0));
    curve.y.push_back(polygon.points(i, 1));
    curve.z.push_back(0);
    curve.arrays[0].values.push_back(polygon.start + static_cast<double>(i) * polygon.spacing);
  }
  return curve;
}

/// The polygon and its limit, to what a picture shows.
void draw_control(const Scheme& scheme, const SchemeArguments& arguments) {
  const ControlPolygon control = parse_control(arguments.control);
  const int levels = level_for(static_cast<double>(control.points.rows()), scheme.arity(), limit_points);
  const ControlPolygon limit = subdivided(
      scheme, control, {.levels = levels, .ends = arguments.closed ? Ends::Periodic : Ends::Open, .data_level = 0});
  const std::array curves = {curve_of(control, "control polygon", arguments.closed),
                             curve_of(limit, "limit", arguments.closed)};
  if (!arguments.output.empty()) write_curves(arguments.output, curves);
  if (arguments.picture.empty()) return;
  ChartOptions options;
  options.title = scheme.name() + ": control polygon and limit";
  options.equal_scale = true;
  write_chart(arguments.picture, std::array{ChartLine{curves[0], ChartLine::Style::LineAndDots}, ChartLine{curves[1]}},
              options);
}

}  // namespace

void check_scheme_outputs(const AnyScheme& scheme, const SchemeArguments& arguments) {
  const bool is_curve = std::holds_alternative<Scheme>(scheme);
  if (!arguments.control.empty() && !is_curve)
    throw UsageError("--control: " + arguments.name + " is a scheme of the plane, not of curves");
  if (!arguments.control.empty() && arguments.output.empty() && arguments.picture.empty())
    throw UsageError("--control: there is nothing to write it to; add --picture or -o");
  if (arguments.closed && arguments.control.empty()) throw UsageError("--closed: there is no --control to close");
  check_output_name("-o", arguments.output, {is_curve ? ".vtp" : ".vti"});
  check_output_name("--picture", arguments.picture, {".png"});
}

void write_scheme_outputs(const AnyScheme& scheme, const SchemeArguments& arguments) {
  if (arguments.output.empty() && arguments.picture.empty()) return;
  if (!arguments.control.empty()) return draw_control(std::get<Scheme>(scheme), arguments);
  std::visit([&](const auto& s) { draw_scaling(s, arguments); }, scheme);
}

}  // namespace batten
