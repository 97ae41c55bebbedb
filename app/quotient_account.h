// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>

#include <string>

namespace batten {

/// What `batten scheme quotient` tells: the coefficients of the Laurent series of two masks' quotient, both centred on
/// 0, |i|, |j| <= (size - 1) / 2. Throws UsageError when a mask is of another dimension than the other, InvalidInput as
/// quotient_coefficients does.
std::string quotient_account(const SchemeArguments& arguments);

}  // namespace batten
