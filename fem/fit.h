// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/constraint_account.h>
#include <batten/fem/energy.h>
#include <batten/fem/hierarchy.h>
#include <batten/fem/phase_time.h>
#include <batten/fem/solution.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// Scattered measurements: value[i] at (x[i], y[i]) with weight[i] > 0, or weight 1 for all if `weight` is empty.
struct Observations {
  std::vector<double> x, y, value, weight;
  std::vector<double> tolerance;  ///< of each point, in units of that of Smoothing::within; empty: all 1
  std::size_t size() const { return x.size(); }
};

/// How closely the surface follows the data.
struct Smoothing {
  enum class Kind {
    Automatic,  ///< λ by generalised cross-validation
    Fixed,      ///< λ given
    None,       ///< as close to interpolation as the grid allows
    Tolerance,  ///< least energy with |p(x_i) - z_i| <= tolerance
  };
  Kind kind = Kind::Automatic;
  double value = 0;  ///< λ, or the tolerance in the unit of the data

  static Smoothing automatic() { return {}; }
  static Smoothing fixed(double lambda) { return {Kind::Fixed, lambda}; }
  static Smoothing none() { return {Kind::None, 0}; }
  /// Each point within this times its own tolerance.
  static Smoothing within(double tolerance) { return {Kind::Tolerance, tolerance}; }
};

struct FitOptions {
  Energy energy = Energy::thin_plate();
  int degree = 3;       ///< of the B-splines, 2 or 3
  Smoothing smoothing;  ///< λ = 0 means Smoothing::none()
  double aspect = 1;    ///< one unit of y counts as this many units of x in the energy
  /// The surface stays within these everywhere. λ is found without them.
  std::optional<double> minimum, maximum;
  bool standard_error = false;
  IterationLimits limits;
  std::uint64_t seed = 1;  ///< of the random probes of cross-validation and standard error
  /// What messages call observation i; where there is none, "observation i + 1".
  std::function<std::string(std::size_t i)> name_of;
  /// Called now and then with the phase ("cross-validation", "solve", ...) and the part of it that is done, 0 to 1.
  std::function<void(std::string_view phase, double done)> progress;
};

struct FitResult {
  Solution solution;
  double lambda = 0;                        ///< of the normalised problem: see fit_surface
  double energy = 0;                        ///< E(p) in normalised coordinates, in the square of the data's unit
  double rms_residual = 0;                  ///< weighted root mean square of p(x_i) - z_i
  double largest_residual = 0;              ///< largest |p(x_i) - z_i| ...
  std::size_t worst_point = 0;              ///< ... and the observation where it is found
  std::size_t points_used = 0;              ///< observations inside the region
  std::size_t points_outside = 0;           ///< observations outside the region, left out
  std::size_t points_merged = 0;            ///< observations averaged into coincident ones (Smoothing::none only)
  std::optional<double> effective_degrees;  ///< trace of the influence matrix, where it was computed
  bool no_interior_minimum = false;  ///< cross-validation fell to the lower end of its range: the data look exact
  bool tolerance_reached = true;     ///< false if Smoothing::within could not be met on this grid
  std::optional<ConstraintAccount> constraints;  ///< of tolerances, minimum and maximum, where there are any
  int iterations = 0;                            ///< V-cycles of the final solves
  int search_iterations = 0;           ///< V-cycles of cross-validation, in units of the finest grid's work, rounded up
  int refinement_iterations = 0;       ///< those of them that refined λ on the finest grid
  double accuracy = 0;                 ///< estimated relative error in the energy norm
  std::vector<double> fitted;          ///< p at all observations; NaN outside the region
  std::vector<double> standard_error;  ///< at the corners of the cells, x fastest, if it was asked for
  std::vector<std::string> notes;      ///< what the user should know, one line each
  std::vector<PhaseTime> seconds;
};

/// The spline p on the rectangle that minimises
///
///   Σ_i w_i (p(x_i) - z_i)² / Σ_i w_i  +  λ E(p)
///
/// with the energy E measured in coordinates in which the longer side of the region (y times aspect) has length 1; the
/// sides are natural (free). Observations outside the region are left out. Throws InvalidInput for data that do not
/// determine the surface (three points not on a line for the thin plate, one point otherwise), for energies of third
/// derivatives alone, degrees other than 2 and 3, weights that are
/// negative, not finite or all zero, values that are not finite, and what check_contradictions
/// finds; SolverError if the iteration fails.
///
/// With tolerances or bounds the surface is the one of least energy (or of the least sum above) that keeps them, to the
/// gap that ConstraintAccount states. Bounds hold everywhere: fit_between says how, and what that costs.
FitResult fit_surface(const Observations& observations, const Rectangle& region, const FitOptions& options = {});

}  // namespace batten
