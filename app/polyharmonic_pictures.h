// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/polyharmonic_mask.h>

#include <string>

namespace batten {

/// Writes what --picture and -o ask for: what five rounds make of a single 1, for the exact mask the bell basis itself.
void write_polyharmonic_outputs(const PolyharmonicMask& mask, const SchemeArguments& arguments);

/// Compares the four kinds of finite masks by size, by rounds and by limit [Warren & Weimer 2001, fig. 5.16 and 5.17]:
/// the table as text, and what --picture and -o ask for.
std::string compare_polyharmonic(const SchemeArguments& arguments);

}  // namespace batten
