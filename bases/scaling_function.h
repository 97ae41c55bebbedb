// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/derivative_mask.h>
#include <batten/bases/descent.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/scheme.h>

namespace batten {

/// A value and a bound on its error.
struct BoundedValue {
  double value = 0;
  double error = 0;
};

/// ∂^r n of a stationary scheme with rational coefficients, anywhere.
///
/// By arity-adic descent: n at x is a combination of its values on Z^D, through one refinement equation per digit of x.
/// Doubles have finitely many binary digits, so that at arity 2 nothing is left out but what is below 2^-60. At arity 3
/// the digits are cut where a vector of sum zero has shrunk to the unit roundoff. The error counts both, and rounding,
/// by the bounds of descent.h, themselves computed in doubles. It presumes that ∂^r n is continuous, and, where
/// error_is_proved() says no, that sums do not grow beyond twice those seen.
template <int D>
class ScalingFunction {
public:
  /// Throws InvalidInput as values_at_integers does, for half shifts at arity 3, and for those derivatives at arity 3
  /// that are not differences (see derivative_mask.h).
  explicit ScalingFunction(const SubdivisionScheme<D>& scheme, const Index<D>& derivative = {});

  /// ∂^r n(x). Throws InvalidInput when x is not finite.
  BoundedValue operator()(const Coordinates<double, D>& x) const;
  BoundedValue operator()(double x) const requires(D == 1) { return (*this)(Coordinates<double, D>{x}); }

  /// ∂^r n(x - i) for the i of a box outside which it vanishes, x fastest: the basis at x.
  struct Basis {
    Index<D> first, size;
    std::vector<double> values;
    double error;  ///< of each, at most
  };
  Basis at(const Coordinates<double, D>& x) const;

  bool error_is_proved() const { return bound_.is_proved; }

private:
  /// Values of the mask's function at the places t + i of the window, and their error.
  struct Descent {
    std::vector<double> values;
    double error;
  };
  Descent descend(std::array<Digits, D> t) const;
  Descent descend_exactly(const Coordinates<double, D>& x) const;
  double error_bound(int rounds, bool is_cut) const;

  DerivativeMask<D> mask_;
  LaurentPolynomial<Rational, D> own_grid_;
  LaurentPolynomial<double, D> real_mask_, differences_;
  SupportWindow<D> window_;
  std::vector<double> at_integers_;
  DescentBound bound_{.is_proved = true};  ///< of derivatives that are not differences: exact
};

/// ∂^r n(x), exact, at a point whose coordinates times a power of the arity are integers (those of the support's grid:
/// half shifts count). Throws InvalidInput as values_at_integers does, and for other points.
template <int D>
Rational value_at(const SubdivisionScheme<D>& scheme, const Coordinates<Rational, D>& x,
                  const Index<D>& derivative = {});

}  // namespace batten
