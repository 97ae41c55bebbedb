// SPDX-License-Identifier: MIT
#include <batten/bases/difference_scheme.h>
#include <batten/bases/eigensystem.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/quotient_coefficients.h>
#include <batten/bases/torus_zeros.h>
#include <batten/domains/errors.h>

#include <boost/math/quadrature/gauss.hpp>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace batten {
namespace {

using Complex = std::complex<double>;
using Polynomial = Mask<Rational>;

constexpr double pi = std::numbers::pi;
constexpr double nearest_root = 1e-8;   // to the unit circle
constexpr double rounding_digits = 40;  // -log of what the trapezoidal rule leaves
constexpr int most_nodes = 1 << 22;
constexpr int most_doublings = 4;

/// The half shift of a quotient and where its coefficients start: index i of the result is i + offset without shifts.
template <int D>
struct QuotientShift {
  Index<D> half{}, offset{};
};

template <int D>
QuotientShift<D> shift_of(const Index<D>& a, const Index<D>& b) {
  QuotientShift<D> shift;
  for (std::size_t d = 0; d < D; ++d) {
    shift.half[d] = a[d] ^ b[d];
    shift.offset[d] = (shift.half[d] - a[d] + b[d]) / 2;
  }
  return shift;
}

template <int D>
IndexBox<D> moved(IndexBox<D> box, const Index<D>& by) {
  for (std::size_t d = 0; d < D; ++d) {
    box.first[d] += by[d];
    box.last[d] += by[d];
  }
  return box;
}

/// The power of two from `least` on.
int nodes_at_least(double least) {
  if (!(least <= most_nodes))
    throw SolverError("quotient_coefficients: at most " + std::to_string(most_nodes) +
                      " nodes are allowed, found that " + std::to_string(least) +
                      " are needed: the denominator comes too near to zero");
  int n = 64;
  while (n < least) n *= 2;
  return n;
}

/// (1/n) Σ_k values[k] e^(-2πi k j / n), j = 0 .. n - 1; negative j at n + j.
std::vector<Complex> fourier_coefficients(const std::vector<Complex>& values) {
  Eigen::FFT<double> fft;
  std::vector<Complex> sums;
  fft.fwd(sums, values);
  for (Complex& sum : sums) sum /= static_cast<double>(values.size());
  return sums;
}

Complex coefficient_at(const std::vector<Complex>& all, int j) {
  const int n = static_cast<int>(all.size());
  return all[static_cast<std::size_t>(((j % n) + n) % n)];
}

/// a without multiples of b: a - q b of lower degree than b, powers counted from the first.
Polynomial remainder(Polynomial a, const Polynomial& b) {
  while (!a.is_zero() && a.size()[0] >= b.size()[0]) {
    const Rational factor = a[a.last()] / b[b.last()];
    a -= factor * shifted(b, {a.last()[0] - b.last()[0]});
  }
  return a;
}

/// With leading coefficient 1; the first power is 0.
Polynomial common_divisor(Polynomial a, Polynomial b) {
  while (!b.is_zero()) {
    b *= Rational(1 / b[b.last()]);
    a = remainder(shifted(a, {-a.first()[0]}), shifted(b, {-b.first()[0]}));
    std::swap(a, b);
  }
  return shifted(a, {-a.first()[0]});
}

/// The roots of b other than 0, each once.
std::vector<Complex> simple_roots(const Polynomial& b) {
  const auto exact = shifted(b, {-b.first()[0]});
  const auto p = to_double(exact_quotient(exact, common_divisor(exact, derivative(exact))));
  const auto degree = static_cast<Eigen::Index>(p.size()[0]) - 1;
  if (degree < 1) return {};
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  for (Eigen::Index k = 0; k < degree; ++k) {
    if (k > 0) companion(k, k - 1) = 1;
    companion(k, degree - 1) = -p.coefficients()[static_cast<std::size_t>(k)] / p.coefficients().back();
  }
  const Eigen::VectorXcd roots = eigenvalues(companion);
  return {roots.begin(), roots.end()};
}

/// The least |log|x|| over the roots of b. Throws when one is on the circle.
double distance_to_circle(const Polynomial& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Complex& root : simple_roots(b)) {
    const double distance = std::abs(std::log(std::abs(root)));
    if (distance < nearest_root)
      throw InvalidInput(
          "quotient_coefficients: the quotient must be bounded for |x| = 1, found that the denominator " +
          to_string(b) + " vanishes at x = e^(iα), α = " + std::to_string(std::arg(root) / pi) + " π");
    nearest = std::min(nearest, distance);
  }
  return nearest;
}

int reach(const IndexBox<1>& box) { return std::max(std::abs(box.first[0]), std::abs(box.last[0])); }

