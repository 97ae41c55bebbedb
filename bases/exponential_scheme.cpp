// SPDX-License-Identifier: MIT
#include <batten/bases/exponential_scheme.h>
#include <batten/bases/matrix_exponential.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

using Complex = std::complex<double>;

[[noreturn]] void refuse(const std::string& what, const Complex& found) {
  throw InvalidInput("exponential B-spline: " + what + ", found " + std::to_string(found.real()) +
                     (found.imag() < 0 ? " - " : " + ") + std::to_string(std::abs(found.imag())) + "i");
}

/// Takes pairs of conjugate roots away until one is left alone.
void require_conjugates(Roots roots) {
  while (!roots.empty()) {
    const Complex a = roots.back();
    roots.pop_back();
    if (a.imag() == 0) continue;
    const auto is_conjugate = [&](const Complex& b) { return std::abs(b - std::conj(a)) <= 1e-12 * std::abs(a); };
    const auto pair = std::find_if(roots.begin(), roots.end(), is_conjugate);
    if (pair == roots.end()) refuse("complex roots must come in conjugate pairs", a);
    roots.erase(pair);
  }
}

void require_roots(const Roots& roots) {
  if (roots.empty() || roots.size() > 32)
    throw InvalidInput("exponential B-spline: there must be 1 to 32 roots, found " + std::to_string(roots.size()));
  for (const Complex& a : roots)
    if (!(std::abs(a.real()) <= 700) || !(std::abs(a.imag()) < 2 * std::numbers::pi))
      refuse("roots must have |Re a| <= 700 and |Im a| < 2 pi", a);
  require_conjugates(roots);
}

/// e^z - 1 without cancellation at 0.
Complex exp_minus_one(const Complex& z) {
  const double s = std::sin(z.imag() / 2);
  return {std::expm1(z.real()) * std::cos(z.imag()) - 2 * s * s, std::exp(z.real()) * std::sin(z.imag())};
}

/// z / (e^z - 1)
Complex bernoulli_function(const Complex& z) { return z == Complex(0) ? Complex(1) : z / exp_minus_one(z); }

/// The real polynomial ∏ (p_i + q_i x).
Mask<double> real_product(const std::vector<std::array<Complex, 2>>& factors) {
  std::vector<Complex> product = {1};
  for (const auto& [p, q] : factors) {
    product.push_back(0);
    for (std::size_t k = product.size(); k-- > 0;) product[k] = p * product[k] + (k > 0 ? q * product[k - 1] : 0.);
  }
  std::vector<double> real;
  for (const Complex& c : product) real.push_back(c.real());
  return {0, std::move(real)};
}

Mask<double> exponential_mask(const Roots& roots, int level) {
  std::vector<std::array<Complex, 2>> factors;
  for (const Complex& a : roots) {
    const Complex z = std::ldexp(1., -level) * a;
    const Complex decayed = std::exp(z.real() > 0 ? -z : z), small = decayed / (1. + decayed),
                  large = 1. / (1. + decayed);
    factors.push_back(z.real() > 0 ? std::array{small, large} : std::array{large, small});  // 1/(1+η), η/(1+η)
  }
  return 2. * real_product(factors);
}

/// Values of all orders j = 1 .. m on the intervals [i, i + 1]: Z_i(t) = (n_1 .. n_m)(i + t) obeys Z_i' = A Z_i + B
/// Z_{i-1}.
struct Equations {
  Eigen::MatrixXcd A, B;
  Eigen::VectorXcd start;
};

Equations equations_of(const Roots& roots) {
  const auto m = static_cast<Eigen::Index>(roots.size());
  Equations e{Eigen::MatrixXcd::Zero(m, m), Eigen::MatrixXcd::Zero(m, m), Eigen::VectorXcd::Zero(m)};
  for (Eigen::Index j = 0; j < m; ++j) {
    const Complex a = roots[static_cast<std::size_t>(j)];
    e.A(j, j) = a;
    if (j == 0) e.start[0] = bernoulli_function(a);
    if (j > 0) e.A(j, j - 1) = bernoulli_function(a);
    if (j > 0) e.B(j, j - 1) = -bernoulli_function(-a);  // w e^a
  }
  return e;
}

Eigen::VectorXcd carried(const std::vector<Eigen::MatrixXcd>& exponential, const std::vector<Eigen::VectorXcd>& start) {
  Eigen::VectorXcd Z = Eigen::VectorXcd::Zero(start.front().size());
  for (std::size_t k = 0; k < start.size(); ++k) Z += exponential[start.size() - 1 - k] * start[k];
  return Z;
}

}  // namespace

Scheme exponential_scheme(const Roots& roots) {
  require_roots(roots);
  return {"exponential", [roots](int level) { return exponential_mask(roots, level); }, 2, {.roots = roots}};
}

Mask<double> exponential_difference_mask(const Roots& roots, int level) {
  require_roots(roots);
  if (level < 0)
    throw InvalidInput("exponential_difference_mask: the level must not be negative, found " + std::to_string(level));
  std::vector<std::array<Complex, 2>> factors;
  for (const Complex& a : roots) {
    const Complex z = std::ldexp(1., -level) * a;
    const double scale = std::ldexp(1., level);
    factors.push_back({scale * bernoulli_function(z), -scale * bernoulli_function(-z)});
  }
  return real_product(factors);
}

double exponential_green_function(const Roots& roots, double x) {
  require_roots(roots);
  if (!std::isfinite(x)) throw InvalidInput("exponential_green_function: the position must be finite");
  if (x < 0) return 0;
  const auto m = static_cast<Eigen::Index>(roots.size());
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(m, m);
  for (Eigen::Index i = 0; i < m; ++i) A(i, i) = x * roots[static_cast<std::size_t>(i)];
  for (Eigen::Index i = 0; i + 1 < m; ++i) A(i, i + 1) = x;
  return shift_exponential(A, Eigen::MatrixXcd::Zero(m, m), 1).front()(0, m - 1).real();
}

double exponential_spline_value(const Roots& roots, double x) {
  require_roots(roots);
  if (!std::isfinite(x)) throw InvalidInput("exponential_spline_value: the position must be finite");
  const std::size_t m = roots.size();
  if (x < 0 || x >= static_cast<double>(m)) return 0;
  const auto interval = static_cast<std::size_t>(x);
  const auto e = equations_of(roots);
  std::vector<Eigen::VectorXcd> start = {e.start};
  if (interval > 0) {
    const auto step = shift_exponential(e.A, e.B, interval);
    for (std::size_t i = 1; i <= interval; ++i) {
      start.push_back(carried(step, start));
      start.back()[0] = 0;  // n_1 is confined to [0, 1)
    }
  }
  const double t = x - static_cast<double>(interval);
  return carried(shift_exponential(t * e.A, t * e.B, interval + 1), start)[static_cast<Eigen::Index>(m) - 1].real();
}

}  // namespace batten
