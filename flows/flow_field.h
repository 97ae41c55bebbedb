// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>
#include <batten/fem/solution.h>

#include <optional>

namespace batten {

/// A vector field on a rectangle, v = rot ψ + grad φ = (ψ_y + φ_x, -ψ_x + φ_y), its stream function ψ and its potential
/// φ tensor-product splines; one of them may be missing. v and its derivatives are those of the splines, evaluated
/// anywhere; without φ the field has no divergence, and the flux through a curve is the difference of ψ at its ends.
/// Lengths are in the unit of the region, v in any; (x, y) outside of the region gives NaN.
class FlowField {
public:
  /// Throws InvalidInput if both are missing, their regions or degrees differ, or the degree is below 2.
  explicit FlowField(std::optional<Solution> stream, std::optional<Solution> potential = {});

  const Rectangle& region() const { return any().region(); }
  int degree() const { return any().degree(); }
  const std::optional<Solution>& stream() const { return stream_; }
  const std::optional<Solution>& potential() const { return potential_; }

  struct Velocity {
    double u = 0, v = 0;
  };
  /// First derivatives, in the unit of v over that of length.
  struct Gradient {
    double u_x = 0, u_y = 0, v_x = 0, v_y = 0;
  };
  Velocity velocity(double x, double y) const;
  Gradient gradient(double x, double y) const;
  /// sqrt(u² + v²)
  double speed(double x, double y) const;
  /// u_x + v_y = φ_xx + φ_yy: 0 where there is no φ.
  double divergence(double x, double y) const;
  /// v_x - u_y = -(ψ_xx + ψ_yy): 0 where there is no ψ.
  double vorticity(double x, double y) const;
  /// ψ, in the unit of v times that of length; 0 where there is none.
  double stream_function(double x, double y) const;

  /// At the corners of the cells: "velocity" (3 components, the third 0), "divergence", "vorticity", "speed", and
  /// "stream_function" and "potential" of those that are not missing.
  GridSamples samples() const;

  /// kind "flow", arrays "stream_coefficients" and "potential_coefficients" of those that are not missing; add numbers
  /// and texts as you like.
  Record to_record() const;
  /// Throws InvalidInput if the record is of another kind or has none of the two arrays.
  static FlowField from_record(const Record& record);

private:
  const Solution& any() const { return stream_ ? *stream_ : *potential_; }

  std::optional<Solution> stream_, potential_;
  SplineBasis x_, y_;
};

/// ∫∫ a · b over the region, by exact one-dimensional inner products. Throws InvalidInput unless both are on the same
/// cells and of the same degree.
double inner_product(const FlowField& a, const FlowField& b);

/// The mean of a spline over its region, exact.
double mean_value(const Solution& p);

}  // namespace batten
