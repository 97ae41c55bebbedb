// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/knot_splines.h>
#include <batten/fem/energy.h>

#include <Eigen/SparseCore>

#include <optional>
#include <vector>

namespace batten {

/// Where variational schemes are derived: an energy of splines on an interval or rectangle cut into cells, with a
/// coefficient κ and a mask of cells, ∫ κ Σ weight (∂_x^a ∂_y^b p)². On an interval (no y) only the terms without
/// y-derivative count.
struct VariationalDomain {
  Breakpoints x;
  std::optional<Breakpoints> y = {};
  Energy energy = Energy::membrane();
  int degree = 1;
  KnotSplines::Ends ends = KnotSplines::Ends::Clamped;
  std::vector<double> coefficient = {};  ///< κ > 0 of each cell, x fastest; empty: 1
  std::vector<char> inside = {};         ///< 1 for cells of the domain, 0 for others, x fastest; empty: all are
  /// Hat functions on cells that are each cut into two triangles, instead of products of hats: those of
  /// [Warren & Weimer 2001, sec. 6.4.1], whose membrane energy is the five-point difference. For degree 1, first
  /// derivatives, rectangles of an even number of equal cells, without coefficient and mask. Their weights are the
  /// source's: a quarter of a cell's area for each of its corners.
  bool triangles = false;

  int rows() const { return y ? y->cells() : 1; }
};

/// One level of the spline space on a VariationalDomain: tensor-product splines that do not vanish on it, their energy
/// cell by cell, and the way to the next coarser level.
///
/// Energies are exact: coarser levels of a varying coefficient or a mask take the energy of the finest cells by
/// refinement, e_C = Σ_c L_c^T e_c L_c over the cells c of a coarse cell C, L_c the refinement between the functions
/// of C and c.
class SplineLevel {
public:
  static constexpr int max_local = 16;  ///< functions of a cell
  using Element = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_local, max_local>;
  using Local = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_local, 1>;
  struct Monomial {
    int a, b;  ///< s^a t^b, s and t in [-1, 1] over the bounding rectangle
  };

  /// The finest level. Throws InvalidInput unless the degree is from 1 to 3 and at least the order of every derivative
  /// that counts, the energy bounds the null space (has a pure derivative in each direction), coefficients are finite
  /// and positive, one for each cell, and the domain's cells are connected through sides.
  explicit SplineLevel(const VariationalDomain& domain);
  bool can_coarsen() const;
  /// The next coarser level. Throws InvalidInput unless there are two cells in each direction.
  SplineLevel coarser() const;

  const KnotSplines& x() const { return x_; }
  const KnotSplines& y() const { return y_; }
  bool is_interval() const { return interval_; }
  bool has_mask() const { return !inside_.empty(); }
  bool is_inside(int cx, int cy) const;
  /// Functions, numbered x fastest without those that vanish on the domain.
  int size() const { return static_cast<int>(grid_.size()); }
  /// Number of the function (i, j), -1 where it vanishes on the domain.
  int function(int i, int j) const { return number_[static_cast<std::size_t>(i + j * x_.size())]; }
  /// i + j x().size() of a function.
  int grid(int function) const { return grid_[static_cast<std::size_t>(function)]; }
  int local_size() const { return (x_.degree() + 1) * (y_.degree() + 1); }

  /// Energies of the functions of a cell (x fastest), zero outside of the domain.
  Element element(int cx, int cy) const;
  /// ∫ s^a t^b N over a cell, in the domain's own units of area, whether it is inside or not.
  Local cell_moments(int cx, int cy, Monomial m) const;
  /// E, symmetric positive semidefinite: size() x size(), both triangles.
  Eigen::SparseMatrix<double> energy() const;
  /// c · (E c), cell by cell: nothing is assembled.
  double energy_of(const Eigen::VectorXd& c) const;
  /// R of this level to `finer`, whose coarser() it is: finer.size() x size().
  Eigen::SparseMatrix<double> refinement(const SplineLevel& finer) const;
  /// The monomials without energy, those that every term annihilates: a basis of the null space of E.
  const std::vector<Monomial>& null_monomials() const { return monomials_; }
  /// Their coefficients Z: size() x monomials.
  Eigen::MatrixXd null_space() const;
  /// w, their integrals against the functions over the cells of this level that meet the domain: monomials x size().
  Eigen::MatrixXd moments() const;

private:
  SplineLevel(KnotSplines x, KnotSplines y) : x_(std::move(x)), y_(std::move(y)) {}
  void number_functions();
  void tabulate();
  void take_elements(const SplineLevel& finer);
  Element triangle_element(int cx, int cy) const;
  std::size_t cell(int cx, int cy) const { return static_cast<std::size_t>(cx + cy * x_.cells()); }

  KnotSplines x_, y_;
  bool interval_ = false, triangles_ = false;
  std::vector<Energy::Term> terms_;
  std::vector<Monomial> monomials_;
  std::vector<double> coefficient_;  // of each cell of the finest level; empty: 1
  std::vector<char> inside_;         // of each cell; empty: all
  std::vector<double> element_;      // of each cell of a coarser level of a coefficient or mask; else empty
  std::vector<int> number_, grid_;
  std::vector<KnotSplines::LocalMatrix> x_products_, y_products_;  // [cell * 4 + order], in the domain's own units
};

}  // namespace batten
