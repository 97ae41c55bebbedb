// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/subdivision_rules.h>

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace batten {

/// Points at equally spaced parameters: point i, in row i with one component in each column, at start + i spacing.
struct ControlPolygon {
  Eigen::MatrixXd points;
  double start = 0;
  double spacing = 1;
};

/// Values on a grid, each component a matrix with x along its columns: entry (i, j) at start + (i, j) spacing.
struct ControlGrid {
  std::vector<Eigen::MatrixXd> components;
  std::array<double, 2> start{0, 0};
  std::array<double, 2> spacing{1, 1};
};

struct SubdivisionOptions {
  int levels = 1;
  Ends ends = Ends::Zero;
  int data_level = 0;  ///< level of the data given: the first step uses the mask of the next level
};

struct GridSubdivisionOptions {
  int levels = 1;
  Ends x = Ends::Zero;
  Ends y = Ends::Zero;
  int data_level = 0;
};

/// The points after some steps: p_k[x] = s_k[x] p_{k-1}[x^arity], at parameters where limits of primal schemes and
/// centred ones do not drift. With zeros beyond the ends all points that are not zero by rule; of a closed polygon
/// arity^levels times as many; of an open one those that it determines, which tend to the part of the limit that it
/// does.
///
/// Throws InvalidInput when there are no points, one is not finite, levels are negative, the result has more than 2^31
/// points, or an open polygon is too short to determine any.
ControlPolygon subdivided(const Scheme& scheme, const ControlPolygon& polygon, const SubdivisionOptions& options = {});

/// The same for all components of a grid, which have the same size.
ControlGrid subdivided(const Scheme2& scheme, const ControlGrid& grid, const GridSubdivisionOptions& options = {});

/// Where the points after some steps lie among the indices of their level, when n points have the indices 0 .. n - 1;
/// empty when an open polygon is too short.
IndexRange subdivided_range(const Scheme& scheme, std::ptrdiff_t n, const SubdivisionOptions& options = {});

/// Fills `out`, of the size of subdivided_range(), with one component of the subdivided points, on all threads and with
/// the same bits for every number of them. Each tile of the result is carried through all levels within the cache:
/// memory holds the data and the result only. Throws as subdivided() does, and when the size is another.
void subdivide_into(const Scheme& scheme, std::span<const double> points, const SubdivisionOptions& options,
                    std::span<double> out);

}  // namespace batten
