// SPDX-License-Identifier: MIT
#pragma once

#include <boost/multiprecision/gmp.hpp>

namespace batten {

/// Exact rational numbers (GMP). Expression templates are off, so that `auto` holds a number.
using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
/// Exact integers (GMP).
using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

}  // namespace batten
