// SPDX-License-Identifier: MIT
#include <batten/bases/torus_quotient.h>
#include <batten/domains/errors.h>

#include <Eigen/Eigenvalues>
#include <boost/multiprecision/cpp_complex.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace batten {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;
using QuadComplex = boost::multiprecision::cpp_complex_quad;
using Complex = std::complex<double>;

constexpr double small_denominator = 1e-2;  // relative to Σ |b[i]|: double loses two digits more than it would at 1

template <class C>
C point_at(double angle) {
  using std::cos, std::sin;
  using Real = std::conditional_t<std::is_same_v<C, Complex>, double, Quad>;
  const Real exact = angle;
  return C(Real(cos(exact)), Real(sin(exact)));
}

template <class C>
C integer_power(const C& z, int n) {
  C result = 1;
  for (int k = 0; k < std::abs(n); ++k) result *= z;
  return n < 0 ? C(C(1) / result) : result;
}

Complex rounded(const QuadComplex& z) { return {z.real().convert_to<double>(), z.imag().convert_to<double>()}; }

}  // namespace

/// What is left of a mask for one α: y^first Σ_j coefficients[j] y^j.
template <class C>
struct TorusQuotient::Line {
  int first = 0;
  std::vector<C> coefficients;

  C operator()(const C& y) const {
    C sum = 0;
    for (std::size_t j = coefficients.size(); j-- > 0;) sum = sum * y + coefficients[j];
    return sum * integer_power(y, first);
  }
};

TorusQuotient::Terms TorusQuotient::terms_of(const Mask2<Rational>& mask) {
  Terms terms{mask.first(), mask.size(), {}, {}, 0};
  for (const Rational& c : mask.coefficients()) {
    terms.high.push_back(c.convert_to<double>());
    terms.low.push_back(Rational(c - Rational(terms.high.back())).convert_to<double>());
    terms.absolute_sum += std::abs(terms.high.back());
  }
  return terms;
}

template <class C>
TorusQuotient::Line<C> TorusQuotient::line_of(const Terms& terms, double alpha) {
  const C x = point_at<C>(alpha), shift = integer_power(x, terms.first[0]);
  Line<C> line{terms.first[1], {}};
  const auto columns = static_cast<std::size_t>(terms.size[0]), rows = static_cast<std::size_t>(terms.size[1]);
  for (std::size_t j = 0; j < rows; ++j) {
    C sum = 0;
    for (std::size_t i = columns; i-- > 0;) {
      sum = sum * x + C(terms.high[i + columns * j]);
      if (!std::is_same_v<C, Complex>) sum += C(terms.low[i + columns * j]);
    }
    line.coefficients.push_back(sum * shift);
  }
  return line;
}

TorusQuotient::TorusQuotient(const Mask2<Rational>& a, const Mask2<Rational>& b) : a_(terms_of(a)), b_(terms_of(b)) {
  if (b.is_zero()) throw InvalidInput("TorusQuotient: the denominator must not be zero");
}

double TorusQuotient::relative_denominator(double alpha, double beta) const {
  const auto b = line_of<QuadComplex>(b_, alpha)(point_at<QuadComplex>(beta));
  return std::abs(rounded(b)) / b_.absolute_sum;
}

std::vector<double> TorusQuotient::denominators_on_line(double alpha, int n) const {
  const auto b = line_of<Complex>(b_, alpha);
  std::vector<double> values;
  for (int k = 0; k < n; ++k)
    values.push_back(std::abs(b(point_at<Complex>(2 * std::numbers::pi * k / n))) / b_.absolute_sum);
  return values;
}

Complex TorusQuotient::operator()(double alpha, double beta) const {
  const auto y = point_at<QuadComplex>(beta);
  return rounded(QuadComplex(line_of<QuadComplex>(a_, alpha)(y) / line_of<QuadComplex>(b_, alpha)(y)));
}

std::vector<Complex> TorusQuotient::on_line(double alpha, int n) const {
  const auto a = line_of<Complex>(a_, alpha), b = line_of<Complex>(b_, alpha);
  const auto exact_a = line_of<QuadComplex>(a_, alpha), exact_b = line_of<QuadComplex>(b_, alpha);
  std::vector<Complex> values(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const double beta = 2 * std::numbers::pi * k / n;
    const Complex y = point_at<Complex>(beta), denominator = b(y);
    Complex& value = values[static_cast<std::size_t>(k)];
    if (std::abs(denominator) > small_denominator * b_.absolute_sum) {
      value = a(y) / denominator;
    } else {
      const auto precise = point_at<QuadComplex>(beta);
      value = rounded(QuadComplex(exact_a(precise) / exact_b(precise)));
    }
  }
  return values;
}

double TorusQuotient::distance_of_roots(double alpha) const {
  auto coefficients = line_of<Complex>(b_, alpha).coefficients;
  const double negligible = 1e-14 * b_.absolute_sum;
  while (!coefficients.empty() && std::abs(coefficients.back()) <= negligible) coefficients.pop_back();
  double nearest = std::numeric_limits<double>::infinity();
  const auto degree = static_cast<Eigen::Index>(coefficients.size()) - 1;
  if (degree < 1) return nearest;
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(degree, degree);
  for (Eigen::Index k = 0; k < degree; ++k) {
    if (k > 0) companion(k, k - 1) = 1;
    companion(k, degree - 1) = -coefficients[static_cast<std::size_t>(k)] / coefficients.back();
  }
  const Eigen::VectorXcd roots = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(companion, false).eigenvalues();
  for (const Complex& y : roots) nearest = std::min(nearest, std::abs(std::log(std::abs(y))));
  return nearest;
}

}  // namespace batten
