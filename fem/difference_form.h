// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/energy.h>
#include <batten/fem/operator.h>

#include <span>
#include <vector>

namespace batten {

/// The splines that hold the derivatives of the given order, `order` degrees lower: periodic, or without conditions at
/// their ends.
SplineBasis lowered(const SplineBasis& basis, int order);
/// The derivative of the spline with coefficients c has the coefficients slope[i] (c_{i+1} - c_i) in `lowered`, per
/// cell of the finest level. Of a basis without conditions.
std::vector<double> derivative_slopes(const SplineBasis& basis);

/// ∂_x^a ∂_y^b of a spline without conditions at its ends, as coefficients in clamped B-splines of lower degree, in
/// cells of the finest level: (nx - a) x (ny - b) numbers. Neighbouring coefficients are subtracted before anything is
/// multiplied, which loses nothing where they are close.
std::vector<double> differentiated(const SplineSpace& space, std::span<const double> coefficients, int a, int b);

/// E c by differences first, E c = Σ weight D^T M D c with D the derivative and M the inner products of the splines of
/// lower degree. Where c is smooth its relative error is about ε / h^2 for a plate; that of the sums of products that
/// Operator makes is ε / h^4. For spaces without conditions at their ends; Gaussian curvature is added as by Operator.
/// `memory` is used for the result.
std::vector<double> apply_by_differences(const Energy& energy, const SplineSpace& space,
                                         std::span<const double> coefficients, std::vector<double> memory = {});

/// The energy of the spline with the given coefficients, by differences first: derivatives as splines of lower degree,
/// then their positive mass matrices. Keeps its relative accuracy where c · (E c) loses it to cancellation.
double evaluate_energy(const Energy& energy, const SplineSpace& space, std::span<const double> coefficients);

}  // namespace batten
