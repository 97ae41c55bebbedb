// SPDX-License-Identifier: MIT
#include <batten/bases/flow_basis.h>

#include <cmath>
#include <numbers>
#include <utility>

// Velocities as f = u - iv. For g_2 = (c_y, -c_x), f = 2i ∂c/∂z, and with c = z z̄ (log z + log z̄) / 16π
//   f = (i / 8π) z̄ (log z + log z̄ + 1).
// Near: Σ_w W_w f(z - w), in long double, as it loses r³ log r in digits. Far, |z| > |w|, by Taylor's series with the
// moments M(p,q) = Σ_w W_w w^p w̄^q, of which M(0,0) and M(0,1) = conj M(1,0) vanish:
//   f = (i / 8π) { Σ_{p>0} (M(p,1) - z̄ M(p,0)) / (p z^p) + Σ_{n>0} M(0,n+1) / (n (n+1) z̄^n) }.

namespace batten {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double far_radius = 3;  // twice the farthest point, (0, 3/2)
constexpr int far_terms = 64;     // 2^-64

Velocity velocity_of(const Complex& f) { return {f.real(), -f.imag()}; }

/// A Gaussian integer.
struct Gaussian {
  Integer re, im;

  friend Gaussian operator*(const Gaussian& a, const Gaussian& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
};

/// value / 2^halvings, rounded once in each part.
Complex scaled(const Gaussian& value, int halvings) {
  return {std::ldexp(value.re.convert_to<double>(), -halvings), std::ldexp(value.im.convert_to<double>(), -halvings)};
}

/// Σ_k factors[k] w^(k+1).
Complex power_sum(const std::vector<Complex>& factors, const Complex& w) {
  Complex sum = 0;
  for (std::size_t k = factors.size(); k-- > 0;) sum = (sum + factors[k]) * w;
  return sum;
}

}  // namespace

FlowBasis::BiharmonicSum::BiharmonicSum(std::vector<Point> points) : points_(std::move(points)) {
  std::vector<Gaussian> powers(points_.size(), Gaussian{1, 0});  // (2w)^p
  for (int p = 1; p <= far_terms + 1; ++p) {
    Gaussian plain{0, 0}, mixed{0, 0};  // 2^p M(p,0), 2^(p+1) M(p,1)
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const auto& [x, y, weight] = points_[k];
      powers[k] = powers[k] * Gaussian{x, y};
      const Gaussian product = powers[k] * Gaussian{x, -y};
      plain = {plain.re + weight * powers[k].re, plain.im + weight * powers[k].im};
      mixed = {mixed.re + weight * product.re, mixed.im + weight * product.im};
    }
    const Complex moment = scaled(plain, p);
    if (p <= far_terms) {
      plain_.push_back(scaled(mixed, p + 1) / static_cast<double>(p));
      times_conjugate_.push_back(moment / static_cast<double>(p));
    }
    if (p > 1) conjugate_.push_back(std::conj(moment) / (p * (p - 1.)));
  }
}

Complex FlowBasis::BiharmonicSum::operator()(double x, double y) const {
  const Complex sum = std::hypot(x, y) > far_radius ? far({x, y}) : near(x, y);
  return Complex(0, 1 / (8 * pi)) * sum;
}

Complex FlowBasis::BiharmonicSum::near(double x, double y) const {
  std::complex<long double> sum = 0;
  for (const auto& [twice_x, twice_y, weight] : points_) {
    const long double dx = x - twice_x / 2.L, dy = y - twice_y / 2.L, rho = dx * dx + dy * dy;
    if (rho > 0) sum += weight * std::log(rho) * std::complex<long double>(dx, -dy);
  }
  return {static_cast<double>(sum.real()), static_cast<double>(sum.imag())};
}

Complex FlowBasis::BiharmonicSum::far(const Complex& z) const {
  const Complex inverse = 1. / z;
  return power_sum(plain_, inverse) - std::conj(z) * power_sum(times_conjugate_, inverse) +
         power_sum(conjugate_, std::conj(inverse));
}

FlowBasis::FlowBasis(Flow flow) : flow_(flow) {
  if (flow == Flow::Perfect) return;
  const std::vector<BiharmonicSum::Point> laplacian{{0, 0, -4}, {-2, 0, 1}, {2, 0, 1}, {0, -2, 1}, {0, 2, 1}};
  std::vector<BiharmonicSum::Point> pair;
  for (const auto& [x, y, weight] : laplacian) {
    pair.push_back({x, y - 1, weight});
    pair.push_back({x, y + 1, -weight});
  }
  slow_u_ = BiharmonicSum(std::move(pair));
  slow_generator_ = BiharmonicSum(laplacian);
}

Velocity FlowBasis::n_u(double x, double y) const {
  if (flow_ == Flow::Slow) return velocity_of(slow_u_(x, y));
  // 1 / (z² + 1/4), by factors: exact next to the rotors
  return velocity_of(1 / (2 * pi) / Complex(x, y - 0.5) / Complex(x, y + 0.5));
}

Velocity FlowBasis::n_v(double x, double y) const {
  const auto [v, u] = n_u(y, x);  // the mirror image in x = y
  return {u, v};
}

Velocity FlowBasis::generator(double x, double y) const {
  if (flow_ == Flow::Slow) return velocity_of(slow_generator_(x, y));
  return velocity_of(Complex(0, 1 / (2 * pi)) / Complex(x, y));
}

Velocity flow_at(const FlowBasis& basis, const StaggeredField& field, double x, double y) {
  require_field("flow_at", field);
  const double at_x = (x - field.start[0]) / field.spacing, at_y = (y - field.start[1]) / field.spacing;
  Velocity sum{0, 0};
  const auto add = [&sum](double factor, const Velocity& n) {
    for (std::size_t k : {0, 1}) sum[k] += factor * n[k];
  };
  for (Eigen::Index j = 0; j < field.u.cols(); ++j)
    for (Eigen::Index i = 0; i < field.u.rows(); ++i)
      if (const double u = field.u(i, j); u != 0)
        add(u, basis.n_u(at_x - static_cast<double>(i), at_y - static_cast<double>(j) - 0.5));
  for (Eigen::Index j = 0; j < field.v.cols(); ++j)
    for (Eigen::Index i = 0; i < field.v.rows(); ++i)
      if (const double v = field.v(i, j); v != 0)
        add(v, basis.n_v(at_x - static_cast<double>(i) - 0.5, at_y - static_cast<double>(j)));
  return sum;
}

}  // namespace batten
