// SPDX-License-Identifier: MIT
#include <batten/app/expression_entry.h>

namespace batten {

Expression expression_of(const TomlValue& text) {
  try {
    return Expression(text.text);
  } catch (const ExpressionError& error) {
    TomlValue place = text;
    place.column += 1 + static_cast<int>(error.position());  // the quotation mark stands first
    refuse(place, "the expression \"" + text.text + "\" does not parse: " + error.what());
  }
}

}  // namespace batten
