// SPDX-License-Identifier: MIT
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_text.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

template <Coefficient T, int D>
struct Division {
  LaurentPolynomial<T, D> quotient, remainder;
};

template <int D>
std::size_t count(const Index<D>& size) {
  std::size_t n = 1;
  for (int s : size) n *= static_cast<std::size_t>(std::max(s, 0));
  return n;
}

/// Place in the storage of a box of the given size of what is at place k in a smaller box.
template <int D>
std::size_t place_in(const Index<D>& larger, const Index<D>& smaller, std::size_t k) {
  const auto row = static_cast<std::size_t>(smaller[0]);
  return k % row + static_cast<std::size_t>(larger[0]) * (k / row);
}

/// Long division from the lowest term, in the order of the storage. If b divides a, each coefficient of the quotient is
/// the first of what is left, and nothing is left at the end: b's first row and its rows' common ends are not all zero,
/// so that the boxes of factors add up to that of the product.
template <Coefficient T, int D>
Division<T, D> divided_upwards(const LaurentPolynomial<T, D>& a, const LaurentPolynomial<T, D>& b) {
  Index<D> first{}, size{}, half{};
  for (std::size_t d = 0; d < D; ++d) {
    const int twice = a.half()[d] - b.half()[d];  // of the difference of the half shifts: -1, 0 or 1
    half[d] = twice & 1;
    first[d] = a.first()[d] - b.first()[d] - (twice < 0);
    size[d] = a.size()[d] - b.size()[d] + 1;
  }
  if (count<D>(size) == 0) return {{}, a};
  std::vector<T> rest(a.coefficients().begin(), a.coefficients().end()), quotient(count<D>(size));
  const auto divisor = b.coefficients();
  std::size_t lead = 0;
  while (divisor[lead] == 0) ++lead;
  for (std::size_t k = 0; k < quotient.size(); ++k) {
    const std::size_t at = place_in<D>(a.size(), size, k);
    quotient[k] = rest[at + lead] / divisor[lead];  // the lead is in b's first row
    if (quotient[k] == 0) continue;
    for (std::size_t j = lead; j < divisor.size(); ++j)
      rest[at + place_in<D>(a.size(), b.size(), j)] -= quotient[k] * divisor[j];
  }
  return {{first, size, std::move(quotient), half}, {a.first(), a.size(), std::move(rest), a.half()}};
}

/// Rounding grows least when the division starts at the larger end of b.
template <Coefficient T, int D>
Division<T, D> divided(const LaurentPolynomial<T, D>& a, const LaurentPolynomial<T, D>& b) {
  using std::abs;
  const auto is_zero = [](const T& c) { return c == 0; };
  const auto divisor = b.coefficients();
  const T& low = *std::find_if_not(divisor.begin(), divisor.end(), is_zero);
  const T& high = *std::find_if_not(divisor.rbegin(), divisor.rend(), is_zero);
  if (abs(low) >= abs(high)) return divided_upwards(a, b);
  const auto mirror = divided_upwards(reflected(a), reflected(b));
  return {reflected(mirror.quotient), reflected(mirror.remainder)};
}

template <int D>
double largest(const LaurentPolynomial<double, D>& s) {
  double most = 0;
  for (double c : s.coefficients()) most = std::max(most, std::abs(c));
  return most;
}

template <int D>
bool leaves_nothing(const Division<Rational, D>& division, const LaurentPolynomial<Rational, D>&,
                    const LaurentPolynomial<Rational, D>&) {
  return division.remainder.is_zero();
}

template <int D>
bool leaves_nothing(const Division<double, D>& division, const LaurentPolynomial<double, D>& a,
                    const LaurentPolynomial<double, D>& b) {
  const double terms = static_cast<double>(std::max<std::size_t>(division.quotient.coefficients().size(), 1));
  return largest(division.remainder) <=
         64 * std::numeric_limits<double>::epsilon() * terms * (largest(a) + largest(b) * largest(division.quotient));
}

template <Coefficient T, int D>
void require_divisor(const char* function, const LaurentPolynomial<T, D>& b) {
  if (b.is_zero()) throw InvalidInput(std::string(function) + ": the divisor must not be zero");
}

}  // namespace

template <Coefficient T, int D>
std::optional<LaurentPolynomial<T, D>> quotient_if_exact(const LaurentPolynomial<T, D>& a,
                                                         const LaurentPolynomial<T, D>& b) {
  require_divisor("quotient_if_exact", b);
  if (a.is_zero()) return a;
  auto division = divided(a, b);
  if (!leaves_nothing(division, a, b)) return std::nullopt;
  return std::move(division.quotient);
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> exact_quotient(const LaurentPolynomial<T, D>& a, const LaurentPolynomial<T, D>& b) {
  require_divisor("exact_quotient", b);
  if (a.is_zero()) return a;
  auto division = divided(a, b);
  if (!leaves_nothing(division, a, b))
    throw InvalidInput("exact_quotient: " + to_string(b) + " must divide " + to_string(a) + ", found the remainder " +
                       to_string(division.remainder));
  return std::move(division.quotient);
}

template <Coefficient T, int D>
int multiplicity(const LaurentPolynomial<T, D>& b, const LaurentPolynomial<T, D>& a) {
  require_divisor("multiplicity", b);
  if (a.is_zero() || b.coefficients().size() == 1)
    throw InvalidInput(
        "multiplicity: a polynomial other than zero and a divisor of two terms or more are needed, found " +
        to_string(a) + " and " + to_string(b));
  int n = 0;
  auto quotient = quotient_if_exact(a, b);
  for (; quotient; quotient = quotient_if_exact(*quotient, b)) ++n;
  return n;
}

template std::optional<Mask<Rational>> quotient_if_exact(const Mask<Rational>&, const Mask<Rational>&);
template std::optional<Mask2<Rational>> quotient_if_exact(const Mask2<Rational>&, const Mask2<Rational>&);
template std::optional<Mask<double>> quotient_if_exact(const Mask<double>&, const Mask<double>&);
template std::optional<Mask2<double>> quotient_if_exact(const Mask2<double>&, const Mask2<double>&);
template Mask<Rational> exact_quotient(const Mask<Rational>&, const Mask<Rational>&);
template Mask2<Rational> exact_quotient(const Mask2<Rational>&, const Mask2<Rational>&);
template Mask<double> exact_quotient(const Mask<double>&, const Mask<double>&);
template Mask2<double> exact_quotient(const Mask2<double>&, const Mask2<double>&);
template int multiplicity(const Mask<Rational>&, const Mask<Rational>&);
template int multiplicity(const Mask2<Rational>&, const Mask2<Rational>&);
template int multiplicity(const Mask<double>&, const Mask<double>&);
template int multiplicity(const Mask2<double>&, const Mask2<double>&);

}  // namespace batten
