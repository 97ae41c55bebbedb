// SPDX-License-Identifier: MIT
#include <batten/fem/lane_squares.h>
#include <batten/fem/smoothing_kernels.h>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones. There are no choices between lanes: compilers make them one by one.

namespace batten {

SmoothingSteps::SmoothingSteps(int count, bool has_sweep_back) {
  const auto n = static_cast<std::size_t>(count);
  widths.resize(n + 1);
  for (LaneSteps* s : {&weights, &points[0], &points[1]}) s->resize(n);
  if (has_sweep_back)
    for (LaneSteps* s : {&gain, &slope_gain, &pulls[0], &pulls[1]}) s->resize(n);
}

LaneElement::LaneElement() : a{}, c{}, j_uu{}, j_us{}, j_ss{}, b{}, kappa{} { a[0] += 1, a[3] += 1; }

namespace {

constexpr double third = 1. / 3;  // divisions take longer than all else

/// The weight of a step in each lane; of steps.
struct One {
  [[gnu::always_inline]] Lanes times(Lanes x) const { return x; }
};
struct Weight {
  Lanes w;
  [[gnu::always_inline]] Lanes times(Lanes x) const { return w * x; }
};
struct Equal {
  [[gnu::always_inline]] One at(std::size_t) const { return {}; }
};
struct Weighted {
  const LaneStep* weights;
  [[gnu::always_inline]] Weight at(std::size_t k) const { return {weights[k].value}; }
};

/// Updated, P is (P + w det P e_1 e_1^T) / S; then A P A^T + q. The next step waits for one division and one product
/// alone, as numerators are found meanwhile. `force` is w det P.
[[gnu::always_inline]] inline void advance(LaneCovariance& p, Lanes inverse, Lanes force, Lanes h) {
  const Lanes hh = h * h, hh_third = hh * third, cube = hh_third * h, z = p.z + force;
  const Lanes u = p.u + (h + h) * p.v + hh * z, v = p.v + h * z;
  const Lanes det = p.det + cube * force + h * (p.u + h * p.v + hh_third * p.z);
  p = {u * inverse + cube, v * inverse + hh * 0.5, z * inverse + h, det * inverse + hh * hh * (third / 4)};
}

/// From P before the point and the pull w (b - m_0) / S.
[[gnu::always_inline]] inline void advance(LaneState& mean, const LaneCovariance& p, Lanes pull, Lanes h) {
  mean.slope += p.v * pull;
  mean.value = mean.value + p.u * pull + h * mean.slope;
}

/// The chunk of lines at `from` as steps from `to` on.
template <int components>
[[gnu::always_inline]] inline void gather(const StepLines& lines, int from, int to, SmoothingSteps& steps) {
  gather_difference_chunk(lines.knots, from, lines.per_unit, steps.widths.data() + to + 1);
  for (int c = 0; c < components; ++c) gather_chunk(lines.points[c], from, steps.points[c].data() + to);
  if (from < lines.equal) return;
  LaneStep* const weights = steps.weights.data() + to;
  gather_chunk(lines.weights, from, weights);
  for (int k = 0; k < lane_chunk; ++k) weights[k].value *= lines.per_weight;
}

template <int components, class Weights>
[[gnu::always_inline]] inline void describe_chunk(const SmoothingSteps& steps, int begin, Weights weights,
                                                  LaneElement& e) {
  for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(begin + lane_chunk); ++k) {
    const LaneCovariance p = e.c;
    const auto w = weights.at(k);
    const Lanes h = steps.widths[k + 1].value, inverse = 1 / (1 + w.times(p.u));
    advance(e.c, inverse, w.times(p.det), h);
    const Lanes u = e.a[0] * inverse, s = e.a[1] * inverse;  // the first row of A, updated
    const Lanes wu = w.times(u), ws = w.times(s), per_miss = w.times(inverse);
    for (int c = 0; c < components; ++c) {
      const Lanes pull = per_miss * (steps.points[c][k].value - e.b[c].value);
      e.kappa[c].value += e.a[0] * pull;
      e.kappa[c].slope += e.a[1] * pull;
      advance(e.b[c], p, pull, h);
    }
    e.j_uu += e.a[0] * wu;
    e.j_us += e.a[0] * ws;
    e.j_ss += e.a[1] * ws;
    e.a[2] -= p.v * wu;
    e.a[3] -= p.v * ws;
    e.a[0] = u + h * e.a[2];
    e.a[1] = s + h * e.a[3];
  }
}

template <int components>
[[gnu::always_inline]] inline void describe_lines(const StepLines& lines, SmoothingSteps& steps, LaneElement& element) {
  LaneElement e = element;
  int k = 0;
  for (; k < lines.equal; k += lane_chunk) {
    gather<components>(lines, k, k, steps);
    describe_chunk<components>(steps, k, Equal{}, e);
  }
  for (; k < lines.count; k += lane_chunk) {
    gather<components>(lines, k, k, steps);
    describe_chunk<components>(steps, k, Weighted{steps.weights.data()}, e);
  }
  element = e;
}

template <int components, class Weights>
[[gnu::always_inline]] inline void filter_chunk(SmoothingSteps& steps, int begin, Weights weights, LaneFilter& f) {
  for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(begin + lane_chunk); ++k) {
    const LaneCovariance p = f.p;
    const auto w = weights.at(k);
    const Lanes h = steps.widths[k + 1].value, inverse = 1 / (1 + w.times(p.u)), per_miss = w.times(inverse);
    advance(f.p, inverse, w.times(p.det), h);
    steps.gain[k].value = p.u * inverse;
    steps.slope_gain[k].value = p.v * inverse;
    for (int c = 0; c < components; ++c) {
      const Lanes pull = per_miss * (steps.points[c][k].value - f.means[c].value);
      steps.pulls[c][k].value = pull;
      steps.points[c][k].value = f.means[c].value + p.u * pull;
      advance(f.means[c], p, pull, h);
    }
  }
}