/// Σ_panels of the integral over α in [0, π] of Re(F_j(α) e^(-iαi)) / π for all (i, j) of the box, F_j the coefficients
/// of the line. Negative α contribute the conjugate.
class TorusIntegral {
public:
  TorusIntegral(const TorusQuotient& quotient, const IndexBox<2>& box) : quotient_(quotient), box_(box) {
    for (const auto& zero : denominator_zeros(quotient)) ends_.push_back(zero[0] <= pi ? zero[0] : 2 * pi - zero[0]);
    ends_.insert(ends_.end(), {0, pi});
    std::sort(ends_.begin(), ends_.end());
  }

  /// With `fineness` times as many panels as the oscillation of e^(-iαi) asks for.
  std::vector<double> coefficients(int fineness) const {
    std::vector<double> sums(static_cast<std::size_t>(size_of(box_)[0] * size_of(box_)[1]));
    const int oscillations = std::max({std::abs(box_.first[0]), std::abs(box_.last[0]), 1});
    const double width = std::min(pi / 4, 8. / oscillations) / fineness;
    for (std::size_t e = 0; e + 1 < ends_.size(); ++e) {
      const double length = ends_[e + 1] - ends_[e];
      if (length < 1e-9) continue;
      const int panels = static_cast<int>(std::ceil(length / width));
      for (int p = 0; p < panels; ++p) add_panel(sums, ends_[e] + length * (p + 0.5) / panels, length / panels / 2);
    }
    return sums;
  }

private:
  using Gauss = boost::math::quadrature::gauss<double, 20>;

  void add_panel(std::vector<double>& sums, double middle, double half) const {
    for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k)
      for (int sign : {-1, 1}) add_line(sums, middle + sign * half * Gauss::abscissa()[k], half * Gauss::weights()[k]);
  }

  void add_line(std::vector<double>& sums, double alpha, double weight) const {
    const int widest = std::max(std::abs(box_.first[1]), std::abs(box_.last[1]));
    const int n = nodes_at_least(rounding_digits / quotient_.distance_of_roots(alpha) + 2. * widest + 64);
    const auto line = fourier_coefficients(quotient_.on_line(alpha, n));
    std::size_t place = 0;
    for (int j = box_.first[1]; j <= box_.last[1]; ++j)
      for (int i = box_.first[0]; i <= box_.last[0]; ++i)
        sums[place++] += weight / pi * (coefficient_at(line, j) * std::polar(1., -i * alpha)).real();
  }

  const TorusQuotient& quotient_;
  IndexBox<2> box_;
  std::vector<double> ends_;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

}  // namespace

Mask<double> quotient_coefficients(const Mask<Rational>& a, const Mask<Rational>& b, const IndexBox<1>& box) {
  if (b.is_zero()) throw InvalidInput("quotient_coefficients: the denominator must not be zero");
  if (a.is_zero()) return {};
  const auto shift = shift_of<1>(a.half(), b.half());
  const auto divisor = common_divisor(without_half_shift(a), without_half_shift(b));
  const auto reduced_a = exact_quotient(without_half_shift(a), divisor);
  const auto reduced_b = exact_quotient(without_half_shift(b), divisor);
  const auto inside = moved<1>(box, shift.offset);
  const int n = nodes_at_least(rounding_digits / distance_to_circle(reduced_b) + 2. * reach(inside) +
                               2. * std::max(reduced_a.size()[0] + std::abs(reduced_a.first()[0]),
                                             reduced_b.size()[0] + std::abs(reduced_b.first()[0])));
  const auto top = to_double(reduced_a), bottom = to_double(reduced_b);
  std::vector<Complex> values;
  for (int k = 0; k < n; ++k) {
    const Complex x = std::polar(1., 2 * pi * k / n);
    values.push_back(evaluate(top, x) / evaluate(bottom, x));
  }
  const auto all = fourier_coefficients(values);
  std::vector<double> coefficients;
  for (const Index<1>& i : indices_of(inside)) coefficients.push_back(coefficient_at(all, i[0]).real());
  return {box.first, size_of(box), std::move(coefficients), shift.half};
}

Mask2<double> quotient_coefficients(const Mask2<Rational>& a, const Mask2<Rational>& b, const IndexBox<2>& box,
                                    const QuotientOptions& options) {
  const auto shift = shift_of<2>(a.half(), b.half());
  const TorusQuotient quotient(without_half_shift(a), without_half_shift(b));
  if (a.is_zero()) return {};
  require_bounded(quotient, denominator_zeros(quotient));
  const TorusIntegral integral(quotient, moved<2>(box, shift.offset));
  auto coarse = integral.coefficients(1);
  double change = 0;
  for (int doubling = 1, fineness = 2; doubling <= most_doublings; ++doubling, fineness *= 2) {
    auto fine = integral.coefficients(fineness);
    change = largest_difference(coarse, fine);
    if (change <= options.tolerance) return {box.first, size_of(box), std::move(fine), shift.half};
    coarse = std::move(fine);
  }
  throw SolverError("quotient_coefficients: coefficients must settle to " + std::to_string(options.tolerance) +
                    ", found a change of " + std::to_string(change) + " at the last doubling of the nodes");
}

}  // namespace batten
