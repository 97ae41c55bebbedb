// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/spline_basis.h>

#include <span>

namespace batten {

/// The blossoms of the functions that live in the cell of t, at as many positions as the degree says. Blossoms are
/// those of the polynomials that the functions are there [Ramshaw 1989].
SplineBasis::Local blossom(const SplineBasis& basis, double t, std::span<const double> positions);

/// What a refined basis of the same degree has as coefficient of a function of this one: its blossom at consecutive
/// knots, `spacing` apart (in cells, as t; end knots repeat), whose mean is `greville`.
SplineBasis::Local refined_coefficient(const SplineBasis& basis, double greville, double spacing);

/// The Greville abscissae of the functions of that refined basis, increasing, in cells.
std::vector<double> refined_greville(const SplineBasis& basis, double spacing);

}  // namespace batten
