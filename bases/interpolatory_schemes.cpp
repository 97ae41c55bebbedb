// SPDX-License-Identifier: MIT
#include <batten/bases/interpolatory_schemes.h>
#include <batten/domains/errors.h>

namespace batten {
namespace {

/// The old points kept, and the rule for new ones at i + 1/2: weights[k] for both points at distance k + 1/2.
Mask<Rational> symmetric_mask(const std::vector<Rational>& weights) {
  auto mask = Mask<Rational>::constant(1);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const int distance = 2 * static_cast<int>(k) + 1;
    mask += Mask<Rational>::monomial({distance}, weights[k]) + Mask<Rational>::monomial({-distance}, weights[k]);
  }
  return mask;
}

std::string with_weight(const char* name, const Rational& w) { return std::string(name) + " w = " + w.str(); }

/// Weights of the points 1/2, 3/2, ... to either side of 0 in the value there of the polynomial through them
/// (Lagrange).
std::vector<Rational> midpoint_weights(int points) {
  const int n = points / 2;
  std::vector<Rational> weights;
  for (int k = 0; k < n; ++k) {
    Rational weight = 1;  // of the point k + 1/2; twice all distances
    for (int other = -n; other < n; ++other)
      if (other != k) weight *= Rational(-(2 * other + 1)) / (2 * (k - other));
    weights.push_back(weight);
  }
  return weights;
}

}  // namespace

Scheme four_point_scheme(const Rational& w) {
  return {with_weight("four-point", w), symmetric_mask({Rational(1, 2) + w, -w})};
}

Scheme deslauriers_dubuc_scheme(int points) {
  if (points < 2 || points > 64 || points % 2 != 0)
    throw InvalidInput("deslauriers_dubuc_scheme: the number of points must be even, 2 to 64, found " +
                       std::to_string(points));
  return {"deslauriers-dubuc " + std::to_string(points), symmetric_mask(midpoint_weights(points))};
}

Scheme six_point_scheme(const Rational& w) {
  return {with_weight("six-point", w), symmetric_mask({Rational(9, 16) + 2 * w, -(Rational(1, 16) + 3 * w), w})};
}

Scheme ternary_four_point_scheme(const Rational& w) {
  const Rational a = -Rational(1, 18) - w / 6, b = Rational(13, 18) + w / 2;
  const Rational c = Rational(7, 18) - w / 2, d = -Rational(1, 18) + w / 6;
  // p_{3i+1} takes p_{i-1}, p_i, p_{i+1}, p_{i+2} with s[4], s[1], s[-2], s[-5]
  return {with_weight("ternary-four-point", w), Mask<Rational>(-5, {d, a, 0, c, b, 1, b, c, 0, a, d}), 3};
}

Scheme2 butterfly_scheme(const Rational& w) {
  const Rational h(1, 2), d = 2 * w, e = -w;
  return {with_weight("butterfly", w), Mask2<Rational>({-3, -3}, {7, 7}, {0, e, e, 0, 0, 0, 0,  //
                                                                          e, 0, d, 0, e, 0, 0,  //
                                                                          e, d, h, h, d, e, 0,  //
                                                                          0, 0, h, 1, h, 0, 0,  //
                                                                          0, e, d, h, h, d, e,  //
                                                                          0, 0, e, 0, d, 0, e,  //
                                                                          0, 0, 0, 0, e, e, 0})};
}

Scheme2 quad_interpolatory_scheme() {
  const Mask2<Rational> times_32({-3, -3}, {7, 7}, {0,  0, -1, -2, -1, 0, 0,   //
                                                    0,  0, 0,  0,  0,  0, 0,   //
                                                    -1, 0, 10, 18, 10, 0, -1,  //
                                                    -2, 0, 18, 32, 18, 0, -2,  //
                                                    -1, 0, 10, 18, 10, 0, -1,  //
                                                    0,  0, 0,  0,  0,  0, 0,   //
                                                    0,  0, -1, -2, -1, 0, 0});
  return {"quad-interpolatory", Rational(1, 32) * times_32};
}

}  // namespace batten
