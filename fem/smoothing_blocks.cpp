// SPDX-License-Identifier: MIT
#include <batten/fem/curve_checks.h>
#include <batten/fem/smoothing_blocks.h>
#include <batten/fem/smoothing_kernels.h>

namespace batten {
namespace {

class Smoothing {
public:
  explicit Smoothing(const SmoothingProblem& problem)
      : problem_(problem),
        blocks_(problem.rows(), shortest, longest),
        rows_(problem.rows()),
        d_(static_cast<int>(problem.points.cols())),
        cells_(static_cast<int>(problem.knots.size()) - 1),
        per_unit_(problem.per_unit()) {}

  FoundCoefficients coefficients() const {
    std::vector<BlockElement> elements(static_cast<std::size_t>(blocks_.count()));
    StateColumns b(2, blocks_.count() * d_), kappa(2, blocks_.count() * d_);
    const bool increase = for_groups([] { return SmoothingSteps(lane_tile, false); },
                                     [&](SmoothingSteps& steps, const Group& group) {
                                       for (int column = 0; column < d_; column += most_together)
                                         store(group, column, described(steps, group, column), elements, b, kappa);
                                       return increases(problem_.knots.data() + group.begin(),
                                                        std::min(group.end(), cells_) - group.begin());
                                     });
    const BlockEnds ends = joined_blocks(elements, b, kappa, problem_.closed);
    FoundCoefficients found = {Eigen::MatrixXd(rows_, d_), increase};
    const auto whole_blocks = [&] { return SmoothingSteps(blocks_.longest(), true); };
    const bool are_finite = for_groups(whole_blocks, [&](SmoothingSteps& steps, const Group& group) {
      bool result = true;
      for (int column = 0; column < d_; column += most_together)
        result = fill(steps, group, column, ends, found.coefficients) && result;
      return result;
    });
    found.are_sound = increase && are_finite;
    return found;
  }

private:
  static constexpr int shortest = 64, longest = 1000;

  /// Blocks that are worked on together, one in each of the first `lanes` lanes.
  struct Group {
    int begin() const { return starts[0]; }
    int end() const { return ends[lanes - 1]; }

    int first, lanes;
    int starts[lane_count], ends[lane_count], lengths[lane_count];
  };

  Group group(int index) const {
    Group g{index * lane_count, std::min(lane_count, blocks_.count() - index * lane_count), {}, {}, {}};
    for (int l = 0; l < lane_count; ++l) {
      g.starts[l] = blocks_.begin(g.first + l);
      g.lengths[l] = blocks_.length(g.first + l);
      g.ends[l] = g.starts[l] + g.lengths[l];
    }
    return g;
  }

  /// Whether work(steps, group) of all groups, with the steps that each thread makes.
  template <class Make, class Work>
  bool for_groups(const Make& make, const Work& work) const {
    bool result = true;
#pragma omp parallel if (blocks_.groups() > 1) reduction(&& : result)
    {
      SmoothingSteps steps = make();
#pragma omp for schedule(static)
      for (int index = 0; index < blocks_.groups(); ++index) result = work(steps, group(index)) && result;
    }
    return result;
  }

  int together(int column) const { return std::min(most_together, d_ - column); }

  /// Of the cell behind a row; none behind the last one of an open curve.
  double width(int row) const {
    if (row < 0) row = problem_.closed ? rows_ - 1 : cells_;
    if (row >= cells_) return 0;
    const auto k = static_cast<std::size_t>(row);
    return (problem_.knots[k + 1] - problem_.knots[k]) * per_unit_;
  }

  /// The tile of steps from this one on of each block, to place `to`: how many they are.
  int read_tile(SmoothingSteps& steps, const Group& group, int column, int from, int to) const {
    const int count = std::min(lane_tile, blocks_.longest() - from);
    int at[lane_count], before[lane_count], ends[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      at[l] = group.starts[l] + from;
      before[l] = at[l] - 1;
      ends[l] = std::min(group.ends[l], cells_);
    }
    gather_widths(problem_.knots.data(), per_unit_, before, ends, count + 1, steps.widths.data() + to,
                  [&](int l, int row) { return row < group.ends[l] ? width(row) : 0; });
    read_softness(group, from, count, steps.softness.data() + to);
    for (int c = 0; c < together(column); ++c) {
      const double* const points = problem_.points.col(column + c).data();
      gather_lanes(at, count, steps.points[c].data() + to, [&](int l, int row, int n, double* buffer) {
        return padded(points, row, group.ends[l], n, buffer);
      });
    }
    return count;
  }

