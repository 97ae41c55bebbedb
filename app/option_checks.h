// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace CLI {
class Option;
}

namespace batten {

/// The number that the whole of a text is; none if it is no number or not finite.
std::optional<double> finite_number(const std::string& text);

/// Lets an option take only such numbers, and say which they are; the option itself.
CLI::Option* must_be_finite(CLI::Option* option);
CLI::Option* must_be_positive(CLI::Option* option);
CLI::Option* must_be_fraction(CLI::Option* option);  ///< 0 to 1
CLI::Option* must_be_whole(CLI::Option* option);     ///< 0, 1, 2, ...

}  // namespace batten
