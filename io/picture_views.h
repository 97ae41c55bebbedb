// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/picture.h>
#include <batten/io/picture_field.h>
#include <batten/io/plot_axes.h>
#include <batten/io/scene_actors.h>

#include <span>
#include <vector>

namespace batten {

/// What a view is made of, and where it may draw. Everything but `mesh` is set by the caller.
struct ViewInput {
  vtkRenderer* renderer = nullptr;
  PlotOverlay* overlay = nullptr;
  const PictureField* field = nullptr;
  std::span<const ScenePoint> points;  ///< in the data's units, within the field's rectangle
  std::span<const Tick> value_ticks;   ///< round values
  const PictureOptions* options = nullptr;
  PlotArea area;
  SceneMesh mesh;  ///< filled by the view; must live until the window has been drawn
};

/// Colours and contour lines seen from above; the rectangle that the field fills.
PlotArea draw_map(ViewInput& view);

/// The shaded surface in a box with labelled edges; the rectangle that the box fills.
PlotArea draw_surface(ViewInput& view);

/// The diameter in pixels of dots for `count` data points in a plot of `area` square pixels.
double dot_diameter(std::size_t count, double area);

}  // namespace batten
