// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/torus_quotient.h>

#include <array>
#include <vector>

namespace batten {

/// The angles (α, β) in [0, 2π)² at which the denominator is zero at (e^(iα), e^(iβ)): local minima of |b| on a grid of
/// n² points, each followed down to |b| <= 1e-12 Σ|b[i]|. Those at multiples of π/12 are exact to rounding.
///
/// Throws InvalidInput when there are more than 64, as for masks that vanish along a curve.
std::vector<std::array<double, 2>> denominator_zeros(const TorusQuotient& quotient, int n = 128);

/// Throws InvalidInput that names the place unless the quotient stays bounded near these zeros of b: its largest values
/// on circles around them must not grow as the circles shrink from 2^-6 to 2^-16.
void require_bounded(const TorusQuotient& quotient, const std::vector<std::array<double, 2>>& zeros);

}  // namespace batten
