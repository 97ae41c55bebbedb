// SPDX-License-Identifier: MIT
#include <batten/bases/index_box.h>
#include <batten/bases/restricted_inner_products.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace batten {
namespace {

template <int D>
Index<D> negated(const Index<D>& i) {
  Index<D> result{};
  for (std::size_t d = 0; d < D; ++d) result[d] = -i[d];
  return result;
}

template <int D>
const Factor<D>& on_whole_grid(const Factor<D>& factor) {
  if (factor.scheme.exact_mask().half() != Index<D>{})
    throw InvalidInput("CellProducts: masks must have whole powers, found half ones in " + factor.scheme.name());
  return factor;
}

/// All cells of a domain, x fastest.
template <int D>
std::vector<Index<D>> domain_cells(const Index<D>& cells) {
  for (int n : cells)
    if (n < 1)
      throw InvalidInput("restricted_inner_products: a cell in each direction is needed, found " + std::to_string(n));
  std::vector<Index<D>> result;
  Index<D> cell{};
  for (int y = 0; y < (D == 1 ? 1 : cells[D - 1]); ++y)
    for (int x = 0; x < cells[0]; ++x) {
      cell[D - 1] = y;  // overwritten in one dimension
      cell[0] = x;
      result.push_back(cell);
    }
  return result;
}

template <int D>
struct FastestFirst {
  bool operator()(const Index<D>& a, const Index<D>& b) const {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }
};

template <int D>
std::vector<Index<D>> shifts_that_meet(const std::vector<Index<D>>& domain, const std::vector<Index<D>>& support) {
  std::set<Index<D>, FastestFirst<D>> shifts;
  for (const auto& cell : domain)
    for (const auto& of_n : support) shifts.insert(difference(cell, of_n));
  return {shifts.begin(), shifts.end()};
}

template <int D>
std::map<Index<D>, std::size_t> places_of(const std::vector<Index<D>>& shifts) {
  std::map<Index<D>, std::size_t> places;
  for (const auto& shift : shifts) places.emplace(shift, places.size());
  return places;
}

}  // namespace

template <int D>
CellProducts<D>::CellProducts(const Factor<D>& n, const Factor<D>& m)
    : products_({unit_cell_scheme<D>(n.scheme.arity())}, on_whole_grid(n), on_whole_grid(m)) {}

template <int D>
Rational CellProducts<D>::operator()(const Index<D>& i, const Index<D>& j) const {
  return products_(negated<D>(i), negated<D>(j));
}

template <int D>
std::vector<Index<D>> support_cells(const SubdivisionScheme<D>& scheme) {
  const CellProducts<D> squares({scheme}, {scheme});
  const auto support = scheme.support();
  Index<D> size{}, lower{};
  for (std::size_t d = 0; d < D; ++d) {
    lower[d] = static_cast<int>(floor(static_cast<double>(support.lower[d])));
    size[d] = static_cast<int>(ceil(static_cast<double>(support.upper[d]))) - lower[d];
  }
  std::vector<Index<D>> cells;
  for (const auto& offset : domain_cells<D>(size)) {
    const auto cell = difference(offset, negated<D>(lower));
    if (squares(cell, cell) != 0) cells.push_back(cell);
  }
  return cells;
}

template <int D>
RestrictedProducts<D> restricted_inner_products(const Factor<D>& n, const Factor<D>& m, const Index<D>& cells) {
  const auto domain = domain_cells<D>(cells);
  const CellProducts<D> products(n, m);
  const auto of_n = support_cells(n.scheme), of_m = support_cells(m.scheme);
  RestrictedProducts<D> result{shifts_that_meet<D>(domain, of_n), shifts_that_meet<D>(domain, of_m), {}};
  const auto rows = places_of<D>(result.rows), columns = places_of<D>(result.columns);
  result.E.assign(rows.size(), std::vector<Rational>(columns.size()));
  for (const auto& cell : domain)
    for (const auto& a : of_n)
      for (const auto& b : of_m)
        result.E[rows.at(difference(cell, a))][columns.at(difference(cell, b))] += products(a, b);
  return result;
}

HalfLineProducts half_line_inner_products(const Factor<1>& n, const Factor<1>& m) {
  const auto rows = support_cells(n.scheme), columns = support_cells(m.scheme);
  const CellProducts<1> products(n, m);
  HalfLineProducts result;
  result.first_row = -rows.back()[0];
  result.first_column = -columns.back()[0];
  result.interior = inner_products(n, m);
  for (int i = result.first_row; i + rows.front()[0] < 0; ++i) {
    const int end = i + rows.back()[0] + 1;  // of the support of row i
    auto& row = result.boundary.emplace_back();
    for (int j = result.first_column; j + columns.front()[0] < end; ++j) {
      auto& entry = row.emplace_back();
      for (int cell = 0; cell < end; ++cell) entry += products({cell - i}, {cell - j});
    }
  }
  return result;
}

template class CellProducts<1>;
template class CellProducts<2>;
template std::vector<Index<1>> support_cells(const Scheme&);
template std::vector<Index<2>> support_cells(const Scheme2&);
template RestrictedProducts<1> restricted_inner_products(const Factor<1>&, const Factor<1>&, const Index<1>&);
template RestrictedProducts<2> restricted_inner_products(const Factor<2>&, const Factor<2>&, const Index<2>&);

}  // namespace batten
