// SPDX-License-Identifier: MIT
#include <batten/app/evaluate_command.h>
#include <batten/app/fit_help.h>
#include <batten/app/output_names.h>
#include <batten/app/point_columns.h>
#include <batten/app/progress.h>
#include <batten/app/thread_count.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/solution.h>
#include <batten/io/image_file.h>
#include <batten/io/table.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

namespace batten {
namespace {

struct EvaluateArguments {
  std::string result;
  std::string at;
  std::string x, y;
  bool derivatives = false;
  std::string output;
  int threads = 0;
  bool quiet = false;
};

struct Derivative {
  const char* name;
  int x_order, y_order;
};
constexpr std::array derivatives = {Derivative{"value", 0, 0}, Derivative{"dx", 1, 0},  Derivative{"dy", 0, 1},
                                    Derivative{"dxx", 2, 0},   Derivative{"dxy", 1, 1}, Derivative{"dyy", 0, 2}};

void check_outputs(const EvaluateArguments& arguments) {
  for (const std::string& input : {arguments.result, arguments.at}) check_not_input(arguments.output, input);
  check_output_name("-o", arguments.output, {".csv"});
}

Table read_points(const EvaluateArguments& arguments) {
  std::vector<std::string> columns = {arguments.x, arguments.y};
  if (arguments.x.empty()) columns = point_columns(arguments.at);
  return read_table(arguments.at, {columns, false});
}

// Coordinates that rounding alone has put outside, as in lower + n * ((upper - lower) / n), lie on the end.
double on_interval(const Interval& interval, double v) {
  const double rounding =
      4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(interval.lower()), std::abs(interval.upper()));
  if (v < interval.lower() && v >= interval.lower() - rounding) return interval.lower();
  if (v > interval.upper() && v <= interval.upper() + rounding) return interval.upper();
  return v;
}

std::vector<double> evaluated(const Solution& solution, const Table& points, const Derivative& which) {
  const Rectangle& region = solution.region();
  std::vector<double> values(points.columns[0].size());
  const auto size = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = on_interval(region.x, points.columns[0][k]), y = on_interval(region.y, points.columns[1][k]);
    values[k] = solution.derivative(x, y, which.x_order, which.y_order);
  }
  return values;
}

void print_summary(const EvaluateArguments& arguments, const Solution& solution, const std::vector<double>& values) {
  const auto outside = std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); });
  const Rectangle& region = solution.region();
  if (outside > 0) {
    std::cerr << "batten: note: " << outside << " of " << values.size() << " points lie outside the region (x from "
              << number_text(region.x.lower(), 6) << " to " << number_text(region.x.upper(), 6) << ", y from "
              << number_text(region.y.lower(), 6) << " to " << number_text(region.y.upper(), 6)
              << "); their fields are empty\n";
  }
  std::cout << arguments.result << ": " << values.size() << " points evaluated, " << outside
            << " outside the region; wrote " << arguments.output << '\n';
}

void run_evaluate(const EvaluateArguments& arguments) {
  check_outputs(arguments);
  set_thread_count(arguments.threads);
  Progress progress("batten evaluate", arguments.quiet);
  progress.show("read");
  const Solution solution = Solution::from_record(read_record(arguments.result));
  const Table points = read_points(arguments);

  progress.show("evaluate");
  std::vector<std::string> names = {"x", "y"};
  std::vector<std::vector<double>> columns = {points.columns[0], points.columns[1]};
  const std::size_t wanted = arguments.derivatives ? derivatives.size() : 1;
  for (std::size_t k = 0; k < wanted; ++k) {
    names.emplace_back(derivatives[k].name);
    columns.push_back(evaluated(solution, points, derivatives[k]));
  }
  progress.show("write " + arguments.output);
  write_table(arguments.output, names, columns);
  progress.erase();
  if (!arguments.quiet) print_summary(arguments, solution, columns[2]);
}

}  // namespace

Subcommand add_evaluate_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("evaluate", "A result at any points");
  const auto a = std::make_shared<EvaluateArguments>();
  parser->add_option("RESULT", a->result, "what batten wrote, OUT.vti")->required()->option_text(" ");
  parser->add_option("--at", a->at, "table of the points, with a header; - reads standard input")
      ->required()
      ->option_text("POINTS");
  auto* const x = parser->add_option("--x", a->x, "column of x: its name or its number, from 1")->option_text("COL");
  auto* const y = parser->add_option("--y", a->y, "column of y; default: columns named x and y, or the first two")
                      ->option_text("COL")
                      ->needs(x);
  x->needs(y);
  parser->add_flag("--derivatives", a->derivatives, "first and second derivatives as well");
  parser->add_option("-o,--output", a->output, "the values")->required()->option_text("OUT.csv");
  parser->add_option("--threads", a->threads, "default: all of the machine; the result does not depend on it")
      ->option_text("N")
      ->check(CLI::Range(1, most_threads));
  parser->add_flag("--quiet", a->quiet, "print errors only");
  parser->footer(evaluate_help);
  return {parser, [a] { run_evaluate(*a); }};
}

}  // namespace batten
