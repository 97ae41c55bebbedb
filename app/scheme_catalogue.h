// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>
#include <batten/bases/scheme.h>

#include <complex>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace batten {

/// A scheme on the line or in the plane.
using AnyScheme = std::variant<Scheme, Scheme2>;

/// The names of the schemes that scheme_of() makes.
std::vector<const char*> scheme_names();

/// "there is no scheme 'b-spline'; did you mean 'bspline'? The schemes are ..."
std::string unknown_scheme_text(const std::string& name, std::span<const char* const> names);

/// The scheme of that name and those options. Throws UsageError for a name that is not known (with the names), an
/// option that the scheme does not have or needs, or one that cannot be read; InvalidInput for values that it refuses.
AnyScheme scheme_of(const SchemeArguments& arguments);

/// Throws UsageError as scheme_of() does, for the name and the options that make the scheme alone.
void check_scheme_options(const SchemeArguments& arguments);
/// Throws UsageError when an option that makes a scheme is missing, or given although it is in neither list.
void check_options(const SchemeArguments& arguments, const std::vector<std::string>& needs,
                   const std::vector<std::string>& may);

/// Integers separated by commas, rows by semicolons: "1,0;0,1" -> {{1, 0}, {0, 1}}. Throws UsageError that names the
/// option and the text.
std::vector<std::vector<int>> parse_integers(const std::string& option, const std::string& text);
/// Complex numbers separated by commas: "0,1,-2i,0.5+3i". Throws as above.
std::vector<std::complex<double>> parse_complex(const std::string& option, const std::string& text);

}  // namespace batten
