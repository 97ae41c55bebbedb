// SPDX-License-Identifier: MIT
#include <batten/fem/curve_checks.h>
#include <batten/fem/smoothing_blocks.h>
#include <batten/fem/smoothing_kernels.h>

namespace batten {
namespace {

/// numbers[row] .. numbers[end - 1], then `beyond`; in the buffer where there is not enough of them.
const double* padded(const double* numbers, int row, int end, double beyond, int count, double* buffer) {
  const int inside = std::clamp(end - row, 0, count);
  if (inside == count) return numbers + row;
  std::copy(numbers + row, numbers + row + inside, buffer);
  std::fill(buffer + inside, buffer + count, beyond);
  return buffer;
}

int whole_chunks(int steps) { return steps - steps % lane_chunk; }

class Smoothing {
public:
  explicit Smoothing(const SmoothingProblem& problem)
      : problem_(problem),
        blocks_(problem.rows(), shortest, longest),
        rows_(problem.rows()),
        d_(static_cast<int>(problem.points.cols())),
        cells_(static_cast<int>(problem.knots.size()) - 1),
        steps_(whole_chunks(blocks_.longest() + lane_chunk - 1)) {}

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
    const auto whole_blocks = [&] { return SmoothingSteps(steps_, true); };
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
    /// What all lanes have, in whole chunks.
    int shared() const { return whole_chunks(*std::min_element(lengths, lengths + lane_count)); }

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

  /// Of the cell before a row; none before the first one of an open curve.
  double width_before(int row) const {
    if (row == rows_ || (row == 0 && !problem_.closed)) return 0;
    const auto k = static_cast<std::size_t>(row > 0 ? row : rows_);
    return (problem_.knots[k] - problem_.knots[k - 1]) * problem_.per_unit;
  }

  /// The lines of a tile, and those of them that end in it.
  struct Tile {
    StepLines lines;
    double knots[lane_count][lane_tile + 1], weights[lane_count][lane_tile];
    double points[most_together][lane_count][lane_tile];
  };

  /// Steps from this one on of each block.
  void look_up(const Group& group, int column, int from, Tile& tile) const {
    StepLines& lines = tile.lines;
    lines.components = together(column);
    lines.count = std::min(lane_tile, steps_ - from);
    lines.equal = problem_.weights.empty() ? std::clamp(group.shared() - from, 0, lines.count) : 0;
    lines.per_unit = problem_.per_unit;
    lines.per_weight = problem_.per_weight;
    for (int l = 0; l < lane_count; ++l) {
      const int row = group.starts[l] + from, end = group.ends[l], knots = std::min(end, cells_) + 1;
      const double last = problem_.knots[static_cast<std::size_t>(knots) - 1];
      lines.knots[l] = padded(problem_.knots.data(), row, knots, last, lines.count + 1, tile.knots[l]);
      for (int c = 0; c < lines.components; ++c) {
        const double* const points = problem_.points.col(column + c).data();
        lines.points[c][l] = padded(points, row, end, 0, lines.count, tile.points[c][l]);
      }
      if (lines.equal < lines.count) lines.weights[l] = weights(row, end, lines.count, tile.weights[l]);
    }
  }

  const double* weights(int row, int end, int count, double* buffer) const {
    if (!problem_.weights.empty()) return padded(problem_.weights.data(), row, end, 0, count, buffer);
    for (int k = 0; k < count; ++k) buffer[k] = row + k < end ? 1 : 0;
    return buffer;
  }

  LaneElement described(SmoothingSteps& steps, const Group& group, int column) const {
    LaneElement element;
    Tile tile;
    for (int from = 0; from < steps_; from += lane_tile) {
      look_up(group, column, from, tile);
      describe(tile.lines, steps, element);
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
    for (int l = 0; l < lane_count; ++l) steps.widths[0].value[l] = width_before(group.starts[l]);
    Tile tile;
    for (int from = 0; from < steps_; from += lane_tile) {
      look_up(group, column, from, tile);
      sweep_forwards(tile.lines, from, steps, filter);
    }
    Lanes values[most_together];  // at the ends, x = m + P y
    for (int c = 0; c < together(column); ++c)
      values[c] = filter.means[c].value + filter.p.u * costates[c].value + filter.p.v * costates[c].slope;
    const int shared = group.shared();
    CoefficientLines lines = {together(column), steps_, problem_.weights.empty() ? shared : 0, shared, {}};
    for (int c = 0; c < together(column); ++c)
      for (int l = 0; l < lane_count; ++l) lines.coefficients[c][l] = result.col(column + c).data() + group.starts[l];
    sweep_back(costates, values, steps, lines);
    bool are_finite = true;
    for (int c = 0; c < together(column); ++c) {
      double* const coefficients = result.col(column + c).data();
      for (int l = 0; l < lane_count; ++l)
        for (int k = shared; k < group.lengths[l]; ++k)
          lines.coefficients[c][l][k] = steps.points[c][static_cast<std::size_t>(k)].value[l];
      if (!problem_.closed && group.begin() == 0) coefficients[0] = ends.states(0, column + c);
      if (!problem_.closed && group.end() == rows_) coefficients[rows_ - 1] = values[c][group.lanes - 1];
      are_finite = is_finite(coefficients + group.begin(), group.end() - group.begin()) && are_finite;
    }
    return are_finite;
  }

  const SmoothingProblem& problem_;
  LaneBlocks blocks_;
  int rows_, d_, cells_;
  int steps_;  // of the longest block, in whole chunks
};

}  // namespace

FoundCoefficients smoothing_coefficients(const SmoothingProblem& problem) { return Smoothing(problem).coefficients(); }

}  // namespace batten
