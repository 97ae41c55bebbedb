// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/expression.h>
#include <batten/app/toml_tree.h>

namespace batten {

/// The expression that a text of a file holds. Throws InvalidInput with the line and column of what is wrong.
Expression expression_of(const TomlValue& text);

}  // namespace batten
