// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/domains/errors.h>

#include <cmath>
#include <map>

// Cone splines from cone splines of one direction less. Differentiation along a direction of Σ removes it,
// D_ξ c_Σ = c_{Σ\ξ}, and c_Σ is homogeneous of degree m - 2, so that with two directions ξ, η of Σ that span
//   x = t ξ + u η:   (m - 2) c_Σ(x) = t c_{Σ\ξ}(x) + u c_{Σ\η}(x)        (Euler)
//   v = a ξ + b η:           D_v c_Σ = a c_{Σ\ξ} + b c_{Σ\η}
// and c of two directions is 1/|det| in their cone. What no longer spans is a measure on a line and 0 beside it; all
// values are taken beside the lines, at (x + ε, y + ε²) for ε -> 0, where every term is a polynomial in its cell.

namespace batten {
namespace {

Integer determinant(const Index<2>& a, const Index<2>& b) { return Integer(a[0]) * b[1] - Integer(a[1]) * b[0]; }

class ConeSpline {
public:
  explicit ConeSpline(const Directions& directions) {
    for (const auto& direction : directions) {
      std::size_t k = 0;
      while (k < distinct_.size() && distinct_[k] != direction) ++k;
      if (k == distinct_.size()) {
        distinct_.push_back(direction);
        counts_.push_back(0);
      }
      ++counts_[k];
    }
  }

  Rational operator()(const Rational& x, const Rational& y, const Index<2>& order) {
    x_ = x;
    y_ = y;
    known_.clear();
    auto counts = counts_;
    counts.push_back(order[0]);
    counts.push_back(order[1]);
    return value(counts);
  }

private:
  using State = std::vector<int>;  // how often each direction is left, then the order of the derivative

  Rational value(const State& state) {
    const auto found = known_.find(state);
    if (found != known_.end()) return found->second;
    return known_[state] = computed(state);
  }

  Rational computed(const State& state) {
    const std::size_t n = distinct_.size();
    std::size_t i = 0;
    while (i < n && state[i] == 0) ++i;
    std::size_t j = i;
    while (j < n && (state[j] == 0 || determinant(distinct_[i], distinct_[j]) == 0)) ++j;
    if (j >= n) return 0;  // the rest does not span
    int m = 0;
    for (std::size_t k = 0; k < n; ++k) m += state[k];
    const Rational scale(determinant(distinct_[i], distinct_[j]));
    for (std::size_t axis : {0, 1}) {
      if (state[n + axis] == 0) continue;
      if (m == 2) return 0;
      const Index<2> v = axis == 0 ? Index<2>{1, 0} : Index<2>{0, 1};
      return (Rational(determinant(v, distinct_[j])) * value(without(state, i, n + axis)) +
              Rational(determinant(distinct_[i], v)) * value(without(state, j, n + axis))) /
             scale;
    }
    if (m == 2) return is_inside(i, j) ? Rational(1 / abs(scale)) : Rational(0);
    const Rational t = (x_ * distinct_[j][1] - y_ * distinct_[j][0]) / scale;
    const Rational u = (y_ * distinct_[i][0] - x_ * distinct_[i][1]) / scale;
    Rational sum = 0;
    if (t != 0) sum += t * value(without(state, i));
    if (u != 0) sum += u * value(without(state, j));
    return sum / (m - 2);
  }

  static State without(State state, std::size_t i) {
    --state[i];
    return state;
  }
  static State without(State state, std::size_t i, std::size_t j) { return without(without(std::move(state), i), j); }

  /// Whether (x + ε, y + ε²) = t ξ_i + u ξ_j with t, u > 0.
  bool is_inside(std::size_t i, std::size_t j) const {
    const Index<2>&a = distinct_[i], &b = distinct_[j];
    const int orientation = determinant(a, b) > 0 ? 1 : -1;
    return orientation * side(b[1], -b[0]) > 0 && orientation * side(-a[1], a[0]) > 0;
  }

  /// The sign of p (x + ε) + q (y + ε²).
  int side(int p, int q) const {
    const Rational at = x_ * p + y_ * q;
    if (at != 0) return at > 0 ? 1 : -1;
    return p != 0 ? (p > 0 ? 1 : -1) : (q > 0 ? 1 : -1);
  }

  Directions distinct_;
  State counts_;
  Rational x_, y_;
  std::map<State, Rational> known_;
};

bool points_up(const Index<2>& direction) { return direction[1] > 0 || (direction[1] == 0 && direction[0] > 0); }

void require_order(const char* function, const Index<2>& order) {
  if (order[0] < 0 || order[1] < 0)
    throw InvalidInput(std::string(function) + ": the order of a derivative must not be negative, found " +
                       std::to_string(order[0]) + ", " + std::to_string(order[1]));
}

}  // namespace

Rational cone_spline_value(const Directions& directions, const Rational& x, const Rational& y, const Index<2>& order) {
  zonogon(directions);  // throws for directions that do not span
  require_order("cone_spline_value", order);
  for (const auto& direction : directions)
    if (!points_up(direction))
      throw InvalidInput("cone_spline_value: directions must have y > 0, or y = 0 and x > 0, found " +
                         std::to_string(direction[0]) + "," + std::to_string(direction[1]));
  return ConeSpline(directions)(x, y, order);
}

Rational box_spline_value(const Directions& directions, const Rational& x, const Rational& y, const Index<2>& order) {
  zonogon(directions);  // throws for directions that do not span
  require_order("box_spline_value", order);
  // n of a direction and n of its opposite differ by a shift: all are turned up.
  Directions up = directions;
  Rational px = x, py = y;
  for (auto& [a, b] : up) {
    if (points_up({a, b})) continue;
    px -= a;
    py -= b;
    a = -a;
    b = -b;
  }
  const auto d = box_difference_mask(up);
  const Index<2> first = d.first(), last = d.last();
  if (px < first[0] || px > last[0] || py < first[1] || py > last[1]) return 0;
  ConeSpline cone(up);
  Rational value = 0;
  for (int j = first[1]; j <= last[1] && py >= j; ++j)
    for (int i = first[0]; i <= last[0]; ++i) {
      const Rational weight = d[{i, j}];
      if (weight != 0) value += weight * cone(px - i, py - j, order);
    }
  return value;
}

double box_spline_value(const Directions& directions, double x, double y, const Index<2>& order) {
  if (!std::isfinite(x) || !std::isfinite(y))
    throw InvalidInput("box_spline_value: the position must be finite, found " + std::to_string(x) + ", " +
                       std::to_string(y));
  return static_cast<double>(box_spline_value(directions, Rational(x), Rational(y), order));
}

}  // namespace batten
