// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/solution.h>

#include <array>
#include <vector>

namespace batten {

/// Moments and shear forces of a Kirchhoff plate at a point, per unit of length of the cut: moments in the unit of
/// force, shear forces in force per length, if D is in force times length and w in length.
///
///   Mx = -D (w_xx + ν w_yy),  My = -D (w_yy + ν w_xx),  Mxy = -D (1 - ν) w_xy
///   Qx = ∂Mx/∂x + ∂Mxy/∂y,    Qy = ∂Mxy/∂x + ∂My/∂y
///
/// Mx bends the plate along x (it acts on cuts x = const) and is positive where the side towards positive w is
/// stretched: in the middle of a supported plate under a load in the direction of w. Qx is the force in the direction
/// of w on a cut whose outward normal is +x; ∂Qx/∂x + ∂Qy/∂y = -(q - c w + T Δw) for constant T. The source, with the
/// same signs for a load and deflection downwards: [Timoshenko & Woinowsky-Krieger 1959, secs. 10, 21, 22].
///
/// Everything comes from the derivatives of the spline. Where one of them jumps (the highest, at breakpoints) it is the
/// mean of the limits; those of an order above the degree are 0. Only the slope of a rigidity that is not constant is
/// taken by central differences of D, over 2e-5 of the length of the region, one-sided at its ends.
struct PlateForces {
  double Mx = 0, My = 0, Mxy = 0, Qx = 0, Qy = 0;
};

/// NaN outside the region.
PlateForces plate_forces(const Solution& w, const KirchhoffPlate& plate, double x, double y);

enum class Edge { Left, Right, Bottom, Top };

/// The force per unit of length that a side exerts on the plate in the direction of w, at the coordinate `along` (y of
/// the left and right side, x of the others): V_n = Q_n + ∂M_nt/∂s + T ∂w/∂n with the outward normal n, the
/// direction t counter-clockwise along the boundary and the length s in it. Negative where a support holds a plate that
/// is pressed in the direction of w.
double edge_reaction(const Solution& w, const KirchhoffPlate& plate, Edge edge, double along);

/// The forces of the supports on the corners in the direction of w: 2 Mxy at the upper left and lower right, -2 Mxy
/// at the lower left and upper right, since M_nt jumps there. Order: lower left, lower right, upper left, upper right.
/// Positive for a simply supported plate under a load in the direction of w, whose corners want to rise against it.
/// With these and the edge reactions, ∮ V_n ds + Σ corners + ∫∫ (q - c w) = 0.
std::array<double, 4> corner_forces(const Solution& w, const KirchhoffPlate& plate);

/// At the corners of the cells, as Solution::samples: the arrays Mx, My, Mxy, Qx, Qy, and Vn, which is the edge
/// reaction on the sides and NaN inside and in the four corners of the rectangle.
std::vector<PointArray> force_samples(const Solution& w, const KirchhoffPlate& plate);

}  // namespace batten
