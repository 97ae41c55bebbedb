// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/picture_views.h>

namespace batten {

/// Draws the curves of the options on a map, white with dark edges, so that they are seen on every colour. What lies
/// outside of the field is left out.
void draw_curves(const ViewInput& view, const SceneScale& scale);

}  // namespace batten
