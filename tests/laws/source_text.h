// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// C++ text of which the laws read only the code. Both texts are as long as the original and have the same lines:
/// what is left out has been replaced by blanks.
struct SourceText {
  std::string without_comments;
  std::string code;  ///< without comments, literals and preprocessor lines
};

SourceText read_source(std::string_view text);

/// An `#include` and the line that it stands on, counted from 1. `name` keeps its delimiters: `<vector>`, `"a.h"`;
/// it is what follows the word include where that is a macro.
struct Include {
  std::string name;
  int line;
};

std::vector<Include> includes_of(const SourceText& source);

/// A function body at namespace or class level, lambdas and test bodies among them. `lines` counts from the first
/// line of its declaration to the closing brace, both included.
struct FunctionExtent {
  int line;
  int lines;
};

/// All functions of the text in order. What stands inside a function (lambdas, local classes) counts as part of it.
std::vector<FunctionExtent> functions_of(const SourceText& source);

int line_count(std::string_view text);

}  // namespace batten
