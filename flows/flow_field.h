// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>
#include <batten/fem/solution.h>
#include <batten/flows/flow_geometry.h>

#include <optional>

namespace batten {

/// A vector field on a rectangle, v = rot ψ + grad φ = (ψ_y + φ_x, -ψ_x + φ_y), its stream function ψ and its potential
/// φ tensor-product splines; one of them may be missing. v and its derivatives are those of the splines, evaluated
/// anywhere; without φ the field has no divergence, and the flux through a curve is the difference of ψ at its ends.
/// Lengths are in the unit of the region, v in any; (x, y) outside of the region gives NaN.
///
/// On a sphere of radius R, x the longitude and y the latitude, u is the velocity to the east and v to the north:
/// u = -ψ_y / R + φ_x / (R cos y), v = ψ_x / (R cos y) + φ_y / R with derivatives by angles in radians. Lengths are in
/// the unit of R. The sign of ψ is that of meteorology; the spline that is kept is -ψ, as in the plane.
class FlowField {
public:
  /// Throws InvalidInput if both are missing, their regions or degrees differ, the degree is below 2, or the region
  /// does not fit onto the sphere.
  explicit FlowField(std::optional<Solution> stream, std::optional<Solution> potential = {},
                     const FlowGeometry& geometry = {});

  const Rectangle& region() const { return any().region(); }
  int degree() const { return any().degree(); }
  const FlowGeometry& geometry() const { return geometry_; }
  /// The spline of ψ, on a sphere of -ψ.
  const std::optional<Solution>& stream() const { return stream_; }
  const std::optional<Solution>& potential() const { return potential_; }

  struct Velocity {
    double u = 0, v = 0;
  };
  /// First derivatives by length (on a sphere to the east and to the north), in the unit of v over that of length.
  struct Gradient {
    double u_x = 0, u_y = 0, v_x = 0, v_y = 0;
  };
  Velocity velocity(double x, double y) const;
  Gradient gradient(double x, double y) const;
  /// sqrt(u² + v²)
  double speed(double x, double y) const;
  /// u_x + v_y = φ_xx + φ_yy, on a sphere u_x + v_y - v tan(y) / R: 0 where there is no φ.
  double divergence(double x, double y) const;
  /// v_x - u_y = -(ψ_xx + ψ_yy), on a sphere v_x - u_y + u tan(y) / R: 0 where there is no ψ.
  double vorticity(double x, double y) const;
  /// ψ, in the unit of v times that of length; 0 where there is none.
  double stream_function(double x, double y) const;

  /// At the corners of the cells: "velocity" (3 components, the third 0), "divergence", "vorticity", "speed", and
  /// "stream_function" and "potential" of those that are not missing.
  GridSamples samples() const;

  /// kind "flow", arrays "stream_coefficients" and "potential_coefficients" of those that are not missing, on a sphere
  /// the number "sphere_radius"; add numbers and texts as you like.
  Record to_record() const;
  /// Throws InvalidInput if the record is of another kind or has none of the two arrays.
  static FlowField from_record(const Record& record);

private:
  const Solution& any() const { return stream_ ? *stream_ : *potential_; }
  double sign_of_stream() const { return geometry_.is_sphere() ? -1 : 1; }
  double laplacian(const std::optional<Solution>& p, double x, double y) const;

  std::optional<Solution> stream_, potential_;
  FlowGeometry geometry_;
  SplineBasis x_, y_;
};

/// ∫∫ a · b over the region, by exact one-dimensional inner products. Throws InvalidInput unless both are in a plane,
/// on the same cells and of the same degree.
double inner_product(const FlowField& a, const FlowField& b);

/// The mean of a spline over its region, exact.
double mean_value(const Solution& p);

}  // namespace batten
