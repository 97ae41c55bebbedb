// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit.h>
#include <batten/flows/flow_field.h>
#include <batten/flows/flow_sides.h>

namespace batten {

/// Scattered velocities: (u[i], v[i]) at (x[i], y[i]) with weight[i] > 0, or weight 1 for all if `weight` is empty.
struct VectorObservations {
  std::vector<double> x, y, u, v, weight;
  std::size_t size() const { return x.size(); }
};

/// What a fitted field is made of, and its energy E. In brackets the fields without energy.
enum class FlowModel {
  Smooth,        ///< v = rot ψ, ψ_xxx² + 3 ψ_xxy² + 3 ψ_xyy² + ψ_yyy² [linear fields without divergence]
  Slow,          ///< v = rot ψ, ψ_xx² + 2 ψ_xy² + ψ_yy² [constant fields]: point velocities are not bounded by E
  Irrotational,  ///< v = grad φ, third derivatives of φ as of ψ in Smooth [linear fields without rotation]
  General,       ///< v = rot ψ + grad φ, third derivatives of ψ and `ratio` times those of φ [linear fields]
};

/// What a tolerance bounds: u and v each, or the length of the difference.
enum class ToleranceNorm { Component, Euclidean };

struct FlowOptions {
  FlowModel model = FlowModel::Smooth;
  double ratio = 1;  ///< of General, > 0: a large one gives ψ all that it can
  int degree = 3;    ///< of the B-splines, 3 to 5
  /// x is the longitude and y the latitude in degrees, u the velocity to the east and v to the north, on a sphere with
  /// the mean radius of the Earth in km.
  bool geographic = false;
  FlowSides sides;      ///< walls without slip not of Irrotational, and of General with a free side only
  Smoothing smoothing;  ///< λ = 0 means Smoothing::none()
  ToleranceNorm tolerance_norm = ToleranceNorm::Component;
  /// As FitOptions::name_of.
  std::function<std::string(std::size_t i)> name_of;
  IterationLimits limits;
  std::uint64_t seed = 1;  ///< of the random probes of cross-validation
  /// Called now and then with the phase ("cross-validation", "solve", ...) and the part of it that is done, 0 to 1.
  std::function<void(std::string_view phase, double done)> progress;
};

struct FlowResult {
  FlowField field;
  double lambda = 0;                        ///< of the normalised problem: see fit_flow
  double energy = 0;                        ///< E in normalised coordinates, in the square of the unit of velocity ...
  double potential_energy = 0;              ///< ... and what of it is that of φ, times the ratio
  double rms_residual = 0;                  ///< weighted root mean square of |v(x_i) - v_i|
  double largest_residual = 0;              ///< largest |v(x_i) - v_i| ...
  std::size_t worst_point = 0;              ///< ... and the observation where it is found
  std::size_t points_used = 0;              ///< observations inside the region
  std::size_t points_outside = 0;           ///< observations outside the region, left out
  std::size_t points_merged = 0;            ///< observations averaged into coincident ones (Smoothing::none only)
  std::optional<double> effective_degrees;  ///< trace of the influence matrix, of 2 rows for each point
  bool no_interior_minimum = false;         ///< as in FitResult
  bool tolerance_reached = true;            ///< false if Smoothing::within could not be met on this grid
  std::optional<ConstraintAccount> constraints;  ///< of tolerances
  int iterations = 0, search_iterations = 0;     ///< V-cycles of the final solves, of cross-validation
  double accuracy = 0;                           ///< estimated relative error in the energy norm
  std::optional<double> flux;              ///< from left to right, or upwards, between two walls that are opposite
  std::optional<double> mean_u, mean_v;    ///< along directions in which the flow is periodic; see fit_flow
  std::vector<double> fitted_u, fitted_v;  ///< at all observations; NaN outside the region
  /// Largest |u_x + v_y| over largest |∇v|, both by central differences of evaluated velocities over a thousandth of a
  /// cell, at random points.
  double largest_divergence = 0;
  std::vector<std::string> notes;  ///< what the user should know, one line each
  std::vector<PhaseTime> seconds;
};

/// The field v on the rectangle that minimises
///
///   Σ_i w_i |v(x_i) - v_i|² / (2 Σ_i w_i)  +  λ E
///
/// with E measured in coordinates in which the longer side of the region has length 1 and ψ and φ divided by that
/// length, so that velocities keep their unit; x and y have one unit. On a sphere these coordinates are longitude and
/// latitude, one unit of latitude counted as 1 / cos of the mid latitude, E is that of the plane in them, and v is as
/// in FlowField; mean flows are those at the mid latitude. Through walls nothing flows at any point: ψ is
/// constant on each connected wall, and the differences of these constants, the fluxes, are found by the fit, as are
/// the mean flows along periodic directions. ψ and φ have zero mean. A field that is both a rotation and a gradient can
/// be given to ψ or φ: General splits it by the least energy, and gives ψ what costs nothing, so that φ is orthogonal
/// to the gradients of x, y, x² - y² and x y that keep the sides; on a sphere none of these is both. At walls of
/// General φ_n = 0; without slip φ is constant along each wall, which needs a free side (docs/flows.md). Its flux and
/// mean flows are means over the region. Observations outside the region are left out. Throws InvalidInput for data
/// that do not determine the field (three points not on a line, for Slow one point), and, as fit_surface does, for
/// numbers that are not finite, weights that are negative or all zero, ratios that are not positive, degrees other than
/// 3 to 5, sides that contradict each other or the model, regions that are not between the poles; SolverError if the
/// iteration fails.
FlowResult fit_flow(const VectorObservations& observations, const Rectangle& region, const FlowOptions& options = {});

}  // namespace batten
