// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace batten {

/// One entry of a printed table: a text or a number.
struct Cell {
  std::string text;
  double number = 0;
  bool is_number = false;

  Cell(const char* t) : text(t) {}
  Cell(std::string t) : text(std::move(t)) {}
  /// Four digits, or as many as a whole number has.
  template <typename T>
  requires std::is_arithmetic_v<T> Cell(T value) : Cell(static_cast<double>(value), 0) {}

private:
  Cell(double value, int);
};

/// What a benchmark finds out: printed as it comes, written as JSON at the end.
///
/// The last lines are the goals, one each, with the number measured and whether it meets the goal.
class Report {
public:
  explicit Report(std::string name);
  ~Report();

  /// A condition of the run, "name: value".
  void note(const std::string& name, const Cell& value);
  /// Starts a table; the rows that follow belong to it.
  void table(const std::string& title, const std::vector<std::string>& columns);
  /// As many cells as the table has columns.
  void row(const std::vector<Cell>& cells);

  /// The goal that `measured` is at most (at least) `limit`; NaN counts as unmet.
  void at_most(const std::string& goal, double limit, double measured);
  void at_least(const std::string& goal, double limit, double measured);

  /// Prints the goals and writes everything to `file`.
  void finish(const std::string& file) const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// The main function of a benchmark: runs `work` and writes <name>.json into the current folder, or the file that the
/// command line names. Exit status 0 whatever was measured; 1, with a line on standard error, if something broke.
int run_benchmark(int argc, char** argv, const std::string& name, const std::function<void(Report&)>& work);

}  // namespace batten
