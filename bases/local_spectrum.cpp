// SPDX-License-Identifier: MIT
#include <batten/bases/index_box.h>
#include <batten/bases/local_spectrum.h>
#include <batten/domains/errors.h>

#include <cmath>
#include <string>

namespace batten {
namespace {

constexpr int fine_steps = 2;  // limits are compared on points of arity^-2 Z^D

int whole_power(int base, int n) {
  int result = 1;
  for (int k = 0; k < n; ++k) result *= base;
  return result;
}

/// The box of indices j with n(x - j) other than zero for some x near x*. It holds all that A v needs.
template <int D>
IndexBox<D> window_at(const LaurentPolynomial<Rational, D>& s, int arity, const FixedPoint<D>& point) {
  const int period = whole_power(arity, point.steps) - 1, share = period / (arity - 1);
  IndexBox<D> window;
  const Index<D> last = s.last();
  for (std::size_t d = 0; d < D; ++d) {
    window.first[d] = floor_quotient(point.shift[d] - last[d] * share, period);
    window.last[d] = -floor_quotient(s.first()[d] * share - point.shift[d], period);
  }
  return window;
}

template <int D>
RationalMatrix local_matrix(const LaurentPolynomial<Rational, D>& s, int arity, const FixedPoint<D>& point,
                            const std::vector<Index<D>>& window) {
  const auto iterate = iterated(s, point.steps, arity);
  const int coarse = whole_power(arity, point.steps), size = static_cast<int>(window.size());
  RationalMatrix a(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      Index<D> k = window[static_cast<std::size_t>(i)];
      for (std::size_t d = 0; d < D; ++d) k[d] += point.shift[d] - coarse * window[static_cast<std::size_t>(j)][d];
      a(i, j) = iterate[k];
    }
  return a;
}

/// Rows v -> f_v(x), x the points of arity^-fine_steps Z^D whose limits depend on nothing outside the window.
template <int D>
RationalMatrix limit_values(const LaurentPolynomial<Rational, D>& s, int arity, const IndexBox<D>& window) {
  const auto values = grid_values(s, arity);
  if (!values)
    throw InvalidInput(
        "local_characteristic_polynomial: limits must be continuous, found that the refinement equation "
        "does not give their values at grid points");
  const auto fine = iterated(s, fine_steps, arity) * *values;  // n at the points i / arity^fine_steps
  const int scale = whole_power(arity, fine_steps);
  IndexBox<D> points;  // i with i - scale j in the support of `fine` only for j in the window
  const Index<D> fine_last = fine.last();
  for (std::size_t d = 0; d < D; ++d) {
    points.first[d] = scale * (window.first[d] - 1) + fine_last[d] + 1;
    points.last[d] = scale * (window.last[d] + 1) + fine.first()[d] - 1;
  }
  const auto rows = indices_of(points);
  const auto columns = indices_of(window);
  RationalMatrix result(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  for (int i = 0; i < result.rows(); ++i)
    for (int j = 0; j < result.columns(); ++j) {
      Index<D> k = rows[static_cast<std::size_t>(i)];
      for (std::size_t d = 0; d < D; ++d) k[d] -= scale * columns[static_cast<std::size_t>(j)][d];
      result(i, j) = fine[k];
    }
  return result;
}

/// A on V/N, N the largest subspace of the null space of `seen` that A maps into itself: on the row space of
/// {seen, seen A, seen A², ...}, in the basis of its echelon form.
RationalMatrix observed(const RationalMatrix& a, const RationalMatrix& seen) {
  EchelonForm form = echelon_form(seen);
  for (int rank = -1; rank != form.rows.rows();) {
    rank = form.rows.rows();
    form = echelon_form(stacked(form.rows, form.rows * a));
  }
  const RationalMatrix images = form.rows * a;
  RationalMatrix result(images.rows(), images.rows());
  for (int i = 0; i < result.rows(); ++i)
    for (int j = 0; j < result.rows(); ++j) result(i, j) = images(i, form.pivots[static_cast<std::size_t>(j)]);
  return result;
}

/// The number of monomials of a degree in D variables.
template <int D>
int monomials(int degree) {
  return D == 1 ? 1 : degree + 1;
}

}  // namespace

template <int D>
std::optional<LaurentPolynomial<Rational, D>> grid_values(const LaurentPolynomial<Rational, D>& s, int arity) {
  IndexBox<D> inside;
  const Index<D> last = s.last();
  for (std::size_t d = 0; d < D; ++d) {
    inside.first[d] = floor_quotient(s.first()[d], arity - 1) + 1;
    inside.last[d] = -floor_quotient(-last[d], arity - 1) - 1;
  }
  const auto indices = indices_of(inside);
  const int size = static_cast<int>(indices.size());
  RationalMatrix equations(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      Index<D> k = indices[static_cast<std::size_t>(i)];
      for (std::size_t d = 0; d < D; ++d) k[d] = arity * k[d] - indices[static_cast<std::size_t>(j)][d];
      equations(i, j) = s[k] - (i == j ? 1 : 0);
    }
  const auto solutions = null_space(equations);
  if (solutions.size() != 1) return std::nullopt;
  Rational sum = 0;
  for (const Rational& h : solutions.front()) sum += h;
  if (sum == 0) return std::nullopt;
  return LaurentPolynomial<Rational, D>(inside.first, size_of(inside), solutions.front()) * Rational(1 / sum);
}

template <int D>
std::vector<Rational> local_characteristic_polynomial(const LaurentPolynomial<Rational, D>& s, int arity,
                                                      const FixedPoint<D>& point, LocalData data) {
  const IndexBox<D> window = window_at(s, arity, point);
  RationalMatrix a = local_matrix(s, arity, point, indices_of(window));
  if (data == LocalData::Limits) a = observed(a, limit_values(s, arity, window));
  return characteristic_polynomial(std::move(a));
}

template <int D>
bool has_rough_eigenvalue(std::vector<Rational> characteristic, const Rational& radius, int steps, int arity) {
  if (radius <= 0 || radius > 1)
    throw InvalidInput("has_rough_eigenvalue: the radius must lie in (0, 1], found " + radius.str());
  Rational smooth = 1;
  for (int degree = 0; smooth >= radius; ++degree) {
    characteristic = without_root(std::move(characteristic), smooth, monomials<D>(degree));
    smooth /= whole_power(arity, steps);
  }
  return has_root_not_inside(std::move(characteristic), radius);
}

template std::vector<Rational> local_characteristic_polynomial(const Mask<Rational>&, int, const FixedPoint<1>&,
                                                               LocalData);
template std::vector<Rational> local_characteristic_polynomial(const Mask2<Rational>&, int, const FixedPoint<2>&,
                                                               LocalData);
template bool has_rough_eigenvalue<1>(std::vector<Rational>, const Rational&, int, int);
template bool has_rough_eigenvalue<2>(std::vector<Rational>, const Rational&, int, int);
template std::optional<Mask<Rational>> grid_values(const Mask<Rational>&, int);
template std::optional<Mask2<Rational>> grid_values(const Mask2<Rational>&, int);

}  // namespace batten
