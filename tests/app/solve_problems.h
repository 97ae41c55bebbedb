// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace batten::test {

// Parts of problem files.
inline const std::string all_fixed =
    "[sides]\nleft = {value = 0}\nright = {value = 0}\nbottom = {value = 0}\ntop = {value = 0}\n";
inline const std::string square = "x = [0, 1]\ny = [0, 1]\ncells = [16, 16]\n";

}  // namespace batten::test
