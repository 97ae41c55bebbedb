// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

namespace batten {

/// σ_k, by σ_k = sqrt((1 + σ_{k-1}) / 2): cosh(g / 2^k) for σ_0 = cosh g, cos(g / 2^k) for σ_0 = cos g. Throws
/// InvalidInput unless σ_0 > -1 and finite and k >= 0.
double tension_parameter(double sigma_0, int level);

/// The unified scheme of order 4, centred at 0, C^2: the step to level k uses the mask (1, 2 + 2σ, 2 + 4σ, 2 + 2σ, 1) /
/// (4 + 4σ) with σ = σ_k, updated first [Warren & Weimer 2001, sec. 4.4]. σ_0 = 1 is the cubic B-spline; σ_0 = cosh g >
/// 1 gives segments with p'''' = g² p'', in tension; σ_0 = cos g < 1 those with p'''' = -g² p''. A regular n-gon
/// subdivides to an exact circle for σ_0 = cos(2 π / n). Throws InvalidInput unless σ_0 > -1 and finite.
Scheme tension_scheme(double sigma_0);

}  // namespace batten
