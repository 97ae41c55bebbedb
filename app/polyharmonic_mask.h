// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>
#include <batten/bases/mask_family.h>
#include <batten/bases/scheme.h>

#include <array>
#include <optional>
#include <string>

namespace batten {

/// A finite mask in place of the polyharmonic one, as the command line asks for it.
struct PolyharmonicMask {
  int order;
  int size;
  std::string method;  ///< one of polyharmonic_methods
  Mask2<Rational> mask;
  bool is_rational;  ///< the coefficients are fractions by derivation; else they are doubles
};

/// exact and laurent: the coefficients of the quotient itself; jacobi, lp, lsq: approximations.
inline constexpr std::array polyharmonic_methods = {"exact", "laurent", "jacobi", "lp", "lsq"};

/// Throws UsageError for options that cannot be read or that the method does not have, InvalidInput as the functions of
/// polyharmonic_scheme.h and optimal_mask.h do.
PolyharmonicMask polyharmonic_mask_of(const SchemeArguments& arguments);
MaskConstraints constraints_of(const SchemeArguments& arguments);

/// For subdivision: constant precision unless another is asked for. Throws InvalidInput that names the coset when the
/// sum of one differs from 1 by more than 1e-12.
Scheme2 polyharmonic_scheme_of(const SchemeArguments& arguments);

}  // namespace batten
