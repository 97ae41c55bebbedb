// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/spline_basis.h>
#include <batten/bases/tensor_sum.h>
#include <batten/fem/energy.h>

#include <span>
#include <vector>

namespace batten {

/// The tensor-product spline space of one level: coefficient (i, j) has index i + j * x.size().
struct SplineSpace {
  SplineBasis x, y;
  double hx = 1, hy = 1;  ///< lengths of the finest cells in normalised coordinates

  std::size_t size() const { return static_cast<std::size_t>(x.size()) * static_cast<std::size_t>(y.size()); }
};

/// E of an energy on a spline space: c · (E c) is the energy of the spline with coefficients c.
///
/// Built from exact one-dimensional inner products, E = Σ weight ∫∫ (...) ⊗ (...), symmetric positive semidefinite,
/// applied as a sum of Kronecker products; no matrix is stored [Warren & Weimer 2001, sec. 6.1].
class Operator {
public:
  Operator(const Energy& energy, const SplineSpace& space);

  const TensorSum& products() const { return products_; }
  /// Diagonal entries E_ii.
  std::vector<double> diagonal() const;
  /// Entry of coefficients (i, j) and (k, l).
  double entry(int i, int j, int k, int l) const;

private:
  TensorSum products_;
};

/// The energy of the spline with the given coefficients, by differences first: derivatives as splines of lower degree,
/// then their positive mass matrices. Keeps its relative accuracy where c · (E c) loses it to cancellation.
double evaluate_energy(const Energy& energy, const SplineSpace& space, std::span<const double> coefficients);

}  // namespace batten
