// SPDX-License-Identifier: MIT
#include <batten/fem/curve_lanes.h>
#include <batten/fem/smoothing_blocks.h>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones.

namespace batten {
namespace {

constexpr double third = 1. / 3;  // divisions take longer than all else

/// A group of blocks: what is read, and what one sweep leaves for the next. Empty steps have width 0.
struct Group {
  explicit Group(int count) : steps(count) {
    const auto n = static_cast<std::size_t>(count);
    widths.resize(n + 1);
    for (LaneSteps* s : {&softness, &points, &inverse, &gain, &slope_gain, &first, &second, &pulls}) s->resize(n);
  }

  int steps;
  LaneSteps widths;                     // from that of the cell before the block
  LaneSteps softness, points;           // λ / w, b
  LaneSteps inverse, gain, slope_gain;  // 1 / S, P_00 / S, P_10 / S with S = P_00 + λ / w
  LaneSteps first, second;              // p at this knot for unit states at the begin
  LaneSteps pulls;                      // (b - m_0) / S
};

struct Symmetric {
  Lanes uu, us, ss;
};
struct Element {
  Lanes a[4];  // rows
  Symmetric c, j;
};

/// The covariances of the filter from a known state: gains; with `whole`, what the block says about its ends as well.
template <bool whole>
[[gnu::always_inline]] inline Element sweep_covariances(Group& g) {
  const Lanes zero{}, one = zero + 1;
  Element e{{one, zero, zero, one}, {zero, zero, zero}, {zero, zero, zero}};
  Lanes u = zero, v = zero, z = zero, det = zero;  // P_00, P_10, P_11
  for (std::size_t k = 0; k < static_cast<std::size_t>(g.steps); ++k) {
    const Lanes h = g.widths[k + 1].value, soft = g.softness[k].value;
    const Lanes inverse = 1 / (u + soft), rest = soft * inverse, gain = u * inverse, slope_gain = v * inverse;
    g.inverse[k].value = inverse;
    g.gain[k].value = gain;
    g.slope_gain[k].value = slope_gain;
    if constexpr (whole) {
      const Lanes f = e.a[0], s = e.a[1];
      g.first[k].value = f;
      g.second[k].value = s;
      e.j.uu += f * f * inverse;
      e.j.us += f * s * inverse;
      e.j.ss += s * s * inverse;
      e.a[2] -= slope_gain * f;
      e.a[3] -= slope_gain * s;
      e.a[0] = rest * f + h * e.a[2];
      e.a[1] = rest * s + h * e.a[3];
    }
    z = rest * z + det * inverse;
    det = rest * det;
    u = rest * u;
    v = rest * v;
    // A P A^T + q
    const Lanes hz = h * z, hh = h * h;
    det += h * (u + h * v + hh * z * third) + hh * hh * (third / 4);
    u += h * (2 * v + hz) + hh * h * third;
    v += hz + hh * 0.5;
    z += h;
  }
  e.c = {u, v, z};
  return e;
}

struct State {
  Lanes value, slope;
};

/// The mean of the filter from a state; with `whole`, κ as well.
template <bool whole>
[[gnu::always_inline]] inline State sweep_means(Group& g, State& m) {
  State kappa{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(g.steps); ++k) {
    const Lanes miss = g.points[k].value - m.value, pull = g.inverse[k].value * miss;
    if constexpr (whole) {
      kappa.value += g.first[k].value * pull;
      kappa.slope += g.second[k].value * pull;
    } else {
      g.pulls[k].value = pull;
    }
    m.slope += g.slope_gain[k].value * miss;
    m.value += g.gain[k].value * miss + g.widths[k + 1].value * m.slope;
  }
  return kappa;
}

/// Backwards from the costate at the end, where the spline has the value `next`: coefficients in place of the points.
[[gnu::always_inline]] inline void sweep_back(Group& g, State y, Lanes next) {
  for (auto k = static_cast<std::size_t>(g.steps); k-- > 0;) {
    const Lanes before = g.widths[k].value, after = g.widths[k + 1].value;
    const Lanes bend = y.slope + after * y.value, bend_next = y.slope;
    const Lanes force = g.gain[k].value * y.value + g.slope_gain[k].value * bend - g.pulls[k].value;
    const Lanes value = g.points[k].value + g.softness[k].value * force;
    const Lanes slope = (next - value) / after - after * (2 * bend + bend_next) * (third / 2);
    const Lanes p = value + slope * (after - before) * third - bend * before * after * (third / 2);
    g.points[k].value = before == 0. ? value : after == 0. ? value : p;
    y = {y.value - force, bend};
    next = value;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void describe_covariances(Group& g, Element& e) {
  e = sweep_covariances<true>(g);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void describe_means(Group& g, State& mean, State& kappa) {
  kappa = sweep_means<true>(g, mean);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void find_gains(Group& g, Symmetric& c) {
  c = sweep_covariances<false>(g).c;
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void fill_in(Group& g, State& m, const Symmetric& c, const State& costate) {
  sweep_means<false>(g, m);
  sweep_back(g, costate, m.value + c.uu * costate.value + c.us * costate.slope);
}

class Smoothing {
public:
  explicit Smoothing(const SmoothingProblem& problem)
      : problem_(problem),
        blocks_(problem.rows(), shortest, longest),
        rows_(problem.rows()),
        d_(static_cast<int>(problem.points.cols())),
        per_unit_(problem.per_unit()) {}

  Eigen::MatrixXd coefficients() const {
    const auto count = static_cast<std::size_t>(blocks_.count());
    std::vector<BlockElement> elements(count);
    StateColumns b(2, blocks_.count() * d_), kappa(2, blocks_.count() * d_);
    for_groups([&](Group& g, int group) { describe(g, group, elements, b, kappa); });
    const BlockEnds ends = joined_blocks(elements, b, kappa, problem_.closed);
    Eigen::MatrixXd result(rows_, d_);
    for_groups([&](Group& g, int group) { fill(g, group, ends, result); });
    return result;
  }

private:
  static constexpr int shortest = 64, longest = 512;

  template <class Work>
  void for_groups(const Work& work) const {
#pragma omp parallel if (blocks_.groups() > 1)
    {
      Group g(blocks_.longest());
#pragma omp for schedule(static)
      for (int group = 0; group < blocks_.groups(); ++group) work(g, group);
    }
  }

  struct Places {
    int starts[lane_count], ends[lane_count], lengths[lane_count];
  };
  Places places(int group) const {
    Places p;
    for (int l = 0; l < lane_count; ++l) {
      p.starts[l] = blocks_.begin(lane_count * group + l);
      p.lengths[l] = blocks_.length(lane_count * group + l);
      p.ends[l] = p.starts[l] + p.lengths[l];
    }
    return p;
  }

  /// Of the cell behind a row; none behind the last one of an open curve.
  double width(int row) const {
    if (row < 0) row = problem_.closed ? rows_ - 1 : rows_;
    if (row + 1 >= static_cast<int>(problem_.knots.size())) return 0;
    const auto k = static_cast<std::size_t>(row);
    return (problem_.knots[k + 1] - problem_.knots[k]) * per_unit_;
  }

  void gather(const Places& at, Group& g) const {
    gather_lanes(at.starts, g.steps, g.softness, [&](int l, int row, int n, double* out) {
      const int inside = std::clamp(at.ends[l] - row, 0, n);
      if (problem_.weights.empty()) std::fill(out, out + inside, problem_.lambda);
      for (int k = 0; k < inside && !problem_.weights.empty(); ++k)
        out[k] = std::clamp(problem_.lambda / problem_.weights[static_cast<std::size_t>(row + k)], 1e-100, 1e100);
      std::fill(out + inside, out + n, nothing);
    });
    int before[lane_count];
    for (int l = 0; l < lane_count; ++l) before[l] = at.starts[l] - 1;
    gather_lanes(before, g.steps + 1, g.widths, [&](int l, int row, int n, double* out) {
      const double* const knots = problem_.knots.data() + row;
      const bool is_inside = row >= 0 && row + n <= at.ends[l] && row + n < static_cast<int>(problem_.knots.size());
      for (int k = 0; k < n; ++k)
        out[k] = is_inside ? (knots[k + 1] - knots[k]) * per_unit_ : row + k < at.ends[l] ? width(row + k) : 0;
    });
  }

  void gather_points(const Places& at, int column, Group& g) const {
    const double* const points = problem_.points.col(column).data();
    gather_lanes(at.starts, g.steps, g.points, [&](int l, int row, int n, double* out) {
      const int inside = std::clamp(at.ends[l] - row, 0, n);
      std::copy(points + row, points + row + inside, out);
      std::fill(out + inside, out + n, 0.);
    });
  }

  void describe(Group& g, int group, std::vector<BlockElement>& elements, StateColumns& b, StateColumns& kappa) const {
    const Places at = places(group);
    gather(at, g);
    Element e;
    describe_covariances(g, e);
    const int lanes = std::min(lane_count, blocks_.count() - lane_count * group);
    for (int l = 0; l < lanes; ++l) {
      BlockElement& element = elements[static_cast<std::size_t>(lane_count * group + l)];
      element.a << e.a[0][l], e.a[1][l], e.a[2][l], e.a[3][l];
      element.c << e.c.uu[l], e.c.us[l], e.c.us[l], e.c.ss[l];
      element.j << e.j.uu[l], e.j.us[l], e.j.us[l], e.j.ss[l];
    }
    for (int column = 0; column < d_; ++column) {
      gather_points(at, column, g);
      State mean{}, pull;
      describe_means(g, mean, pull);
      for (int l = 0; l < lanes; ++l) {
        const Eigen::Index k = (lane_count * group + l) * d_ + column;
        b.col(k) << mean.value[l], mean.slope[l];
        kappa.col(k) << pull.value[l], pull.slope[l];
      }
    }
  }

  void fill(Group& g, int group, const BlockEnds& ends, Eigen::MatrixXd& result) const {
    const Places at = places(group);
    gather(at, g);
    Symmetric c;
    find_gains(g, c);
    const int lanes = std::min(lane_count, blocks_.count() - lane_count * group);
    for (int column = 0; column < d_; ++column) {
      gather_points(at, column, g);
      State state{}, costate{};
      for (int l = 0; l < lanes; ++l) {
        const Eigen::Index k = (lane_count * group + l) * d_ + column;
        state.value[l] = ends.states(0, k);
        state.slope[l] = ends.states(1, k);
        costate.value[l] = ends.costates(0, k);
        costate.slope[l] = ends.costates(1, k);
      }
      fill_in(g, state, c, costate);
      scatter_lanes(at.starts, at.lengths, 0, g.points, result.col(column).data());
    }
  }

  static constexpr double nothing = 1e100;  // softness of a point that does not count

  const SmoothingProblem& problem_;
  LaneBlocks blocks_;
  int rows_, d_;
  double per_unit_;
};

}  // namespace

Eigen::MatrixXd smoothing_coefficients(const SmoothingProblem& problem) { return Smoothing(problem).coefficients(); }

}  // namespace batten
