// SPDX-License-Identifier: MIT
#include <batten/bases/bell_basis.h>
#include <batten/bases/polyharmonic_residual.h>
#include <batten/domains/errors.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

// Near: the sum of the definition in more digits than double has. Far: with z = x + iy, a point w of l^m contributes
//   c_m(z - w) = ((z-w)(z̄-w̄))^(m-1) (log(z-w) + log(z̄-w̄)) / K,  K = 4π 4^(m-1) ((m-1)!)²,
// and Taylor's series in w and w̄, summed over w, is
//   n = Σ_q Σ_p A_pq Re(z̄^(m-1-q) z^(m-1-p)),   q < m, p - q = 4, 8, ..., p + q >= 2m + 2,
//   A_pq = 2 (-1)^(p-m) (p-m)! / (4π 4^(m-1) (m-1-q)! p! q!) · Σ_w l^m[w] w^p w̄^q,
// as moments with p + q < 2m vanish, those with p + q = 2m belong to p = q = m > m - 1, and the symmetry of the square
// leaves multiples of 4. It converges for |z| > m. The moments are whole numbers, computed exactly.

namespace batten {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;
using Complex = std::complex<double>;

constexpr int largest_order = 8;
constexpr int largest_order_in_long_double = 3;
constexpr double far_radius = 1.25;  // times m
constexpr int far_terms = 48;        // far_radius^(-4 · 48) = 2e-19

/// 4π 4^(m-1) ((m-1)!)².
double green_scale(int order) {
  double scale = 4 * std::numbers::pi;
  for (int k = 1; k < order; ++k) scale *= 4. * k * k;
  return scale;
}

template <class Real>
Real integer_power(const Real& x, int n) {
  Real result = 1;
  for (int k = 0; k < n; ++k) result *= x;
  return result;
}

Rational factorial(int n) {
  Rational result = 1;
  for (int k = 2; k <= n; ++k) result *= k;
  return result;
}

/// Σ l^m[w] |w|^(2q) w^(4t) for t = 0 .. count - 1.
std::vector<Integer> moments(const Mask2<double>& differences, int q, int count) {
  std::vector<Integer> sums(static_cast<std::size_t>(count));
  const Index<2> first = differences.first(), last = differences.last();
  for (int j = first[1]; j <= last[1]; ++j)
    for (int i = first[0]; i <= last[0]; ++i) {
      const int square = i * i - j * j, product = 2 * i * j;
      const Integer re4 = square * square - product * product, im4 = 2 * square * product;  // w^4
      Integer re = integer_power(Integer(i * i + j * j), q) * static_cast<long>(differences[{i, j}]), im = 0;
      for (Integer& sum : sums) {
        sum += re;
        const Integer next = re * re4 - im * im4;
        im = re * im4 + im * re4;
        re = next;
      }
    }
  return sums;
}

/// A_pq m^(2m-2-p-q) 4π, for z in units of m.
double far_term(int m, int p, int q, const Integer& moment) {
  Rational term = 2 * Rational(moment) * factorial(p - m) / (factorial(m - 1 - q) * factorial(p) * factorial(q));
  for (int k = 0; k < m - 1; ++k) term /= 4;
  for (int k = 2 * m - 2; k < p + q; ++k) term /= m;
  return ((p - m) % 2 == 0 ? 1 : -1) * term.convert_to<double>();
}

/// Σ_w l^m[w] f(x - w_x, y - w_y, L, ρ), ρ the squared distance and L = log(ρ / m²): whole multiples of polynomials of
/// degree < 2m may be left out of f, as l^m annihilates them.
template <class Real, class Function>
double direct_sum(const Mask2<double>& differences, int m, double x, double y, Function&& f) {
  using std::log;
  Real sum = 0;
  const Index<2> first = differences.first(), last = differences.last();
  for (int j = first[1]; j <= last[1]; ++j)
    for (int i = first[0]; i <= last[0]; ++i) {
      const double weight = differences[{i, j}];
      if (weight == 0) continue;
      const Real dx = Real(x) - i, dy = Real(y) - j, rho = dx * dx + dy * dy;
      sum += weight * f(dx, dy, Real(log(rho / (m * m))), rho);
    }
  return static_cast<double>(sum) / green_scale(m);
}

/// In as many digits as the cancellation of an order needs.
template <class Function>
double near_sum(const Mask2<double>& differences, int m, double x, double y, Function&& f) {
  return m <= largest_order_in_long_double ? direct_sum<long double>(differences, m, x, y, f)
                                           : direct_sum<Quad>(differences, m, x, y, f);
}

/// ρ^n L, n >= 0: 0 at ρ = 0 unless n = 0.
template <class Real>
Real power_times_log(const Real& rho, int n, const Real& L) {
  return n > 0 && rho == 0 ? Real(0) : Real(integer_power(rho, n) * L);
}

/// Σ_k terms[k] w^k and Σ_k (beta + 4k) terms[k] w^k.
struct FarSums {
  Complex plain, weighted;
};

FarSums far_sums(const std::vector<double>& terms, int beta, const Complex& w) {
  FarSums sums;
  for (std::size_t k = terms.size(); k-- > 0;) {
    sums.plain = sums.plain * w + terms[k];
    sums.weighted = sums.weighted * w + (beta + 4. * static_cast<double>(k)) * terms[k];
  }
  return sums;
}

Complex far_variable(const Complex& zeta) {
  const Complex square = 1. / (zeta * zeta);
  return square * square;
}

}  // namespace

