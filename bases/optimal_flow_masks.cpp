// SPDX-License-Identifier: MIT
#include <batten/bases/exact_linear_program.h>
#include <batten/bases/optimal_flow_masks.h>

#include <algorithm>
#include <array>
#include <vector>

// One law holds exactly for all masks of the form
//   s11 = 2 (y^(1/2) + y^(-1/2)) + d[x] a,   s21 = d[y] a      (the law of rotation for perfect flow),
//   s11 = m (x^(1/2) + x^(-1/2)) + d[y] b,   s21 = -d[x] b     (the commuting law of divergence),
// a odd in x and even in y with half powers, b even in x and odd in y with whole powers; so a and b are the unknowns.
// For slow flow and the book's kind they are s11 and s21 themselves. All are combinations of orbits of monomials.

namespace batten {
namespace {

struct MaskSymmetrySigns {
  int x, y;
};

/// Images of an index under x -> 1/x, y -> 1/y without repetitions, and their signs.
std::vector<std::pair<Index<2>, int>> orbit_of(const Index<2>& i, const Index<2>& half,
                                               const MaskSymmetrySigns& signs) {
  const Index<2> back{-i[0] - half[0], -i[1] - half[1]};
  std::vector<std::pair<Index<2>, int>> orbit{{i, 1}};
  if (back[0] != i[0]) orbit.emplace_back(Index<2>{back[0], i[1]}, signs.x);
  if (back[1] != i[1]) orbit.emplace_back(Index<2>{i[0], back[1]}, signs.y);
  if (back[0] != i[0] && back[1] != i[1]) orbit.emplace_back(back, signs.x * signs.y);
  return orbit;
}

/// The polynomials with these symmetries whose exponents are at most twice_limit / 2, one for each orbit.
std::vector<Mask2<Rational>> orbits(int twice_limit, const Index<2>& half, const MaskSymmetrySigns& signs) {
  std::vector<Mask2<Rational>> all;
  for (int j = signs.y < 0 && half[1] == 0 ? 1 : 0; 2 * j + half[1] <= twice_limit; ++j)
    for (int i = signs.x < 0 && half[0] == 0 ? 1 : 0; 2 * i + half[0] <= twice_limit; ++i) {
      auto& orbit = all.emplace_back();
      for (const auto& [image, sign] : orbit_of({i, j}, half, signs))
        orbit += Mask2<Rational>::monomial(image, sign, half);
    }
  return all;
}

/// start + Σ unknown · direction: the masks among which the best are sought.
struct FlowMaskFamily {
  FlowMasks<Rational> start;
  std::vector<FlowMasks<Rational>> directions;
};

FlowMaskFamily family_of(Flow flow, FlowKind kind, int size) {
  const auto dx = staggered_difference(0), dy = staggered_difference(1);
  const Mask2<Rational> pair_x({-1, 0}, {2, 1}, {1, 1}, {1, 0}), pair_y = swapped(pair_x);
  FlowMaskFamily family;
  if (kind == FlowKind::Commuting) {
    family.start.s11 = flux_mask() * pair_x;
    for (const auto& b : orbits(size - 1, {0, 0}, {1, -1})) family.directions.push_back({dy * b, -dx * b});
  } else if (flow == Flow::Perfect) {
    family.start.s11 = Rational(2) * pair_y;
    for (const auto& a : orbits(size - 2, {1, 1}, {-1, 1})) family.directions.push_back({dx * a, dy * a});
  } else {
    for (const auto& s11 : orbits(size, {0, 1}, {1, 1})) family.directions.push_back({s11, {}});
    for (const auto& s21 : orbits(size, {1, 0}, {-1, -1})) family.directions.push_back({{}, s21});
  }
  return family;
}

/// Minimise the sum of the flow_norm() of the residuals. The unknowns: those of the family; then for each residual a
/// bound t, positive and negative part of each coefficient, and what each sum of them lacks to t.
class ResidualProgram {
public:
  explicit ResidualProgram(const FlowMaskFamily& family) : next_(static_cast<int>(family.directions.size())) {
    program_.free_unknowns = next_;
  }

  /// A residual of the start, and what each unknown adds to it.
  void add_residual(const Mask2<Rational>& start, const std::vector<Mask2<Rational>>& additions) {
    Index<2> half = start.half();
    int reach = reach_of(start);
    for (const auto& a : additions) {
      if (!a.is_zero()) half = a.half();
      reach = std::max(reach, reach_of(a));
    }
    const int bound = next_++;
    bounds_.push_back(bound);
    std::array<std::array<std::vector<int>, 2>, 2> members;  // parts of coefficients by parity of their index, repeated
    for (int j = 0; j <= reach; ++j)
      for (int i = 0; i <= reach; ++i) add_orbit({i, j}, half, start, additions, members);
    for (std::size_t a : {0, 1})
      for (std::size_t b = 0; b <= a; ++b) bound_sum(bound, members[a][1 - b], members[b][1 - a]);
  }

