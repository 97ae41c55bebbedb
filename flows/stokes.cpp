// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/flows/divergence_share.h>
#include <batten/flows/running_integral.h>
#include <batten/flows/stokes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

namespace batten {
namespace {

constexpr std::size_t count = 4;

/// One side, in the order that goes round counterclockwise: bottom, right, top, left.
struct Course {
  const StokesSide* side;
  const char* name;
  bool vertical;
  bool ascends;  ///< its coordinate grows on the way round
  Interval along;
  double fixed;         ///< the other coordinate
  double outward_sign;  ///< of the component across the side, for it to point outwards

  const Field& velocity_across() const { return vertical ? side->u : side->v; }
  const Field& velocity_along() const { return vertical ? side->v : side->u; }
  /// Whether there may be a flow through it.
  bool is_open() const { return side->kind == StokesSide::Kind::Velocity && !velocity_across().is_zero(); }
  /// v·n of a place on it; it outlives the side.
  RunningIntegral::Function outward_velocity() const {
    return [across = velocity_across(), sign = outward_sign, at = fixed, upright = vertical](double s) {
      return sign * (upright ? across(at, s) : across(s, at));
    };
  }
};

std::array<Course, count> courses_of(const StokesProblem& p) {
  const auto& [x, y] = p.region;
  return {Course{&p.bottom, "bottom", false, true, x, y.lower(), -1},
          {&p.right, "right", true, true, y, x.upper(), 1},
          {&p.top, "top", false, false, x, y.upper(), 1},
          {&p.left, "left", true, false, y, x.lower(), -1}};
}

/// ψ on the sides. On the way round it grows by what flows out: dψ = ψ_x dx + ψ_y dy = u dy - v dx.
class SideStreams {
public:
  explicit SideStreams(const StokesProblem& problem) : courses_(courses_of(problem)) {
    const auto free = [](const Course& c) { return c.side->kind == StokesSide::Kind::Free; };
    if (std::ranges::count_if(courses_, free) > 1)
      throw InvalidInput(
          "stream_function_problem: expected at most one free side, found several; how much flows out by each of them "
          "is not known");
    const auto found = std::ranges::find_if(courses_, free);
    is_closed_ = found == courses_.end();
    start_ = is_closed_ ? 0 : static_cast<std::size_t>(found - courses_.begin()) + 1;
    for (std::size_t k = 0; k < count; ++k) integrate(k);
    if (is_closed_) expect_balanced();
    set_corners();
  }

  /// ψ on side k, in the order above.
  Field stream(std::size_t k) const;
  double inflow() const { return (size_ - outflow_) / 2; }
  double net_inflow() const { return 0 - outflow_; }
  const Course& course(std::size_t k) const { return courses_[k]; }

private:
  void integrate(std::size_t k) {
    const Course& c = courses_[k];
    if (!c.is_open()) return;
    flow_[k] = std::make_shared<const RunningIntegral>(c.outward_velocity(), c.along);
    if (flow_[k]->size() == 0) flow_[k].reset();
    if (!flow_[k]) return;
    outflow_ += flow_[k]->total();
    size_ += flow_[k]->size();
  }

  void expect_balanced() const {
    if (std::abs(outflow_) <= net_inflow_tolerance * size_ / 2) return;
    throw InvalidInput("stream_function_problem: expected as much to flow out of the sides as flows in, found a net " +
                       std::string(outflow_ < 0 ? "inflow" : "outflow") + " of " + number_text(std::abs(outflow_), 10) +
                       " (in " + number_text((size_ - outflow_) / 2, 10) + ", out " +
                       number_text((size_ + outflow_) / 2, 10) + "); at most " + number_text(net_inflow_tolerance) +
                       " of their mean, " + number_text(net_inflow_tolerance * size_ / 2) + ", is taken for rounding");
  }

  /// The remainder of a closed rectangle goes to the sides with a flow, in proportion to it.
  void set_corners() {
    double psi = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t k = (start_ + n) % count;
      at_start_[k] = psi;
      if (flow_[k]) psi += flow_[k]->total() - (is_closed_ ? outflow_ * flow_[k]->size() / size_ : 0);
      if (is_closed_ && n + 1 == count) psi = 0;
      at_end_[k] = psi;
    }
  }

