// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/errors.h>

#include <omp.h>

#include <algorithm>
#include <limits>
#include <string>

namespace batten {
namespace {

struct GridStep {
  AxisRules x, y;
  std::vector<std::vector<double>> weights;  // by residue and old row in y
};

GridStep step_of(const Mask2<double>& mask, int arity) {
  GridStep step{axis_rules(mask, 0, arity), axis_rules(mask, 1, arity), {}};
  step.weights = group_weights(mask, step.x, step.y);
  return step;
}

struct GridRange {
  IndexRange x, y;
};

/// The old values `wanted`, 0 where there are none; `have` are the indices of `values`.
Eigen::MatrixXd gathered(const Eigen::MatrixXd& values, const GridRange& have, const GridRange& wanted,
                         const GridSubdivisionOptions& options) {
  const auto place = [](std::ptrdiff_t i, const IndexRange& range, Ends ends) {
    const std::ptrdiff_t n = range.size(), at = i - range.begin;
    return ends == Ends::Periodic ? ((at % n) + n) % n : at;
  };
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(wanted.x.size(), wanted.y.size());
  for (std::ptrdiff_t j = 0; j < wanted.y.size(); ++j) {
    const std::ptrdiff_t row = place(wanted.y.begin + j, have.y, options.y);
    if (row < 0 || row >= have.y.size()) continue;
    for (std::ptrdiff_t i = 0; i < wanted.x.size(); ++i) {
      const std::ptrdiff_t column = place(wanted.x.begin + i, have.x, options.x);
      if (column >= 0 && column < have.x.size()) result(i, j) = values(column, row);
    }
  }
  return result;
}

/// New row `index` in y into `groups`, from all old values that its groups use; `first_row` is the first of them in y.
void fill_row(const GridStep& step, const Eigen::MatrixXd& old, std::ptrdiff_t first_row, std::ptrdiff_t index,
              std::span<double> groups) {
  const std::ptrdiff_t group = step.y.groups_of({index, index + 1}).begin, residue = index - step.y.arity * group;
  const std::ptrdiff_t row = step.y.window_of({group, group + 1}).begin - first_row;
  const auto count = static_cast<std::ptrdiff_t>(groups.size()) / step.x.arity;
  bool adds = false;
  for (int q = 0; q < step.y.width; ++q) {
    const auto& weights = step.weights[static_cast<std::size_t>(q + step.y.width * residue)];
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) continue;
    refine_groups_into(step.x, weights.data(), old.col(row + q).data(), count, groups.data(), adds);
    adds = true;
  }
  if (!adds) std::fill(groups.begin(), groups.end(), 0.);
}

Eigen::MatrixXd refined(const GridStep& step, const Eigen::MatrixXd& values, const GridRange& have,
                        const GridRange& fine, const GridSubdivisionOptions& options) {
  const IndexRange groups_x = step.x.groups_of(fine.x), groups_y = step.y.groups_of(fine.y);
  const GridRange wanted{step.x.window_of(groups_x), step.y.window_of(groups_y)};
  const Eigen::MatrixXd old = gathered(values, have, wanted, options);
  Eigen::MatrixXd result(fine.x.size(), fine.y.size());
  const auto length = static_cast<std::size_t>(step.x.arity * groups_x.size());
  const std::ptrdiff_t skipped = fine.x.begin - step.x.arity * groups_x.begin;
  std::vector<double> rows(length * static_cast<std::size_t>(omp_get_max_threads()));
  for_blocks(RowBlocks(static_cast<int>(fine.y.size()), static_cast<int>(length)), [&](int begin, int end) {
    const std::span row(rows.data() + length * static_cast<std::size_t>(omp_get_thread_num()), length);
    for (int j = begin; j < end; ++j) {
      fill_row(step, old, wanted.y.begin, fine.y.begin + j, row);
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
    const auto step = step_of(mask, scheme.arity());
    const GridRange fine{step.x.refined(range.x, options.x), step.y.refined(range.y, options.y)};
    require_range(fine);
    for (auto& component : result.components) component = refined(step, component, range, fine, options);
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
