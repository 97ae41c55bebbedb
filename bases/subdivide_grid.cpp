// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/grid_rules.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/errors.h>

#include <omp.h>

#include <algorithm>
#include <limits>
#include <string>

namespace batten {
namespace {

struct GridRange {
  IndexRange x, y;
};

/// The old values `wanted`, 0 where there are none; `have` are the indices of `values`.
Eigen::MatrixXd gathered(const Eigen::MatrixXd& values, const GridRange& have, const GridRange& wanted,
                         const GridSubdivisionOptions& options) {
  const auto place = [](std::ptrdiff_t i, const IndexRange& range, Ends ends) {
    return place_of(i - range.begin, range.size(), ends);
  };
  std::vector<std::ptrdiff_t> columns;
  for (std::ptrdiff_t i = wanted.x.begin; i < wanted.x.end; ++i) columns.push_back(place(i, have.x, options.x));
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(wanted.x.size(), wanted.y.size());
  for (std::ptrdiff_t j = 0; j < wanted.y.size(); ++j) {
    const std::ptrdiff_t row = place(wanted.y.begin + j, have.y, options.y);
    if (row < 0) continue;
    for (std::ptrdiff_t i = 0; i < wanted.x.size(); ++i)
      if (const auto column = columns[static_cast<std::size_t>(i)]; column >= 0) result(i, j) = values(column, row);
  }
  return result;
}

Eigen::MatrixXd refined(const GridRules& rules, const Eigen::MatrixXd& values, const GridRange& have,
                        const GridRange& fine, const GridSubdivisionOptions& options) {
  const AxisRules &x = rules.x(), &y = rules.y();
  const IndexRange groups_x = x.groups_of(fine.x), groups_y = y.groups_of(fine.y);
  const GridRange wanted{x.window_of(groups_x), y.window_of(groups_y)};
  const Eigen::MatrixXd old = gathered(values, have, wanted, options);
  Eigen::MatrixXd result(fine.x.size(), fine.y.size());
  const std::ptrdiff_t length = x.arity * groups_x.size(), skipped = fine.x.begin - x.arity * groups_x.begin;
  struct Scratch {
    GridRules::Work work;
    std::vector<double> row;
  };
  std::vector<Scratch> scratch(static_cast<std::size_t>(omp_get_max_threads()),
                               {rules.work(old.rows()), std::vector<double>(static_cast<std::size_t>(length))});
  for_blocks(RowBlocks(static_cast<int>(fine.y.size()), static_cast<int>(length)), [&](int begin, int end) {
    auto& [work, row] = scratch[static_cast<std::size_t>(omp_get_thread_num())];
    for (int j = begin; j < end; ++j) {
      const std::ptrdiff_t index = fine.y.begin + j, group = y.groups_of({index, index + 1}).begin;
      const double* const first = old.col(group - groups_y.begin).data();
      rules.fill_row(static_cast<int>(index - y.arity * group), first, old.rows(), groups_x.size(), work, row.data());
      std::copy_n(row.data() + skipped, fine.x.size(), result.col(j).data());
    }
  });
  return result;
}

void require_grid(const ControlGrid& grid, const GridSubdivisionOptions& options) {
  if (options.levels < 0 || options.data_level < 0)
    throw InvalidInput("subdivided: levels must not be negative, found " +
                       std::to_string(std::min(options.levels, options.data_level)));
  if (grid.components.empty() || grid.components[0].size() == 0)
    throw InvalidInput("subdivided: a grid must have values, found none");
  for (const auto& component : grid.components) {
    if (component.rows() != grid.components[0].rows() || component.cols() != grid.components[0].cols())
      throw InvalidInput("subdivided: all components of a grid must have the same size, found " +
                         std::to_string(component.rows()) + " x " + std::to_string(component.cols()) + " and " +
                         std::to_string(grid.components[0].rows()) + " x " + std::to_string(grid.components[0].cols()));
    if (!component.allFinite()) throw InvalidInput("subdivided: the data must be finite, found a number that is not");
  }
}

void require_range(const GridRange& range) {
  if (range.x.size() <= 0 || range.y.size() <= 0)
    throw InvalidInput("subdivided: an open grid must determine values, found too few in " +
                       std::string(range.x.size() <= 0 ? "x" : "y"));
  if (range.x.size() > std::numeric_limits<int>::max() / range.y.size())
    throw InvalidInput("subdivided: the result must have at most 2^31 values, found more");
}

}  // namespace

ControlGrid subdivided(const Scheme2& scheme, const ControlGrid& grid, const GridSubdivisionOptions& options) {
  require_grid(grid, options);
  ControlGrid result = grid;
  GridRange range{{0, grid.components[0].rows()}, {0, grid.components[0].cols()}};
  std::array<double, 2> shift{};
  for (int k = 1; k <= options.levels; ++k) {
    const auto mask = scheme.mask(options.data_level + k);
    require_ends("subdivided", mask, 0, options.x);
    require_ends("subdivided", mask, 1, options.y);
    const GridRules rules(mask, scheme.arity());
    const GridRange fine{rules.x().refined(range.x, options.x), rules.y().refined(range.y, options.y)};
    require_range(fine);
    for (auto& component : result.components) component = refined(rules, component, range, fine, options);
    range = fine;
    for (std::size_t d : {0, 1}) {
      shift[d] = scheme.arity() * shift[d] + 0.5 * mask.half()[d];
      result.spacing[d] /= scheme.arity();
    }
  }
  result.start[0] += result.spacing[0] * (static_cast<double>(range.x.begin) + shift[0]);
  result.start[1] += result.spacing[1] * (static_cast<double>(range.y.begin) + shift[1]);
  return result;
}

}  // namespace batten
