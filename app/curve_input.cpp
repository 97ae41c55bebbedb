// SPDX-License-Identifier: MIT
#include <batten/app/curve_input.h>
#include <batten/app/point_columns.h>
#include <batten/app/usage_error.h>
#include <batten/domains/errors.h>
#include <batten/fem/curve_fit.h>
#include <batten/io/number_reader.h>
#include <batten/io/table.h>

#include <algorithm>
#include <array>

namespace batten {
namespace {

/// The columns x, y, z that there are, or the first two.
std::vector<std::string> usual_columns(const std::string& file) {
  const auto header = first_row(file);
  std::vector<std::string> found;
  for (const char* name : {"x", "y", "z"})
    if (std::find(header.begin(), header.end(), name) != header.end()) found.emplace_back(name);
  if (!found.empty() || header.empty()) return found.empty() ? std::vector<std::string>{"x", "y"} : found;
  return header.size() == 1 ? std::vector<std::string>{"1"} : std::vector<std::string>{"1", "2"};
}

}  // namespace

bool has_header(const std::string& file) {
  NumberReader numbers(true);
  const auto fields = first_row(file);
  return std::any_of(fields.begin(), fields.end(), [&](const std::string& f) { return !numbers.read(f).has_value(); });
}

CurveInput read_curve(const SubdivideArguments& a) {
  constexpr std::array<std::pair<const char*, double>, 3> powers = {
      {{"uniform", 0}, {"centripetal", 0.5}, {"chord", 1}}};
  const auto power =
      std::find_if(powers.begin(), powers.end(), [&](const auto& entry) { return a.parameter == entry.first; });
  const bool is_column = power == powers.end();
  if (is_column && a.closed)
    throw UsageError("--parameter: of a closed curve uniform, centripetal or chord is expected, found '" + a.parameter +
                     "': a column does not tell where the curve closes");
  std::vector<std::string> columns = a.columns.empty() ? usual_columns(a.input) : a.columns;
  const std::size_t dimension = columns.size();
  if (is_column) columns.push_back(a.parameter);
  if (!a.tolerance_column.empty()) columns.push_back(a.tolerance_column);
  Table table = read_table(a.input, {columns, false});
  CurveInput curve;
  curve.names.assign(table.names.begin(), table.names.begin() + static_cast<std::ptrdiff_t>(dimension));
  const auto n = static_cast<Eigen::Index>(table.lines.size());
  curve.points.resize(n, static_cast<Eigen::Index>(dimension));
  for (std::size_t c = 0; c < dimension; ++c)
    curve.points.col(static_cast<Eigen::Index>(c)) = Eigen::Map<const Eigen::VectorXd>(table.columns[c].data(), n);
  if (!a.tolerance_column.empty()) curve.tolerances = std::move(table.columns.back());
  curve.lines = table.lines;
  curve.knots = is_column ? table.columns[dimension] : curve_parameters(curve.points, power->second, a.closed);
  if (!is_column) return curve;
  for (std::size_t i = 0; i + 1 < curve.knots.size(); ++i)
    if (!(curve.knots[i] < curve.knots[i + 1]))
      throw InvalidInput(a.input + ": the parameters in column " + a.parameter + " must increase, found " +
                         std::to_string(curve.knots[i]) + " in line " + std::to_string(table.lines[i]) + " and " +
                         std::to_string(curve.knots[i + 1]) + " in line " + std::to_string(table.lines[i + 1]));
  return curve;
}

}  // namespace batten
