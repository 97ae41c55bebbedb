// SPDX-License-Identifier: MIT
#include <batten/bench/support/report.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace batten {
namespace {

constexpr int case_width = 26;

std::string text_of(double value) {
  const bool whole = value == std::floor(value) && std::abs(value) < 1e9;
  char text[40];
  std::snprintf(text, sizeof text, whole ? "%.0f" : "%.4g", value);
  return text;
}

nlohmann::json json_of(const Cell& cell) {
  if (!cell.is_number) return cell.text;
  return cell.number;  // NaN and infinity become null
}

}  // namespace

Cell::Cell(double value, int) : text(text_of(value)), number(value), is_number(true) {}

struct Report::Content {
  struct Goal {
    std::string text;
    bool upper;
    double limit, measured;
    bool met() const { return upper ? measured <= limit : measured >= limit; }
  };
  std::string name;
  nlohmann::json notes = nlohmann::json::object(), tables = nlohmann::json::array();
  std::vector<Goal> goals;
  std::vector<int> widths;
};

Report::Report(std::string name) : content_(std::make_unique<Content>()) { content_->name = std::move(name); }

Report::~Report() = default;

void Report::note(const std::string& name, const Cell& value) {
  content_->notes[name] = json_of(value);
  std::printf("%s: %s\n", name.c_str(), value.text.c_str());
  std::fflush(stdout);
}

void Report::table(const std::string& title, const std::vector<std::string>& columns) {
  content_->tables.push_back({{"title", title}, {"columns", columns}, {"rows", nlohmann::json::array()}});
  content_->widths.clear();
  std::printf("\n%s\n", title.c_str());
  for (const auto& column : columns) {
    // the first column, to the left, is the case; the others are what was found
    const bool first = content_->widths.empty();
    content_->widths.push_back(first ? -case_width : std::max(9, static_cast<int>(column.size())));
    std::printf("%s%*s", first ? "" : "  ", content_->widths.back(), column.c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void Report::row(const std::vector<Cell>& cells) {
  if (cells.size() != content_->widths.size()) throw std::logic_error("Report::row: expected one cell for each column");
  auto row = nlohmann::json::array();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    row.push_back(json_of(cells[k]));
    std::printf("%s%*s", k == 0 ? "" : "  ", content_->widths[k], cells[k].text.c_str());
  }
  content_->tables.back()["rows"].push_back(row);
  std::printf("\n");
  std::fflush(stdout);
}

void Report::at_most(const std::string& goal, double limit, double measured) {
  content_->goals.push_back({goal, true, limit, measured});
}

void Report::at_least(const std::string& goal, double limit, double measured) {
  content_->goals.push_back({goal, false, limit, measured});
}

void Report::finish(const std::string& file) const {
  std::size_t width = 4;
  for (const auto& goal : content_->goals) width = std::max(width, goal.text.size());
  std::printf("\n%-*s  %14s  %9s  met\n", static_cast<int>(width), "goal", "limit", "measured");
  auto goals = nlohmann::json::array();
  for (const auto& goal : content_->goals) {
    std::printf("%-*s  %8s %5s  %9s  %s\n", static_cast<int>(width), goal.text.c_str(),
                goal.upper ? "at most" : "at least", text_of(goal.limit).c_str(), text_of(goal.measured).c_str(),
                goal.met() ? "yes" : "NO");
    goals.push_back({{"goal", goal.text},
                     {goal.upper ? "at_most" : "at_least", goal.limit},
                     {"measured", goal.measured},
                     {"met", goal.met()}});
  }
  const nlohmann::json all = {
      {"benchmark", content_->name}, {"notes", content_->notes}, {"tables", content_->tables}, {"goals", goals}};
  std::ofstream out(file);
  out << all.dump(1) << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write '" + file + "'");
}

int run_benchmark(int argc, char** argv, const std::string& name, const std::function<void(Report&)>& work) {
  try {
    Report report(name);
    work(report);
    report.finish(argc > 1 ? argv[1] : name + ".json");
    return 0;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return 1;
  }
}

}  // namespace batten
