// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/triple_products.h>

namespace batten {

/// ∫ ∂^r n(x + i) ∂^q m(x + j) dx over the unit cell [0, 1]^D for all i, j in Z^D, exact: the triple products with the
/// function that is 1 on the cell. Sums of them are the integrals over every domain of whole cells.
template <int D>
class CellProducts {
public:
  /// Throws InvalidInput as TripleProducts does; masks with half shifts do not fit the cells.
  CellProducts(const Factor<D>& n, const Factor<D>& m);

  Rational operator()(const Index<D>& i, const Index<D>& j) const;

private:
  TripleProducts<D> products_;
};

/// The cells i + [0, 1]^D in which n does not vanish, x fastest: those with a positive integral of n^2.
template <int D>
std::vector<Index<D>> support_cells(const SubdivisionScheme<D>& scheme);

/// Inner products of basis functions restricted to a domain.
template <int D>
struct RestrictedProducts {
  /// The shifts of n (rows) and m (columns) that do not vanish in the domain, in ascending order, x fastest.
  std::vector<Index<D>> rows, columns;
  /// E[a][b] = ∫_domain ∂^r n(x - rows[a]) ∂^q m(x - columns[b]) dx
  std::vector<std::vector<Rational>> E;
};

/// On [0, cells] in one dimension, [0, cells_x] x [0, cells_y] in two. Throws InvalidInput as above, and when there is
/// not a cell in each direction.
template <int D>
RestrictedProducts<D> restricted_inner_products(const Factor<D>& n, const Factor<D>& m, const Index<D>& cells);

/// Inner products on [0, ∞): S~^T E S~ = arity^(1 - r - q) E for the rows and columns of the subdivision matrix that
/// belong to these functions [Warren & Weimer 2001, sec. 6.2].
struct HalfLineProducts {
  int first_row = 0, first_column = 0;  ///< the smallest shifts of n and m that do not vanish on [0, ∞)
  /// boundary[a][b] = ∫_0^∞ ∂^r n(x - first_row - a) ∂^q m(x - first_column - b) dx: the rows whose functions reach
  /// below 0.
  std::vector<std::vector<Rational>> boundary;
  /// The other rows: entry (i, j) is interior[j - i] for shifts i, j.
  Mask<Rational> interior;
};
HalfLineProducts half_line_inner_products(const Factor<1>& n, const Factor<1>& m);

}  // namespace batten
