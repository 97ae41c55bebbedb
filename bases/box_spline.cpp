// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <numeric>
#include <string>

namespace batten {
namespace {

constexpr std::size_t most_directions = 24;

int determinant(const Index<2>& a, const Index<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

std::string text_of(const Directions& directions) {
  std::string text;
  for (const auto& [a, b] : directions)
    text.append(text.empty() ? "" : ";").append(std::to_string(a)).append(",").append(std::to_string(b));
  return "'" + text + "'";
}

void require_spanning(const char* function, const Directions& directions) {
  if (directions.size() > most_directions)
    throw InvalidInput(std::string(function) + ": at most " + std::to_string(most_directions) +
                       " directions are possible, found " + std::to_string(directions.size()));
  bool spans = false;
  for (const auto& a : directions) {
    if (a == Index<2>{})
      throw InvalidInput(std::string(function) + ": directions must not be 0,0, found " + text_of(directions));
    if (std::abs(a[0]) > 1000 || std::abs(a[1]) > 1000)
      throw InvalidInput(std::string(function) + ": entries of directions must be -1000 to 1000, found " +
                         text_of(directions));
    spans = spans || determinant(directions.front(), a) != 0;
  }
  if (!spans)
    throw InvalidInput(std::string(function) + ": the directions must span the plane, found " + text_of(directions));
}

/// c (1 + sign x^a y^b)
Mask2<Rational> factor(const Index<2>& direction, const Rational& c, int sign) {
  return Mask2<Rational>::monomial({}, c) + Mask2<Rational>::monomial(direction, sign * c);
}

/// a > 0 or, on the axis, b > 0: the half plane of cone splines.
bool points_up(const Index<2>& direction) { return direction[1] > 0 || (direction[1] == 0 && direction[0] > 0); }

}  // namespace

Mask2<Rational> box_mask(const Directions& directions) {
  require_spanning("box_mask", directions);
  auto mask = Mask2<Rational>::constant(4);
  for (const auto& direction : directions) mask *= factor(direction, Rational(1, 2), 1);
  return mask;
}

Scheme2 box_scheme(const Directions& directions) {
  require_spanning("box_scheme", directions);
  return {"box " + text_of(directions), box_mask(directions), 2, {.directions = directions}};
}

Mask2<Rational> box_averaged(const Mask2<Rational>& p, const Directions& directions) {
  require_spanning("box_averaged", directions);
  auto result = Rational(4) * upsampled(p, 2);
  for (const auto& direction : directions) result *= factor(direction, Rational(1, 2), 1);
  return result;
}

Mask2<Rational> box_difference_mask(const Directions& directions) {
  require_spanning("box_difference_mask", directions);
  auto mask = Mask2<Rational>::constant(1);
  for (const auto& direction : directions) mask *= factor(direction, 1, -1);
  return mask;
}

int box_continuity(const Directions& directions) {
  require_spanning("box_continuity", directions);
  int most_parallel = 0;
  for (const auto& a : directions) {
    const auto is_parallel = [&](const Index<2>& b) { return determinant(a, b) == 0; };
    most_parallel =
        std::max(most_parallel, static_cast<int>(std::count_if(directions.begin(), directions.end(), is_parallel)));
  }
  return static_cast<int>(directions.size()) - most_parallel - 2;
}

std::vector<Index<2>> zonogon(const Directions& directions) {
  require_spanning("zonogon", directions);
  Directions edges = directions;
  Index<2> corner{};  // the sum of the directions that point down is the lowest
  for (auto& [a, b] : edges) {
    if (points_up({a, b})) continue;
    corner = {corner[0] + a, corner[1] + b};
    a = -a;
    b = -b;
  }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return determinant(a, b) > 0; });
  std::vector<Index<2>> corners;
  for (int sign : {1, -1})
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (k == 0 || determinant(edges[k - 1], edges[k]) != 0) corners.push_back(corner);
      corner = {corner[0] + sign * edges[k][0], corner[1] + sign * edges[k][1]};
    }
  return corners;
}

bool has_independent_translates(const Directions& directions) {
  require_spanning("has_independent_translates", directions);
  for (const auto& a : directions)
    for (const auto& b : directions)
      if (std::abs(determinant(a, b)) > 1) return false;
  return true;
}

}  // namespace batten
