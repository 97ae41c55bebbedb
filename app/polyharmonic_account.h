// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/polyharmonic_mask.h>

#include <string>

namespace batten {

/// How an account writes fractions.
enum class Fractions {
  Exact,  ///< "p/q", whatever their length
  Short   ///< long ones rounded, for a reader
};

/// What `batten scheme polyharmonic` tells: JSON with the keys of its help. Throws InvalidInput for --smoothness of a
/// mask that does not keep constants.
std::string polyharmonic_account(const PolyharmonicMask& mask, const SchemeArguments& arguments, Fractions fractions);

}  // namespace batten
