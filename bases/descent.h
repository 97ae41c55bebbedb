// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <cstdint>
#include <span>
#include <vector>

namespace batten {

// Arity-adic descent: where f(x) = Σ_j s[j] g(arity x - j), the values f(t + i), i in Z^D, t in [0, 1)^D, follow from
// the values g(t' + i) at t' = arity t - d, d the first arity-adic digits of t. Vectors of such values are stored for i
// in a window, x fastest. Half shifts of masks are dropped: f then belongs to x - half / (2 (arity - 1)).

/// The i for which f(t + i) can be other than zero for some t in [0, 1)^D.
template <int D>
struct SupportWindow {
  Index<D> lower{}, size{};
};
template <Coefficient T, int D>
SupportWindow<D> support_window(const LaurentPolynomial<T, D>& s, int arity);

/// f(t + i) from g(t' + i), i in the window.
template <Coefficient T, int D>
std::vector<T> descended(const LaurentPolynomial<T, D>& s, int arity, const Index<D>& digit,
                         const SupportWindow<D>& window, std::span<const T> g);

/// The coefficients of p in the window.
template <Coefficient T, int D>
std::vector<T> windowed(const LaurentPolynomial<T, D>& p, const SupportWindow<D>& window);

/// How much of what goes into a descent is left after it. V(t) stands for the vector f(t + i), of which the sum is 1.
struct DescentBound {
  int rounds = 1;            ///< after so many rounds
  double ratio = 1;          ///< a vector of sum zero has at most this part of its largest component
  double oscillation = 0;    ///< |V(t)_i - V(0)_i| is at most this
  double amplification = 0;  ///< the largest component of a vector grows at most so much in any number of rounds
  /// Whether a ratio below 1 was found. Without it nothing is known of what is cut off, and the other two are twice the
  /// largest that was seen on the levels tried.
  bool is_proved = false;
};

/// The bound for one mask at all levels and the function's values at integers, by rows of `rounds` steps at once: the
/// row of iterated(s) that belongs to a point is a constant, which vectors of sum zero do not see, and a rest. The
/// rounds are the fewest with a ratio of at most 1/2, or the best of those of less than 200 000 rows: enough on the
/// line and for box splines, not for the butterfly scheme.
template <int D>
DescentBound descent_bound(const LaurentPolynomial<double, D>& s, int arity,
                           const LaurentPolynomial<double, D>& values);

/// The arity-adic digits of x or x - 1/2 after the point: x = cell() + t, t in [0, 1), of which 120 bits are kept.
class Digits {
public:
  /// Precondition: |x| < 10^9.
  explicit Digits(double x = 0, bool minus_half = false);
  int cell() const { return cell_; }
  /// Whether nothing is left of t.
  bool is_zero() const { return high_ == 0 && low_ == 0 && !is_rounded_; }
  /// floor(arity t); t becomes the rest.
  int next(int arity);

private:
  int cell_;
  std::uint64_t high_, low_;  // t = high 2^-60 + low 2^-120
  bool is_rounded_;
};

}  // namespace batten
