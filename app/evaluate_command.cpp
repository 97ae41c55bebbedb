// SPDX-License-Identifier: MIT
#include <batten/app/evaluate_command.h>
#include <batten/app/fit_help.h>
#include <batten/app/output_names.h>
#include <batten/app/point_columns.h>
#include <batten/app/progress.h>
#include <batten/app/run_arguments.h>
#include <batten/app/thread_count.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/solution.h>
#include <batten/flows/flow_field.h>
#include <batten/io/image_file.h>
#include <batten/io/table.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <tuple>

namespace batten {
namespace {

struct EvaluateArguments {
  std::string result;
  std::string at;
  std::string x, y;
  bool derivatives = false;
  std::string output;
  RunArguments run;
};

/// A column of what is written.
struct Quantity {
  std::string name;
  std::function<double(double, double)> at;
};

/// A result of any kind.
struct Result {
  Rectangle region;
  std::vector<Quantity> quantities;
};

Result surface_result(const Record& record, bool derivatives) {
  const Solution p = Solution::from_record(record);
  const auto derivative = [p](int a, int b) {
    return [p, a, b](double x, double y) { return p.derivative(x, y, a, b); };
  };
  Result result{p.region(), {{"value", derivative(0, 0)}}};
  if (!derivatives) return result;
  for (const auto& [name, a, b] : {std::tuple{"dx", 1, 0}, {"dy", 0, 1}, {"dxx", 2, 0}, {"dxy", 1, 1}, {"dyy", 0, 2}})
    result.quantities.push_back({name, derivative(a, b)});
  return result;
}

Result flow_result(const Record& record, bool derivatives) {
  const FlowField f = FlowField::from_record(record);
  Result result{f.region(),
                {{"u", [f](double x, double y) { return f.velocity(x, y).u; }},
                 {"v", [f](double x, double y) { return f.velocity(x, y).v; }},
                 {"divergence", [f](double x, double y) { return f.divergence(x, y); }},
                 {"vorticity", [f](double x, double y) { return f.vorticity(x, y); }},
                 {"speed", [f](double x, double y) { return f.speed(x, y); }}}};
  if (f.stream())
    result.quantities.push_back({"stream_function", [f](double x, double y) { return f.stream_function(x, y); }});
  if (!derivatives) return result;
  const auto add = [&](const char* name, double FlowField::Gradient::*part) {
    result.quantities.push_back({name, [f, part](double x, double y) { return f.gradient(x, y).*part; }});
  };
  add("u_x", &FlowField::Gradient::u_x);
  add("u_y", &FlowField::Gradient::u_y);
  add("v_x", &FlowField::Gradient::v_x);
  add("v_y", &FlowField::Gradient::v_y);
  return result;
}

Result result_of(const EvaluateArguments& arguments) {
  const Record record = read_record(arguments.result);
  if (record.kind == "flow") return flow_result(record, arguments.derivatives);
  if (record.kind == "surface") return surface_result(record, arguments.derivatives);
  throw InvalidInput(arguments.result + ": is a " + record.kind +
                     ", values at points alone; expected a result of fit, flow or solve, which holds a spline");
}

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

std::vector<double> evaluated(const Rectangle& region, const Table& points, const Quantity& quantity) {
  std::vector<double> values(points.columns[0].size());
  const auto size = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = on_interval(region.x, points.columns[0][k]), y = on_interval(region.y, points.columns[1][k]);
    values[k] = quantity.at(x, y);
  }
  return values;
}

void print_summary(const EvaluateArguments& arguments, const Rectangle& region, const std::vector<double>& values) {
  const auto outside = std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); });
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
  set_thread_count(arguments.run.threads);
  Progress progress("batten evaluate", arguments.run.quiet);
  progress.show("read");
  const auto [region, quantities] = result_of(arguments);
  const Table points = read_points(arguments);

  progress.show("evaluate");
  std::vector<std::string> names = {"x", "y"};
  std::vector<std::vector<double>> columns = {points.columns[0], points.columns[1]};
  for (const Quantity& quantity : quantities) {
    names.push_back(quantity.name);
    columns.push_back(evaluated(region, points, quantity));
  }
  progress.show("write " + arguments.output);
  write_table(arguments.output, names, columns);
  progress.erase();
  if (!arguments.run.quiet) print_summary(arguments, region, columns[2]);
}

}  // namespace

Subcommand add_evaluate_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("evaluate", "A result at any points");
  const auto a = std::make_shared<EvaluateArguments>();
  parser->add_option("RESULT", a->result, "what batten wrote, OUT.vti or OUT.vtu")->required()->option_text(" ");
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
  add_run_options(*parser, a->run, false);
  parser->footer(evaluate_help);
  return {parser, [a] { run_evaluate(*a); }};
}

}  // namespace batten
