// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_solver.h>
#include <batten/flows/flow_field.h>

#include <utility>
#include <vector>

namespace batten {

/// What a slow flow does on one side of the rectangle.
struct StokesSide {
  enum class Kind {
    Velocity,  ///< (u, v) is prescribed: a wall at rest or moving, an inflow, an outflow
    Symmetry,  ///< no flow through the side and no shear stress along it
    Free,      ///< no stress: an outflow into the open, at pressure 0
  };
  Kind kind = Kind::Velocity;
  Field u, v;  ///< of Velocity

  static StokesSide wall() { return {}; }
  static StokesSide moving(Field u, Field v) { return {Kind::Velocity, std::move(u), std::move(v)}; }
  static StokesSide symmetry() { return {Kind::Symmetry, {}, {}}; }
  static StokesSide free() { return {Kind::Free, {}, {}}; }
};

/// Slow flow of an incompressible fluid: -2 μ div D(v) + grad p = f, div v = 0, with D(v) the symmetric part of ∇v.
///
/// v = rot ψ = (ψ_y, -ψ_x) with ψ a tensor-product spline minimises
///
///   ∫∫ μ |D(v)|² - f·v,   2 |D(v)|² = ψ_xx² - 2 ψ_xx ψ_yy + ψ_yy² + 4 ψ_xy²,
///
/// the energy of a plate of rigidity μ and Poisson's ratio -1, under couples (-f_y, f_x).
/// Where velocities are prescribed on all sides it has the same minimum as ∫∫ μ |∇v|² / 2 - f·v; what D(v) buys is
/// that sides where nothing is prescribed are free of stress. The pressure never appears.
struct StokesProblem {
  /// A force at a point. Its flow (the Stokeslet) has a velocity that grows without bound, as log 1/r, towards the
  /// point; that of the spline grows as log 1/h.
  struct PointForce {
    double x = 0, y = 0, fx = 0, fy = 0;
  };
  double viscosity = 1;  ///< μ > 0
  Rectangle region;
  int degree = 3;  ///< of ψ, 2 to 5
  StokesSide left, right, bottom, top;
  Field force_x, force_y;  ///< f, per area
  std::vector<PointForce> point_forces;
};

struct StokesResult {
  FlowField field;         ///< ψ = 0 in the lower left corner, or where the free side ends in counterclockwise order
  double dissipation = 0;  ///< 2 μ ∫∫ |D(v)|²
  double power = 0;        ///< of the forces: ∫∫ f·v + Σ f·v
  double inflow = 0;       ///< through sides with velocities, per time: ∫ max(-v·n, 0)
  double net_inflow = 0;   ///< what flows in there less what flows out: rounding, or what leaves by the free side
  double largest_divergence = 0;  ///< of evaluated velocities, as in FlowResult
  std::size_t unknowns = 0;
  int levels = 0, iterations = 0;  ///< of the multigrid; V-cycles
  double accuracy = 0;             ///< reached: estimated relative error in the energy norm
  std::vector<std::string> notes;  ///< what the user should know, one line each
  std::vector<PhaseTime> seconds;
};

/// The least part of the inflow that counts as a net inflow.
inline constexpr double net_inflow_tolerance = 1e-9;

/// The plate that ψ is. Values on the sides are flows through them, integrated from a corner on to rounding, slopes are
/// the velocities along them. A net inflow below the tolerance is spread over the sides. Throws InvalidInput for a
/// viscosity that is not positive, point forces outside the region, a net inflow into a closed rectangle, more than one
/// free side (how much flows out by each is not known), data that are not finite.
BoundaryProblem stream_function_problem(const StokesProblem& problem);

/// Solves it. Throws as above, and SolverError if the iteration fails.
StokesResult solve_stokes(const StokesProblem& problem, const BoundarySolveOptions& options = {});

}  // namespace batten