  std::array<Course, count> courses_;
  bool is_closed_ = true;
  std::size_t start_ = 0;
  std::array<std::shared_ptr<const RunningIntegral>, count> flow_;  // none: no flow
  std::array<double, count> at_start_ = {}, at_end_ = {};           // ψ, on the way round
  double outflow_ = 0, size_ = 0;                                   // ∫ v·n, ∫ |v·n|
};

/// Exactly the values of the corners at the ends, so that neighbours agree.
Field SideStreams::stream(std::size_t k) const {
  const Course& c = courses_[k];
  if (!flow_[k]) return at_start_[k];
  const double lower = c.ascends ? at_start_[k] : at_end_[k], upper = c.ascends ? at_end_[k] : at_start_[k];
  const double sign = c.ascends ? 1 : -1, remainder = upper - lower - sign * flow_[k]->total();
  return Field([=, flow = flow_[k], along = c.along, vertical = c.vertical](double x, double y) {
    const double s = vertical ? y : x;
    if (s <= along.lower()) return lower;
    if (s >= along.upper()) return upper;
    return lower + sign * (*flow)(s) + remainder * (s - along.lower()) / along.length();
  });
}

/// ψ_n = ∓ψ_x = ±v on vertical sides, ±ψ_y = ±u on the others.
Field slope_of(const Course& c) { return c.velocity_along().affine(c.vertical ? -c.outward_sign : c.outward_sign); }

Side plate_side(const SideStreams& streams, std::size_t k) {
  const Course& c = streams.course(k);
  if (c.side->kind == StokesSide::Kind::Free) return Side::free();
  if (c.side->kind == StokesSide::Kind::Symmetry) return Side::fixed(streams.stream(k));
  return Side::clamped(streams.stream(k), slope_of(c));
}

void check(const StokesProblem& p) {
  const std::string name = "stream_function_problem: ";
  if (!(p.viscosity > 0 && std::isfinite(p.viscosity)))
    throw InvalidInput(name + "expected a finite viscosity > 0, found " + number_text(p.viscosity, 6));
  for (const auto& f : p.point_forces) {
    const std::string place = " at (" + number_text(f.x, 6) + ", " + number_text(f.y, 6) + ")";
    if (!p.region.contains(f.x, f.y)) throw InvalidInput(name + "expected forces in the region, found one" + place);
    if (!std::isfinite(f.fx) || !std::isfinite(f.fy))
      throw InvalidInput(name + "expected finite forces, found (" + number_text(f.fx) + ", " + number_text(f.fy) + ")" +
                         place);
  }
}

BoundaryProblem plate_of(const StokesProblem& p, const SideStreams& streams) {
  BoundaryProblem plate{
      .material = KirchhoffPlate{.rigidity = p.viscosity, .poisson_ratio = -1}, .region = p.region, .degree = p.degree};
  plate.sides = {plate_side(streams, 3), plate_side(streams, 1), plate_side(streams, 0), plate_side(streams, 2)};
  // f·rot N = f_x ∂N/∂y - f_y ∂N/∂x
  plate.loads.area_mx = p.force_y.affine(-1);
  plate.loads.area_my = p.force_x;
  for (const auto& f : p.point_forces) plate.loads.couples.push_back({f.x, f.y, -f.fy, f.fx});
  return plate;
}

}  // namespace

BoundaryProblem stream_function_problem(const StokesProblem& problem) {
  check(problem);
  return plate_of(problem, SideStreams(problem));
}

StokesResult solve_stokes(const StokesProblem& problem, const BoundarySolveOptions& options) {
  check(problem);
  const SideStreams streams(problem);
  BoundaryResult plate = solve_boundary_problem(plate_of(problem, streams), options);
  StokesResult result{.field = FlowField(std::move(plate.solution))};
  result.dissipation = plate.energy;
  result.power = plate.compliance;
  result.inflow = streams.inflow();
  result.net_inflow = streams.net_inflow();
  result.largest_divergence = divergence_share(result.field);
  result.unknowns = plate.unknowns;
  result.levels = plate.levels;
  result.iterations = plate.iterations;
  result.accuracy = plate.accuracy;
  result.notes = std::move(plate.notes);
  result.seconds = std::move(plate.seconds);
  return result;
}

}  // namespace batten
