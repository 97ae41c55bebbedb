// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/flows/flow_sides.h>

#include <algorithm>

namespace batten {
namespace {

EndCondition end_condition(FlowSide side, const FlowPart& part) {
  switch (side) {
    case FlowSide::Free:
      return EndCondition::Free;
    case FlowSide::Wall:
      return part.is_potential ? EndCondition::Flat : EndCondition::Zero;
    case FlowSide::NoSlip:
      if (part.is_potential && !part.has_other)
        throw InvalidInput("fit_flow: expected walls with slip for a gradient, found walls without");
      return EndCondition::Clamped;
    default:
      return EndCondition::Periodic;
  }
}

void expect_pair(FlowSide a, FlowSide b, const char* names) {
  if ((a == FlowSide::Periodic) != (b == FlowSide::Periodic))
    throw InvalidInput(std::string("fit_flow: expected both of ") + names + " periodic or none, found one");
}

/// 0 at the lower, 1 at the upper end, flat where the walls do not let slip.
std::array<double, 4> ramp(FlowSide lower, FlowSide upper) {
  if (lower == FlowSide::NoSlip)
    return upper == FlowSide::NoSlip ? std::array{0., 0., 3., -2.} : std::array{0., 0., 1., 0.};
  return upper == FlowSide::NoSlip ? std::array{0., 2., -1., 0.} : std::array{0., 1., 0., 0.};
}

/// Values of the blossoms of 1, τ, τ², τ³ at the knots of one B-spline: means of products of different knots.
std::array<double, 4> blossoms(const SplineBasis& basis, int i) {
  const auto knots = basis.interval().breakpoints();
  std::array<double, 4> sums = {1, 0, 0, 0};
  for (int k = 1; k <= basis.degree(); ++k) {
    const int at = std::clamp(i + k - basis.degree(), 0, basis.interval().cells());
    const double t = static_cast<double>(knots[static_cast<std::size_t>(at)]) / basis.interval().finest_cells();
    for (std::size_t p = 3; p > 0; --p) sums[p] += t * sums[p - 1];
  }
  double products = 1;
  for (int p = 1; p <= 3; ++p) {
    products *= (basis.degree() - p + 1.) / p;
    sums[static_cast<std::size_t>(p)] /= products;
  }
  return sums;
}

}  // namespace

bool FlowSides::have(FlowSide side) const {
  const auto sides = all();
  return std::find(sides.begin(), sides.end(), side) != sides.end();
}

bool FlowSides::are_closed() const {
  const auto sides = all();
  return std::all_of(sides.begin(), sides.end(), is_wall);
}

SpaceEnds side_conditions(const FlowSides& s, const FlowPart& part) {
  expect_pair(s.left, s.right, "left and right");
  expect_pair(s.bottom, s.top, "bottom and top");
  if (part.has_other && s.have(FlowSide::NoSlip) && !s.have(FlowSide::Free))
    throw InvalidInput(
        "fit_flow: expected a free side for the model general with walls without slip, found none: its ψ and φ would "
        "leave out all fields with a mean flow");
  const auto end = [&](FlowSide side) { return end_condition(side, part); };
  return {{end(s.left), end(s.right)}, {end(s.bottom), end(s.top)}};
}

int SideFunction::degree() const {
  int result = 3;
  while (result > 0 && c[static_cast<std::size_t>(result)] == 0) --result;
  return result;
}

std::vector<double> SideFunction::coefficients(const SplineSpace& space) const {
  const SplineBasis& basis = along == Along::X ? space.x : space.y;
  std::vector<double> line, result;
  for (int i = 0; i < basis.size(); ++i) {
    const auto b = blossoms(basis, i);
    line.push_back(c[0] * b[0] + c[1] * b[1] + c[2] * b[2] + c[3] * b[3]);
  }
  for (std::size_t j = 0; j < static_cast<std::size_t>(space.y.size()); ++j)
    for (std::size_t i = 0; i < static_cast<std::size_t>(space.x.size()); ++i)
      result.push_back(line[along == Along::X ? i : j]);
  return result;
}

std::vector<SideFunction> side_functions(const FlowSides& s, const FlowPart& part) {
  using Along = SideFunction::Along;
  std::vector<SideFunction> result;
  const auto add = [&](Along along, FlowSide lower, FlowSide upper, FlowSide first, FlowSide second) {
    const bool is_mean = lower == FlowSide::Periodic;
    if (part.is_potential) {
      const bool differs = lower == FlowSide::NoSlip && upper == FlowSide::NoSlip && first != FlowSide::NoSlip &&
                           second != FlowSide::NoSlip;
      if (part.has_other ? differs : is_mean) result.push_back({along, ramp(lower, upper)});
      return;
    }
    const bool is_crossed = is_wall(first) || is_wall(second), is_channel = is_wall(lower) && is_wall(upper);
    const bool has_slip = lower != FlowSide::NoSlip && upper != FlowSide::NoSlip;
    const bool is_gradient = part.has_other && first == FlowSide::Free && has_slip;  // of a linear φ
    if ((is_mean || is_channel) && !is_crossed && !is_gradient) result.push_back({along, ramp(lower, upper)});
  };
  add(Along::X, s.left, s.right, s.bottom, s.top);
  add(Along::Y, s.bottom, s.top, s.left, s.right);
  return result;
}

}  // namespace batten
