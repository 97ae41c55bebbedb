// SPDX-License-Identifier: MIT
#include <batten/bases/lattice_green.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace batten {
namespace {

/// arctan(1/n) 2^bits, short of it or beyond by at most the number of terms.
Integer scaled_arctangent(int n, unsigned bits) {
  Integer power = (Integer(1) << bits) / n, sum = power;
  for (int k = 1; power != 0; ++k) {
    power /= n * n;
    sum += Integer(power / (2 * k + 1)) * (k % 2 == 0 ? 1 : -1);
  }
  return sum;
}

/// 1 / π, π / 4 = 4 arctan(1/5) - arctan(1/239) [Machin 1706].
Rational inverse_pi(unsigned bits) {
  const unsigned guarded = bits + 32;
  const Integer pi = 16 * scaled_arctangent(5, guarded) - 4 * scaled_arctangent(239, guarded);
  return Rational(Integer(1) << guarded, pi);
}

}  // namespace

PiNumber operator+(const PiNumber& a, const PiNumber& b) { return {a.rational + b.rational, a.over_pi + b.over_pi}; }
PiNumber operator-(const PiNumber& a, const PiNumber& b) { return {a.rational - b.rational, a.over_pi - b.over_pi}; }
PiNumber operator*(const Rational& factor, const PiNumber& a) { return {factor * a.rational, factor * a.over_pi}; }

double to_double(const PiNumber& a) {
  if (a.over_pi == 0) return a.rational.convert_to<double>();
  const double size = std::abs(a.over_pi.convert_to<double>());
  const int digits = std::max(0, std::ilogb(size));  // of what may cancel
  return Rational(a.rational + a.over_pi * inverse_pi(static_cast<unsigned>(digits) + 128)).convert_to<double>();
}

PiNumber LatticeGreen::operator()(int i, int j) {
  i = std::abs(i);
  j = std::abs(j);
  return at(std::max(i, j), std::min(i, j));
}

const PiNumber& LatticeGreen::at(int i, int j) {
  const auto found = known_.find({i, j});
  if (found != known_.end()) return found->second;
  const PiNumber value = next(i, j);
  return known_.emplace(std::pair(i, j), value).first->second;
}

PiNumber LatticeGreen::next(int i, int j) {
  if (i == 0) return {};
  if (i == j) return at(i - 1, i - 1) + PiNumber{0, Rational(1) / (2 * i - 1)};
  if (i == 1) return {Rational(1) / 4, 0};
  if (i == j + 1) return Rational(2) * at(j, j) - at(j, j - 1);  // l G = 0 at (j, j)
  return Rational(4) * at(i - 1, j) - at(i - 2, j) - at(i - 1, j + 1) - (*this)(i - 1, j - 1);
}

PiNumber harmonic_coefficient(LatticeGreen& green, int i, int j) {
  return green(i + 2, j) + green(i - 2, j) + green(i, j + 2) + green(i, j - 2) - Rational(4) * green(i, j);
}

}  // namespace batten
