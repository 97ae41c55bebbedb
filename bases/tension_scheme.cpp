// SPDX-License-Identifier: MIT
#include <batten/bases/tension_scheme.h>
#include <batten/domains/errors.h>

#include <cmath>

namespace batten {
namespace {

Mask<double> mask_of(double sigma) {
  const double all = 4 + 4 * sigma;
  return {-2, {1 / all, 0.5, (2 + 4 * sigma) / all, 0.5, 1 / all}};
}

/// {0, 0, g, -g} with cosh g = σ_0.
std::vector<std::complex<double>> roots_of(double sigma_0) {
  const std::complex<double> g =
      sigma_0 >= 1 ? std::complex<double>(std::acosh(sigma_0)) : std::complex<double>(0, std::acos(sigma_0));
  return {0., 0., g, -g};
}

}  // namespace

double tension_parameter(double sigma_0, int level) {
  if (!(sigma_0 > -1) || !std::isfinite(sigma_0))
    throw InvalidInput("tension_scheme: sigma must be finite and greater than -1, found " + std::to_string(sigma_0));
  if (level < 0)
    throw InvalidInput("tension_parameter: the level must not be negative, found " + std::to_string(level));
  double sigma = sigma_0;
  for (int k = 0; k < level && sigma != 1; ++k) sigma = std::sqrt((1 + sigma) / 2);
  return sigma;
}

Scheme tension_scheme(double sigma_0) {
  tension_parameter(sigma_0, 0);  // throws when it is out of range
  return {"tension sigma = " + std::to_string(sigma_0),
          [sigma_0](int level) { return mask_of(tension_parameter(sigma_0, level)); },
          2,
          {.roots = roots_of(sigma_0)}};
}

}  // namespace batten
