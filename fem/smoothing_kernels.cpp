// SPDX-License-Identifier: MIT
#include <batten/fem/smoothing_kernels.h>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones. There are no choices between lanes: compilers make them one by one.

namespace batten {

SmoothingSteps::SmoothingSteps(int count, bool has_sweep_back) {
  const auto n = static_cast<std::size_t>(count);
  widths.resize(n + 1);
  for (LaneSteps* s : {&softness, &points[0], &points[1]}) s->resize(n);
  if (has_sweep_back)
    for (LaneSteps* s : {&gain, &slope_gain, &pulls[0], &pulls[1]}) s->resize(n);
}

LaneElement::LaneElement() : a{}, c{}, j_uu{}, j_us{}, j_ss{}, b{}, kappa{} { a[0] += 1, a[3] += 1; }

namespace {

constexpr double third = 1. / 3;  // divisions take longer than all else

/// Of the filter at a point, from the covariance before it.
struct Gains {
  Lanes inverse, rest, value, slope;  // 1 / S, λ / w / S, P_00 / S, P_10 / S
};

[[gnu::always_inline]] inline Gains gains_at(const LaneCovariance& p, Lanes softness) {
  const Lanes inverse = 1 / (p.u + softness);
  return {inverse, softness * inverse, p.u * inverse, p.v * inverse};
}

/// Updated, P is (λ / w P + det P e_1 e_1^T) / S; then A P A^T + q. The next step waits for one division and one
/// product alone, as numerators are found meanwhile.
[[gnu::always_inline]] inline void advance(LaneCovariance& p, Lanes inverse, Lanes softness, Lanes h) {
  const Lanes hh = h * h, cube = hh * h * third, hz = h * p.z;
  const Lanes u = softness * (p.u + h * (2 * p.v + hz)) + hh * p.det;
  const Lanes v = softness * (p.v + hz) + h * p.det;
  const Lanes z = softness * p.z + p.det;
  const Lanes det = softness * (p.det + h * (p.u + h * (p.v + hz * third))) + cube * p.det;
  p = {u * inverse + cube, v * inverse + hh * 0.5, z * inverse + h, det * inverse + hh * hh * (third / 4)};
}

[[gnu::always_inline]] inline void advance(LaneState& mean, const Gains& gains, Lanes miss, Lanes h) {
  mean.slope += gains.slope * miss;
  mean.value += gains.value * miss + h * mean.slope;
}

/// A and J; f and s are the first row of A over S.
[[gnu::always_inline]] inline void advance(LaneElement& e, const Gains& gains, Lanes f, Lanes s, Lanes h) {
  e.j_uu += e.a[0] * f;
  e.j_us += e.a[0] * s;
  e.j_ss += e.a[1] * s;
  e.a[2] -= gains.slope * e.a[0];
  e.a[3] -= gains.slope * e.a[1];
  e.a[0] = gains.rest * e.a[0] + h * e.a[2];
  e.a[1] = gains.rest * e.a[1] + h * e.a[3];
}

template <int components>
[[gnu::always_inline]] inline void describe_steps(const SmoothingSteps& steps, int count, LaneElement& element) {
  LaneElement e = element;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const Lanes h = steps.widths[k + 1].value, softness = steps.softness[k].value;
    const Gains gains = gains_at(e.c, softness);
    const Lanes f = e.a[0] * gains.inverse, s = e.a[1] * gains.inverse;
    for (int c = 0; c < components; ++c) {
      const Lanes miss = steps.points[c][k].value - e.b[c].value;
      e.kappa[c].value += f * miss;
      e.kappa[c].slope += s * miss;
      advance(e.b[c], gains, miss, h);
    }
    advance(e, gains, f, s, h);
    advance(e.c, gains.inverse, softness, h);
  }
  element = e;
}

template <int components>
[[gnu::always_inline]] inline void filter_steps(SmoothingSteps& steps, int begin, int end, LaneFilter& filter) {
  LaneFilter f = filter;
  for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
    const Lanes h = steps.widths[k + 1].value, softness = steps.softness[k].value;
    const Gains gains = gains_at(f.p, softness);
    steps.gain[k].value = gains.value;
    steps.slope_gain[k].value = gains.slope;
    for (int c = 0; c < components; ++c) {
      const Lanes miss = steps.points[c][k].value - f.means[c].value;
      steps.pulls[c][k].value = gains.inverse * miss;
      advance(f.means[c], gains, miss, h);
    }
    advance(f.p, gains.inverse, softness, h);
  }
  filter = f;
}

template <int components>
[[gnu::always_inline]] inline void fill_in_steps(SmoothingSteps& steps, int count, const LaneState* costates,
                                                 const Lanes* values) {
  LaneState y[components];
  Lanes next[components];
  for (int c = 0; c < components; ++c) y[c] = costates[c], next[c] = values[c];
  for (auto k = static_cast<std::size_t>(count); k-- > 0;) {
    const Lanes before = steps.widths[k].value, after = steps.widths[k + 1].value, per_after = 1 / after;
    const Lanes gain = steps.gain[k].value, slope_gain = steps.slope_gain[k].value;
    for (int c = 0; c < components; ++c) {
      const Lanes bend = y[c].slope + after * y[c].value, bend_next = y[c].slope;
      const Lanes force = slope_gain * bend + (gain * y[c].value - steps.pulls[c][k].value);
      const Lanes value = steps.points[c][k].value + steps.softness[k].value * force;
      const Lanes slope = (next[c] - value) * per_after - after * (2 * bend + bend_next) * (third / 2);
      steps.points[c][k].value = value + slope * (after - before) * third - bend * before * after * (third / 2);
      y[c] = {y[c].value - force, bend};
      next[c] = value;
    }
  }
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void fill_lanes(LaneStep* steps, int count, double number) {
  for (int k = 0; k < count; ++k) steps[k].value = Lanes{} + number;
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void soften(LaneStep* weights, int count, double lambda) {
  auto* const numbers = reinterpret_cast<double*>(weights);
  for (int k = 0; k < count * lane_count; ++k) {
    const double softness = lambda / numbers[k], firm = softness > 1e-100 ? softness : 1e-100;
    numbers[k] = firm < most_soft ? firm : most_soft;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void describe(const SmoothingSteps& steps, int count, int components, LaneElement& element) {
  components == 1 ? describe_steps<1>(steps, count, element) : describe_steps<2>(steps, count, element);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void sweep_forwards(SmoothingSteps& steps, int begin, int end, int components, LaneFilter& filter) {
  components == 1 ? filter_steps<1>(steps, begin, end, filter) : filter_steps<2>(steps, begin, end, filter);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void sweep_back(SmoothingSteps& steps, int count, int components, const LaneState* costates, const Lanes* values) {
  components == 1 ? fill_in_steps<1>(steps, count, costates, values) : fill_in_steps<2>(steps, count, costates, values);
}

}  // namespace batten
