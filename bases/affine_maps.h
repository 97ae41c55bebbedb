// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace batten {

/// The barycentric coordinates (a_0, a_1, a_2) of v in a triangle, Σ a_i = 1, Σ a_i p_i = v; rows of the 3 x 2 matrix
/// are the vertices [Warren & Weimer 2001, eq. 1.4]. Throws InvalidInput when the triangle has no area.
Eigen::RowVector3d barycentric_coordinates(const Eigen::RowVector2d& v, const Eigen::Matrix<double, 3, 2>& triangle);

/// The matrix S with q = S p for the affine map of the plane that takes the vertices of p to those of q, relative to p:
/// its rows are barycentric coordinates and sum to 1 [Warren & Weimer 2001, sec. 1.2.1].
Eigen::Matrix3d affine_map(const Eigen::Matrix<double, 3, 2>& p, const Eigen::Matrix<double, 3, 2>& q);

/// The set S of `rounds` rounds applied to a set of polygons, p_k = S p_{k-1}: each polygon, vertices in its rows, is
/// replaced by its images under all maps, in the order of the maps [Warren & Weimer 2001, sec. 1.2.1]. The result has
/// |S|^rounds |p| polygons. Throws InvalidInput when shapes do not fit, or more than 2^24 polygons would result.
std::vector<Eigen::MatrixXd> iterated_maps(std::span<const Eigen::MatrixXd> maps,
                                           std::span<const Eigen::MatrixXd> polygons, int rounds);

/// The three maps of the Sierpinski triangle, contractive by 1/2 [Warren & Weimer 2001, sec. 1.2.2].
std::vector<Eigen::MatrixXd> sierpinski_maps();

/// The four maps of the Koch curve for triangles left, top, right, contractive by 1/3 [Warren & Weimer 2001,
/// sec. 1.2.3]. The curve lies along left - right; on the three images of one Sierpinski round they give the snowflake.
std::vector<Eigen::MatrixXd> koch_maps();

}  // namespace batten