template <int components>
[[gnu::always_inline]] inline void filter_lines(const StepLines& lines, int from, SmoothingSteps& steps,
                                                LaneFilter& filter) {
  LaneFilter f = filter;
  int k = 0;
  for (; k < lines.equal; k += lane_chunk) {
    gather<components>(lines, k, from + k, steps);
    filter_chunk<components>(steps, from + k, Equal{}, f);
  }
  for (; k < lines.count; k += lane_chunk) {
    gather<components>(lines, k, from + k, steps);
    filter_chunk<components>(steps, from + k, Weighted{steps.weights.data()}, f);
  }
  filter = f;
}

/// Costates and values behind the steps that are left.
template <int components>
struct Behind {
  LaneState y[components];
  Lanes next[components];
};

template <int components, class Weights>
[[gnu::always_inline]] inline void fill_in_chunk(SmoothingSteps& steps, int begin, Weights weights,
                                                 Behind<components>& behind) {
  for (auto k = static_cast<std::size_t>(begin + lane_chunk); k-- > static_cast<std::size_t>(begin);) {
    const auto w = weights.at(k);
    const Lanes before = steps.widths[k].value, after = steps.widths[k + 1].value, per_after = 1 / after;
    const Lanes gain = steps.gain[k].value, slope_gain = steps.slope_gain[k].value;
    for (int c = 0; c < components; ++c) {
      LaneState& y = behind.y[c];
      const Lanes bend = y.slope + after * y.value, bend_next = y.slope;
      const Lanes change = slope_gain * bend + gain * y.value;
      const Lanes value = steps.points[c][k].value + change;
      const Lanes slope = (behind.next[c] - value) * per_after - after * (2 * bend + bend_next) * (third / 2);
      y = {y.value + steps.pulls[c][k].value - w.times(change), bend};
      steps.points[c][k].value = value + slope * (after - before) * third - bend * before * after * (third / 2);
      behind.next[c] = value;
    }
  }
}

template <int components>
[[gnu::always_inline]] inline void scatter(const SmoothingSteps& steps, int k, const CoefficientLines& lines) {
  if (k >= lines.shared) return;
  for (int c = 0; c < components; ++c)
    scatter_chunk(steps.points[c].data() + k, lines.coefficients[c], k, -lane_foresight);
}

template <int components>
[[gnu::always_inline]] inline void fill_in_lines(const LaneState* costates, const Lanes* values, SmoothingSteps& steps,
                                                 const CoefficientLines& lines) {
  Behind<components> behind;
  for (int c = 0; c < components; ++c) behind.y[c] = costates[c], behind.next[c] = values[c];
  int k = lines.count;
  while (k > lines.equal) {
    k -= lane_chunk;
    fill_in_chunk(steps, k, Weighted{steps.weights.data()}, behind);
    scatter<components>(steps, k, lines);
  }
  while (k > 0) {
    k -= lane_chunk;
    fill_in_chunk(steps, k, Equal{}, behind);
    scatter<components>(steps, k, lines);
  }
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void describe(const StepLines& lines, SmoothingSteps& steps, LaneElement& element) {
  lines.components == 1 ? describe_lines<1>(lines, steps, element) : describe_lines<2>(lines, steps, element);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void sweep_forwards(const StepLines& lines, int from, SmoothingSteps& steps, LaneFilter& filter) {
  lines.components == 1 ? filter_lines<1>(lines, from, steps, filter) : filter_lines<2>(lines, from, steps, filter);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void sweep_back(const LaneState* costates, const Lanes* values, SmoothingSteps& steps, const CoefficientLines& lines) {
  lines.components == 1 ? fill_in_lines<1>(costates, values, steps, lines)
                        : fill_in_lines<2>(costates, values, steps, lines);
}

}  // namespace batten
