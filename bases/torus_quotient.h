// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <complex>
#include <vector>

namespace batten {

/// a / b at points (e^(iα), e^(iβ)) of the torus. Where b is small, in 113 bits: near a common zero nothing would be
/// left of a and b in double. Masks without half shifts.
class TorusQuotient {
public:
  /// Throws InvalidInput when b is zero.
  TorusQuotient(const Mask2<Rational>& a, const Mask2<Rational>& b);

  /// |b| over Σ |b[i]|.
  double relative_denominator(double alpha, double beta) const;
  /// The same in double at β = 2π k / n, k = 0 .. n - 1.
  std::vector<double> denominators_on_line(double alpha, int n) const;
  /// a / b; b is not zero there.
  std::complex<double> operator()(double alpha, double beta) const;
  /// a / b at β = 2π k / n, k = 0 .. n - 1.
  std::vector<std::complex<double>> on_line(double alpha, int n) const;
  /// How near to 1 the moduli of the roots y of b(e^(iα), y) come: the least |log|y||, infinity when there is no root.
  double distance_of_roots(double alpha) const;

private:
  /// A mask with coefficients high + low, 106 bits.
  struct Terms {
    Index<2> first{}, size{};
    std::vector<double> high, low;
    double absolute_sum = 0;
  };
  template <class Complex>
  struct Line;
  static Terms terms_of(const Mask2<Rational>& mask);
  template <class Complex>
  static Line<Complex> line_of(const Terms& terms, double alpha);

  Terms a_, b_;
};

}  // namespace batten
