// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/spline_level.h>

#include <Eigen/Core>

#include <array>

namespace batten {

/// The bell form of the source made local: the rules of the exact S_0 of a small uniform domain, used at corners, edges
/// and inside of every larger domain with cells of the same size, padded with zeros [Warren & Weimer 2001, sec. 6.4.3].
/// For an energy of one order only, cells of every size have the same rules.
///
/// The support of the rules is the small domain. Their error falls like a power of its size, r^-2 for the membrane, not
/// exponentially: see LocalScheme.
class PaddedScheme {
public:
  /// The small domain on its fine level: uniform, without mask and coefficient, 2 n cells in each direction, n >= 2.
  /// Throws InvalidInput otherwise.
  explicit PaddedScheme(const VariationalDomain& small);

  /// Coarse cells of the small domain: the least that a domain may have.
  std::array<int, 2> least_cells() const { return {x_.cells, y_.cells}; }
  /// S~ p on a domain of cells[0] x cells[1] coarse cells (cells[1] is 0 for intervals), coefficients x fastest. All
  /// threads, the same bits for every thread count. Throws InvalidInput if the domain is too small or p does not fit.
  Eigen::VectorXd apply(const Eigen::VectorXd& p, std::array<int, 2> cells) const;
  /// The rule of fine function (i, j) of such a domain: weights of the coarse functions window.begin .. in each
  /// direction, x fastest, as many as the small domain has.
  struct Rule {
    std::array<int, 2> begin;
    Eigen::VectorXd weights;
  };
  Rule rule(std::array<int, 2> function, std::array<int, 2> cells) const;

private:
  struct Direction {
    int cells = 0, degree = 0;  // coarse cells of the small domain, 0 for the idle direction
    int coarse() const { return cells == 0 ? 1 : cells + degree; }
    int fine(int n) const { return cells == 0 ? 1 : 2 * n + degree; }
    std::array<int, 2> place(int i, int n) const;
  };

  Direction x_, y_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> S_;
};

/// Entry of fine grid point (i1, j1) and coarse grid point (i2, j2) of the exact scheme S of bounded harmonic splines
/// with hat functions on the quadrant, by reflection of the mask s of the plane: Σ s[i1 ± 2 i2, j1 ± 2 j2], once for an
/// index 0 [Warren & Weimer 2001, eq. 6.23].
double harmonic_quadrant_entry(int i1, int j1, int i2, int j2);

}  // namespace batten
