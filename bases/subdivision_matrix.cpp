// SPDX-License-Identifier: MIT
#include <batten/bases/subdivision_matrix.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

/// The new points along one axis and, for those, the old ones.
struct Axis {
  AxisRules rules;
  IndexRange fine;
  int size;
  Ends ends;

  /// Calls work(row, old point, exponent) for all new points and all exponents of the mask that reach an old one.
  template <std::invocable<int, int, int> Work>
  void for_entries(Work&& work) const {
    for (std::ptrdiff_t i = fine.begin; i < fine.end; ++i)
      for (std::ptrdiff_t e = rules.exponents.begin; e < rules.exponents.end; ++e) {
        if ((i - e) % rules.arity != 0) continue;
        const std::ptrdiff_t place = place_of((i - e) / rules.arity, size, ends);
        if (place >= 0) work(static_cast<int>(i - fine.begin), static_cast<int>(place), static_cast<int>(e));
      }
  }
};

template <int D>
Axis axis_of(const LaurentPolynomial<double, D>& mask, int arity, std::size_t axis, int n, Ends ends) {
  if (n < 1) throw InvalidInput("subdivision_matrix: there must be old points, found " + std::to_string(n));
  require_ends("subdivision_matrix", mask, axis, ends);
  const auto rules = axis_rules(mask, axis, arity);
  const auto fine = rules.refined({0, n}, ends);
  if (fine.size() <= 0)
    throw InvalidInput("subdivision_matrix: there must be new points, found none from " + std::to_string(n) +
                       " old ones with open ends");
  return {rules, fine, n, ends};
}

Eigen::SparseMatrix<double> assembled(std::ptrdiff_t rows, std::ptrdiff_t columns,
                                      const std::vector<Eigen::Triplet<double>>& entries) {
  Eigen::SparseMatrix<double> S(rows, columns);
  S.setFromTriplets(entries.begin(), entries.end());
  S.makeCompressed();
  return S;
}

}  // namespace

Eigen::SparseMatrix<double> subdivision_matrix(const Scheme& scheme, int n, Ends ends, int level) {
  const auto mask = scheme.mask(level);
  const auto axis = axis_of(mask, scheme.arity(), 0, n, ends);
  std::vector<Eigen::Triplet<double>> entries;
  axis.for_entries([&](int i, int j, int e) {
    if (mask[e] != 0) entries.emplace_back(i, j, mask[e]);
  });
  return assembled(axis.fine.size(), n, entries);
}

Eigen::SparseMatrix<double> subdivision_matrix(const Scheme2& scheme, const GridSize& size, Ends ends, int level) {
  const auto mask = scheme.mask(level);
  const auto x = axis_of(mask, scheme.arity(), 0, size.x, ends), y = axis_of(mask, scheme.arity(), 1, size.y, ends);
  const int row = static_cast<int>(x.fine.size());
  std::vector<Eigen::Triplet<double>> entries;
  y.for_entries([&](int iy, int jy, int ey) {
    x.for_entries([&](int ix, int jx, int ex) {
      const double c = mask[{ex, ey}];
      if (c != 0) entries.emplace_back(ix + row * iy, jx + size.x * jy, c);
    });
  });
  return assembled(x.fine.size() * y.fine.size(), std::ptrdiff_t{size.x} * size.y, entries);
}

}  // namespace batten
