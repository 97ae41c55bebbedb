// SPDX-License-Identifier: MIT
#include <batten/bases/polyharmonic_residual.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <string>
#include <type_traits>

namespace batten {
namespace {

template <Coefficient T>
Mask2<T> laplacian_power(int order) {
  const auto l = power(five_point_laplacian(), order);
  if constexpr (std::is_same_v<T, double>)
    return to_double(l);
  else
    return l;
}

std::size_t residue(int i, int arity) { return static_cast<std::size_t>(((i % arity) + arity) % arity); }

/// 4^(rounds (1 - order)).
template <Coefficient T>
T scale(int order, int rounds) {
  T result = 1;
  for (int k = 0; k < rounds * (order - 1); ++k) result /= 4;
  return result;
}

}  // namespace

void require_order(const char* function, int order) {
  if (order < 1)
    throw InvalidInput(std::string(function) + ": the order must be at least 1, found " + std::to_string(order));
}

Mask2<Rational> five_point_laplacian() { return {{-1, -1}, {3, 3}, {0, 1, 0, 1, -4, 1, 0, 1, 0}}; }

template <Coefficient T>
Mask2<T> residual(const Mask2<T>& s, int order) {
  require_order("residual", order);
  const auto l = laplacian_power<T>(order);
  return l * s - scale<T>(order, 1) * upsampled(l, 2);
}

template <Coefficient T>
T largest_coset_sum(const Mask2<T>& r, int arity) {
  if (arity < 1) throw InvalidInput("largest_coset_sum: the arity must be at least 1, found " + std::to_string(arity));
  using std::abs;
  const auto row = static_cast<std::size_t>(arity);
  std::vector<T> sums(row * row);
  std::size_t k = 0;
  for (int y = 0; y < r.size()[1]; ++y)
    for (int x = 0; x < r.size()[0]; ++x)
      sums[residue(r.first()[0] + x, arity) + row * residue(r.first()[1] + y, arity)] += abs(r.coefficients()[k++]);
  return *std::max_element(sums.begin(), sums.end());
}

double multilevel_residual(const Mask2<double>& s, int order, int rounds) {
  require_order("multilevel_residual", order);
  if (rounds < 0 || rounds > 12)
    throw InvalidInput("multilevel_residual: rounds must be 0 to 12, found " + std::to_string(rounds));
  const auto l = laplacian_power<double>(order);
  const int arity = 1 << rounds;
  return largest_coset_sum(l * iterated(s, rounds) - scale<double>(order, rounds) * upsampled(l, arity), arity);
}

template Mask2<Rational> residual(const Mask2<Rational>&, int);
template Mask2<double> residual(const Mask2<double>&, int);
template Rational largest_coset_sum(const Mask2<Rational>&, int);
template double largest_coset_sum(const Mask2<double>&, int);

}  // namespace batten