  void read_softness(const Group& group, int from, int count, LaneStep* softness) const {
    if (problem_.weights.empty()) {
      fill_lanes(softness, count, problem_.lambda);
      for (int l = 0; l < lane_count; ++l)
        for (int k = std::max(group.lengths[l] - from, 0); k < count; ++k) softness[k].value[l] = most_soft;
      return;
    }
    int at[lane_count];
    for (int l = 0; l < lane_count; ++l) at[l] = group.starts[l] + from;
    gather_lanes(at, count, softness, [&](int l, int row, int n, double* buffer) {
      return padded(problem_.weights.data(), row, group.ends[l], n, buffer);
    });
    soften(softness, count, problem_.lambda);
  }

  /// numbers[row] .. numbers[end - 1], then 0.
  static const double* padded(const double* numbers, int row, int end, int n, double* buffer) {
    const int inside = std::clamp(end - row, 0, n);
    if (inside == n) return numbers + row;
    std::copy(numbers + row, numbers + row + inside, buffer);
    std::fill(buffer + inside, buffer + n, 0.);
    return buffer;
  }

  LaneElement described(SmoothingSteps& steps, const Group& group, int column) const {
    LaneElement element;
    for (int from = 0; from < blocks_.longest(); from += lane_tile) {
      const int count = read_tile(steps, group, column, from, 0);
      describe(steps, count, together(column), element);
    }
    return element;
  }

  void store(const Group& group, int column, const LaneElement& e, std::vector<BlockElement>& elements, StateColumns& b,
             StateColumns& kappa) const {
    for (int l = 0; l < group.lanes; ++l) {
      BlockElement& element = elements[static_cast<std::size_t>(group.first + l)];
      element.a << e.a[0][l], e.a[1][l], e.a[2][l], e.a[3][l];
      element.c << e.c.u[l], e.c.v[l], e.c.v[l], e.c.z[l];
      element.j << e.j_uu[l], e.j_us[l], e.j_us[l], e.j_ss[l];
      for (int c = 0; c < together(column); ++c) {
        const Eigen::Index k = (group.first + l) * d_ + column + c;
        b.col(k) << e.b[c].value[l], e.b[c].slope[l];
        kappa.col(k) << e.kappa[c].value[l], e.kappa[c].slope[l];
      }
    }
  }

  /// Whether the coefficients are finite.
  bool fill(SmoothingSteps& steps, const Group& group, int column, const BlockEnds& ends,
            Eigen::MatrixXd& result) const {
    LaneFilter filter = {};
    LaneState costates[most_together] = {};
    for (int c = 0; c < together(column); ++c)
      for (int l = 0; l < group.lanes; ++l) {
        const Eigen::Index k = (group.first + l) * d_ + column + c;
        filter.means[c].value[l] = ends.states(0, k);
        filter.means[c].slope[l] = ends.states(1, k);
        costates[c].value[l] = ends.costates(0, k);
        costates[c].slope[l] = ends.costates(1, k);
      }
    for (int from = 0; from < blocks_.longest(); from += lane_tile) {
      const int count = read_tile(steps, group, column, from, from);
      sweep_forwards(steps, from, from + count, together(column), filter);
    }
    Lanes values[most_together];  // at the ends, x = m + P y
    for (int c = 0; c < together(column); ++c)
      values[c] = filter.means[c].value + filter.p.u * costates[c].value + filter.p.v * costates[c].slope;
    sweep_back(steps, blocks_.longest(), together(column), costates, values);
    bool are_finite = true;
    for (int c = 0; c < together(column); ++c) {
      double* const coefficients = result.col(column + c).data();
      scatter_lanes(group.starts, group.lengths, 0, steps.points[c], coefficients);
      if (!problem_.closed && group.begin() == 0) coefficients[0] = ends.states(0, column + c);
      if (!problem_.closed && group.end() == rows_) coefficients[rows_ - 1] = values[c][group.lanes - 1];
      are_finite = is_finite(coefficients + group.begin(), group.end() - group.begin()) && are_finite;
    }
    return are_finite;
  }

  const SmoothingProblem& problem_;
  LaneBlocks blocks_;
  int rows_, d_, cells_;
  double per_unit_;
};

}  // namespace

FoundCoefficients smoothing_coefficients(const SmoothingProblem& problem) { return Smoothing(problem).coefficients(); }

}  // namespace batten
