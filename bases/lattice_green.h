// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/rational.h>

#include <map>

namespace batten {

/// The number rational + over_pi / π.
struct PiNumber {
  Rational rational = 0;
  Rational over_pi = 0;

  friend bool operator==(const PiNumber&, const PiNumber&) = default;
};

PiNumber operator+(const PiNumber& a, const PiNumber& b);
PiNumber operator-(const PiNumber& a, const PiNumber& b);
PiNumber operator*(const Rational& factor, const PiNumber& a);
/// Right to the last digits although the two parts may nearly cancel.
double to_double(const PiNumber& a);

/// The lattice Green's function of the five-point Laplacian, exact: l G = δ on Z², G(0,0) = 0, G ~ log(r) / (2π).
/// Entries are computed from the diagonal outward and kept; one at distance n takes n² / 2 others, each of about n
/// digits.
///
/// G(n,n) = (1/π) Σ_{k=1..n} 1 / (2k-1), the others by l G = 0 [McCrea & Whipple 1940].
class LatticeGreen {
public:
  PiNumber operator()(int i, int j);

private:
  const PiNumber& at(int i, int j);  // i >= j >= 0
  PiNumber next(int i, int j);

  std::map<std::pair<int, int>, PiNumber> known_;
};

/// Coefficient (i, j) of the harmonic mask l[x²,y²] / l[x,y], exact: Σ_k l[k] G(i - 2k).
PiNumber harmonic_coefficient(LatticeGreen& green, int i, int j);

}  // namespace batten
