// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// Step i = 0, 1, ... of the Chebyshev polynomial of the fourth kind on (0, 1], z <- keep z + gain M^-1 r: it needs an
/// upper bound of the spectrum only [Lottes 2022].
struct ChebyshevStep {
  double keep = 0, gain = 0;
};
constexpr ChebyshevStep chebyshev_step(int i) {
  if (i == 0) return {0., 4. / 3};
  return {(2. * i - 1) / (2. * i + 3), (8. * i + 4) / (2. * i + 3)};
}

}  // namespace batten
