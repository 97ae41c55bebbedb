// SPDX-License-Identifier: MIT
#include <batten/app/chart_sheet.h>
#include <batten/app/polyharmonic_pictures.h>
#include <batten/bases/polyharmonic_comparison.h>
#include <batten/domains/number_text.h>
#include <batten/io/chart.h>
#include <batten/io/table.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace batten {
namespace {

constexpr std::array sizes = {5, 9, 13, 17, 21};  // along the horizontal axis of figure 5.16
constexpr int usual_size = 17;                    // of figure 5.17
constexpr std::array methods = {"laurent", "jacobi", "lsq", "lp"};

using Numbers = std::array<double, methods.size()>;

Numbers numbers_of(const MaskMethods& m) {
  return {m.laurent, m.jacobi.value_or(std::numeric_limits<double>::quiet_NaN()), m.least_squares, m.optimal};
}

struct Row {
  int size, rounds;
  Numbers residual, limit_error;
};

struct Comparison {
  std::vector<Row> by_size, by_rounds;
};

Comparison compared(const SchemeArguments& a) {
  Numbers none;
  none.fill(std::numeric_limits<double>::quiet_NaN());
  const MaskConstraints constraints = constraints_of(a);
  Comparison result;
  for (const auto& entry : compare_sizes(*a.order, sizes, constraints))
    result.by_size.push_back(
        {entry.size, 1, numbers_of(entry.residual), numbers_of(compare_limits(*a.order, entry.size, constraints))});
  const int size = a.size.value_or(usual_size);
  for (const auto& entry : compare_rounds(*a.order, size, a.rounds, constraints))
    result.by_rounds.push_back({size, entry.rounds, numbers_of(entry.residual), none});
  return result;
}

void write_csv(const std::string& path, const Comparison& comparison) {
  std::vector<std::string> names = {"size", "rounds"};
  for (const char* what : {"residual_", "limit_error_"})
    for (const char* method : methods) names.push_back(std::string(what) + method);
  std::vector<std::vector<double>> columns(names.size());
  for (const auto* rows : {&comparison.by_size, &comparison.by_rounds})
    for (const Row& row : *rows) {
      columns[0].push_back(row.size);
      columns[1].push_back(row.rounds);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        columns[2 + m].push_back(row.residual[m]);
        columns[2 + methods.size() + m].push_back(row.limit_error[m]);
      }
    }
  write_table(path, names, columns);
}

/// A line for each method: the logarithm of its residual over `at`.
template <class At>
Chart chart_of(const std::vector<Row>& rows, const std::string& title, const std::string& x_name, At&& at) {
  std::vector<ChartLine> lines;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    CurveSamples curve{.name = methods[m]};
    for (const Row& row : rows) {
      if (std::isnan(row.residual[m])) continue;
      curve.x.push_back(at(row));
      curve.y.push_back(std::log10(row.residual[m]));
      curve.z.push_back(0);
    }
    if (!curve.x.empty()) lines.push_back({std::move(curve), ChartLine::Style::LineAndDots});
  }
  ChartOptions options;
  options.title = title;
  options.x_name = x_name;
  options.y_name = "log10 of the residual";
  return draw_chart(lines, options);
}

void write_rows(std::ostream& out, const std::string& title, const std::string& first, const std::vector<Row>& rows,
                Numbers Row::*numbers, int Row::*at) {
  constexpr int width = 14;
  out << title << '\n' << std::left << std::setw(width) << first;
  for (const char* method : methods) out << std::setw(width) << method;
  for (const Row& row : rows) {
    out << '\n' << std::setw(width) << row.*at;
    for (double v : row.*numbers) out << std::setw(width) << (std::isnan(v) ? "-" : number_text(v, 6));
  }
  out << "\n\n";
}

}  // namespace

std::string compare_polyharmonic(const SchemeArguments& a) {
  const Comparison comparison = compared(a);
  const std::string of_order = "order " + std::to_string(*a.order);
  const std::string size = std::to_string(a.size.value_or(usual_size));
  const std::string of_size = size + " x " + size;
  if (!a.output.empty()) write_csv(a.output, comparison);
  if (!a.picture.empty()) {
    const auto by_size =
        chart_of(comparison.by_size, of_order + ", one round", "size", [](const Row& r) { return r.size; });
    const auto by_rounds =
        chart_of(comparison.by_rounds, of_order + ", " + of_size, "rounds", [](const Row& r) { return r.rounds; });
    write_chart_sheet(a.picture, {{by_size, by_rounds}});
  }
  std::ostringstream out;
  write_rows(out, "residual of one round, " + of_order, "size", comparison.by_size, &Row::residual, &Row::size);
  write_rows(out, "residual of several rounds, " + of_order + ", " + of_size, "rounds", comparison.by_rounds,
             &Row::residual, &Row::rounds);
  write_rows(out, "largest error of the limit against the bell basis, " + of_order, "size", comparison.by_size,
             &Row::limit_error, &Row::size);
  return out.str();
}

}  // namespace batten