  /// Σ terms = right.
  void add_equation(ExactEquation equation) {
    if (!equation.terms.empty()) program_.equations.push_back(std::move(equation));
  }

  const LinearProgram& program() {
    program_.costs.assign(static_cast<std::size_t>(next_), 0);
    for (int bound : bounds_) program_.costs[static_cast<std::size_t>(bound)] = 1;
    return program_;
  }

private:
  static int reach_of(const Mask2<Rational>& r) { return r.is_zero() ? -1 : std::max(r.last()[0], r.last()[1]); }

  void add_orbit(const Index<2>& i, const Index<2>& half, const Mask2<Rational>& start,
                 const std::vector<Mask2<Rational>>& additions,
                 std::array<std::array<std::vector<int>, 2>, 2>& members) {
    ExactEquation equation{{}, -start[i]};
    for (std::size_t u = 0; u < additions.size(); ++u)
      if (const Rational factor = additions[u][i]; factor != 0)
        equation.terms.emplace_back(static_cast<int>(u), factor);
    if (equation.terms.empty() && equation.right == 0) return;
    const int part = next_;
    next_ += 2;
    equation.terms.emplace_back(part, Rational(-1));
    equation.terms.emplace_back(part + 1, Rational(1));
    program_.equations.push_back(std::move(equation));
    for (const auto& [image, sign] : orbit_of(i, half, {1, 1}))
      members[static_cast<std::size_t>(image[0] & 1)][static_cast<std::size_t>(image[1] & 1)].push_back(part);
  }

  /// The sum of |coefficient| over two lists of parts is at most the bound.
  void bound_sum(int bound, const std::vector<int>& first, const std::vector<int>& second) {
    if (first.empty() && second.empty()) return;
    std::vector<Rational> counts(static_cast<std::size_t>(next_));
    for (const auto* list : {&first, &second})
      for (int part : *list) counts[static_cast<std::size_t>(part)] += 1;
    ExactEquation sum{{{bound, Rational(-1)}, {next_++, Rational(1)}}, 0};
    for (std::size_t part = 0; part < counts.size(); ++part)
      if (counts[part] != 0)
        for (int sign : {0, 1}) sum.terms.emplace_back(static_cast<int>(part) + sign, counts[part]);
    program_.equations.push_back(std::move(sum));
  }

  int next_;
  std::vector<int> bounds_;
  LinearProgram program_;
};

/// The sum of the coefficients whose power of x has a parity.
Rational column_sum(const Mask2<Rational>& s, int parity) {
  Rational sum = 0;
  for (const Index<2>& i : indices_of<2>({s.first(), s.last()}))
    if ((i[0] & 1) == parity) sum += s[i];
  return sum;
}

/// s11 is even in y, so that its four cosets sum to 1 when those of even and of odd powers of x sum to 2; the cosets of
/// s21, which is odd, sum to 0.
void add_precision(ResidualProgram& program, const FlowMaskFamily& family) {
  for (int parity : {0, 1}) {
    ExactEquation equation{{}, 2 - column_sum(family.start.s11, parity)};
    for (std::size_t u = 0; u < family.directions.size(); ++u)
      if (const Rational factor = column_sum(family.directions[u].s11, parity); factor != 0)
        equation.terms.emplace_back(static_cast<int>(u), factor);
    program.add_equation(std::move(equation));
  }
}

void add_residuals(ResidualProgram& program, const FlowMaskFamily& family, Flow flow, FlowKind kind) {
  const auto start = flow_residuals(flow, kind, family.start);
  const auto none = flow_residuals(flow, kind, FlowMasks<Rational>{});
  std::vector<Mask2<Rational>> divergences, rotations;
  for (const auto& direction : family.directions) {
    const auto r = flow_residuals(flow, kind, direction);
    divergences.push_back(r.divergence - none.divergence);
    rotations.push_back(r.rotation - none.rotation);
  }
  program.add_residual(start.divergence, divergences);
  program.add_residual(start.rotation, rotations);
}

}  // namespace

OptimalFlowMasks optimal_flow_masks(Flow flow, FlowKind kind, int size) {
  require_flow_size("optimal_flow_masks", size);
  const FlowMaskFamily family = family_of(flow, kind, size);
  ResidualProgram program(family);
  add_residuals(program, family, flow, kind);
  add_precision(program, family);
  const LinearOptimum found = optimum(program.program());
  FlowMasks<Rational> masks = family.start;
  for (std::size_t u = 0; u < family.directions.size(); ++u) {
    masks.s11 += found.values[u] * family.directions[u].s11;
    masks.s21 += found.values[u] * family.directions[u].s21;
  }
  const auto r = flow_residuals(flow, kind, masks);
  return {std::move(masks), flow_norm(r.divergence), flow_norm(r.rotation)};
}

}  // namespace batten
