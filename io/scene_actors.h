// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/picture_field.h>

#include <array>
#include <span>
#include <vector>

class vtkRenderer;

namespace batten {

using ScenePoint = std::array<double, 3>;
using SceneLine = std::array<ScenePoint, 2>;

struct LineStyle {
  double width = 1;  ///< pixels
  double grey = 0;   ///< 0 is black, 1 white
  double opacity = 1;
  double lift = 0;  ///< how far above its place a line is drawn
};

enum class Shading { Flat, Lit };

/// Adds the mesh, which must live until the window has been drawn, coloured by its levels; Lit is shaded by the
/// renderer's lights.
void add_mesh(vtkRenderer* renderer, SceneMesh& mesh, Shading shading);

/// Adds the lines on the mesh along which the level is one of `levels`.
void add_contours(vtkRenderer* renderer, SceneMesh& mesh, std::span<const double> levels, const LineStyle& style);

void add_lines(vtkRenderer* renderer, std::span<const SceneLine> lines, const LineStyle& style);

/// Adds round dots of a diameter in pixels.
void add_dots(vtkRenderer* renderer, std::span<const ScenePoint> places, double diameter, double grey);

}  // namespace batten
