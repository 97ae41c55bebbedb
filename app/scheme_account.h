// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>
#include <batten/app/scheme_catalogue.h>

#include <string>

namespace batten {

/// What `batten scheme` tells of a scheme: JSON with the keys of its help; rationals are strings "p/q".
///
/// Without a question in the arguments everything is told but what takes long: smoothness in the plane. Throws
/// UsageError for questions that cannot be read, InvalidInput for what the scheme does not have, such as a derivative.
std::string scheme_account(const AnyScheme& scheme, const SchemeArguments& arguments);

/// That JSON as a table for a reader. `mask` is the mask as a polynomial; without it the mask is a table like others.
std::string scheme_table(const std::string& account, const std::string& mask);

/// The mask of the step that the account tells of, as a polynomial.
std::string mask_text(const AnyScheme& scheme, const SchemeArguments& arguments);

}  // namespace batten
