// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>

#include <array>
#include <string>
#include <vector>

namespace batten {

/// The values of a grid as a picture needs them: few enough, and scaled so that the lowest is 0 and the highest 1.
struct PictureField {
  std::vector<double> x, y;   ///< coordinates of the columns and rows kept; the outer ones are kept
  std::vector<float> levels;  ///< (value - low) / (high - low), NaN where blank, x fastest
  double low = 0, high = 0;   ///< the finite extremes of the whole grid; levels are 0.5 if they are equal
};

/// Keeps at most `most` columns and rows. Throws InvalidInput if there is no such array of one component, it has no
/// finite value, or the grid has fewer than two points along a side or no positive spacing.
PictureField picture_field(const GridSamples& grid, const std::string& array, int most);

/// How data coordinates become those of the scene: factor * (coordinate - origin), and height * level.
struct SceneScale {
  std::array<double, 2> origin = {0, 0};
  std::array<double, 2> factor = {1, 1};
  double height = 0;

  double x(double coordinate) const { return factor[0] * (coordinate - origin[0]); }
  double y(double coordinate) const { return factor[1] * (coordinate - origin[1]); }
};

/// Triangles between the points of a field that are not blank.
struct SceneMesh {
  std::vector<float> points;   ///< three coordinates each, of all points of the field (blank ones at height 0)
  std::vector<float> normals;  ///< of length 1, upwards
  std::vector<float> levels;   ///< 0 where blank
  std::vector<int> triangles;  ///< three point indices each, counter-clockwise seen from above
};

SceneMesh scene_mesh(const PictureField& field, const SceneScale& scale);

}  // namespace batten