double polyharmonic_green(int order, double x, double y) {
  require_order("polyharmonic_green", order);
  const double rho = x * x + y * y;
  return power_times_log(rho, order - 1, std::log(rho)) / green_scale(order);
}

double harmonic_bell(double r, double angle) {
  // 1 + q² - 2q cos 4a = (1 - q)² + 4 q sin² 2a, q = r^-4: both terms stay positive near the spikes at r = 1.
  const double q = std::pow(r, -4), s = std::sin(2 * angle);
  if (q > 1e100) return (-8 * std::log(r)) / (4 * std::numbers::pi);
  const double gap = std::expm1(-4 * std::log(r)), rest = q * (q - 2 * std::cos(4 * angle));
  const double logarithm = r > 2 ? std::log1p(rest) : std::log(gap * gap + 4 * q * s * s);
  return logarithm / (4 * std::numbers::pi);
}

BellBasis::BellBasis(int order) : order_(order) {
  require_order("BellBasis", order);
  if (order > largest_order)
    throw InvalidInput("BellBasis: the order must be at most " + std::to_string(largest_order) + ", found " +
                       std::to_string(order));
  differences_ = to_double(power(five_point_laplacian(), order));
  for (int q = 0; q < order; ++q) {
    const int first = (2 * order + 2 - 2 * q + 3) / 4;  // p + q = 2q + 4t >= 2m + 2
    const auto all = moments(differences_, q, first + far_terms);
    FarPart part{order - 1 - q, q + 4 * first - order + 1, {}};
    for (int t = first; t < first + far_terms; ++t)
      part.terms.push_back(far_term(order, q + 4 * t, q, all[static_cast<std::size_t>(t)]) / (4 * std::numbers::pi));
    far_.push_back(std::move(part));
  }
}

bool BellBasis::is_far(double x, double y) const { return std::hypot(x, y) > far_radius * order_; }

double BellBasis::value(double x, double y) const {
  if (!is_far(x, y))
    return near_sum(differences_, order_, x, y, [m = order_](const auto&, const auto&, const auto& L, const auto& rho) {
      return power_times_log(rho, m - 1, L);
    });
  const Complex zeta = Complex(x, y) / static_cast<double>(order_), w = far_variable(zeta);
  double sum = 0;
  for (const FarPart& part : far_) {
    const Complex front = integer_power(std::conj(zeta), part.alpha) / integer_power(zeta, part.beta);
    sum += (front * far_sums(part.terms, part.beta, w).plain).real();
  }
  return sum;
}

std::array<double, 2> BellBasis::gradient(double x, double y) const {
  if (!is_far(x, y)) {
    // ∂c/∂x = 2x ρ^(m-2) ((m-1) log ρ + 1) / K; the second term is a polynomial for m > 1.
    const auto component = [m = order_](const auto& d, const auto& L, const auto& rho) {
      using Real = std::decay_t<decltype(d)>;
      return m == 1 ? Real(2 * d / rho) : Real(2 * (m - 1) * d * power_times_log(rho, m - 2, rho == 0 ? Real(0) : L));
    };
    return {
        near_sum(differences_, order_, x, y,
                 [&](const auto& dx, const auto&, const auto& L, const auto& rho) { return component(dx, L, rho); }),
        near_sum(differences_, order_, x, y,
                 [&](const auto&, const auto& dy, const auto& L, const auto& rho) { return component(dy, L, rho); })};
  }
  const double m = order_;
  const Complex zeta = Complex(x, y) / m, w = far_variable(zeta);
  Complex by_z, by_conjugate;
  for (const FarPart& part : far_) {
    const FarSums sums = far_sums(part.terms, part.beta, w);
    const Complex back = 1. / integer_power(zeta, part.beta);
    by_z -= integer_power(std::conj(zeta), part.alpha) * back / zeta * sums.weighted;
    if (part.alpha > 0)
      by_conjugate +=
          static_cast<double>(part.alpha) * integer_power(std::conj(zeta), part.alpha - 1) * back * sums.plain;
  }
  return {(by_z + by_conjugate).real() / m, -(by_z - by_conjugate).imag() / m};
}

double BellBasis::laplacian(double x, double y) const {
  if (order_ == 1) return 0;
  if (!is_far(x, y))  // Δc = 4 ρ^(m-2) (m-1)² log(ρ) / K and a polynomial
    return near_sum(differences_, order_, x, y, [m = order_](const auto&, const auto&, const auto& L, const auto& rho) {
      return 4 * (m - 1) * (m - 1) * power_times_log(rho, m - 2, L);
    });
  const double m = order_;
  const Complex zeta = Complex(x, y) / m, w = far_variable(zeta);
  double sum = 0;  // Δ = 4 ∂²/∂z∂z̄
  for (const FarPart& part : far_) {
    if (part.alpha == 0) continue;
    const Complex front = integer_power(std::conj(zeta), part.alpha - 1) / integer_power(zeta, part.beta + 1);
    sum -= 4 * part.alpha * (front * far_sums(part.terms, part.beta, w).weighted).real();
  }
  return sum / (m * m);
}

}  // namespace batten
