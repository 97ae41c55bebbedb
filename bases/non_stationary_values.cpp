// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/non_stationary_values.h>
#include <batten/domains/errors.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace batten {
namespace {

constexpr int most_levels = 400;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The masks of levels 1 .. size(), and what is known of those that follow.
template <int D>
struct Masks {
  std::vector<LaurentPolynomial<double, D>> levels;
  double last_change = 0;  ///< Σ |s_M[i] - s_(M-1)[i]|, or what rounding hides of it
  double rate = 0;         ///< of the changes from level to level
};

template <int D>
void throw_unsettled(const SubdivisionScheme<D>& scheme, double change) {
  throw InvalidInput("bounded_values_at_level: the masks must settle at a geometric rate, found that those of " +
                     scheme.name() + " still change by " + std::to_string(change) + " after " +
                     std::to_string(most_levels) + " levels");
}

/// Follows the masks beyond `level` until they change by rounding alone.
template <int D>
Masks<D> settled_masks(const SubdivisionScheme<D>& scheme, int level) {
  Masks<D> masks;
  masks.levels.push_back(scheme.mask(1));
  if (scheme.is_stationary()) {
    masks.levels.resize(static_cast<std::size_t>(level + 1), scheme.mask(1));
    return masks;
  }
  double change = std::numeric_limits<double>::infinity();
  for (int k = 2; k <= most_levels; ++k) {
    masks.levels.push_back(scheme.mask(k));
    const auto& now = masks.levels.back();
    const double before = change, noise = 16 * epsilon * absolute_sum(now);
    change = absolute_sum(now - masks.levels[masks.levels.size() - 2]);
    if (change > 1e4 * noise && std::isfinite(before)) masks.rate = change / before;  // the rounding does not show
    if (k > level && change <= noise) {
      masks.last_change = noise;
      break;
    }
  }
  if (masks.last_change == 0 || masks.rate > 0.95) throw_unsettled(scheme, change);
  return masks;
}

/// The integer points of the support, x fastest, the ends included.
template <int D>
struct Points {
  Index<D> lower{}, size{};

  Eigen::Index count() const {
    Eigen::Index n = 1;
    for (int s : size) n *= s;
    return n;
  }
  Index<D> operator[](Eigen::Index k) const {
    Index<D> i = lower;
    i[0] += static_cast<int>(k) % size[0];
    if constexpr (D == 2) i[1] += static_cast<int>(k) / size[0];
    return i;
  }
};

template <int D>
Points<D> support_points(const SubdivisionScheme<D>& scheme) {
  const auto mask = scheme.mask(1);
  const Index<D> last = mask.last();
  const int widening = scheme.arity() - 1;
  Points<D> points;
  for (std::size_t d = 0; d < D; ++d) {
    points.lower[d] = static_cast<int>(std::ceil(static_cast<double>(mask.first()[d]) / widening));
    points.size[d] = static_cast<int>(std::floor(static_cast<double>(last[d]) / widening)) - points.lower[d] + 1;
  }
  return points;
}

/// T_ij = s[arity i - j].
template <int D>
Eigen::MatrixXd transition(const LaurentPolynomial<double, D>& s, int arity, const Points<D>& points) {
  Eigen::MatrixXd T(points.count(), points.count());
  for (Eigen::Index a = 0; a < T.rows(); ++a)
    for (Eigen::Index b = 0; b < T.cols(); ++b) {
      Index<D> at = points[a];
      const Index<D> j = points[b];
      for (std::size_t d = 0; d < D; ++d) at[d] = arity * at[d] - j[d];
      T(a, b) = s[at];
    }
  return T;
}

double row_sum_norm(const Eigen::MatrixXd& A) { return A.cwiseAbs().rowwise().sum().maxCoeff(); }

/// Of A P = Q R, with full column rank or 0: 1/‖R⁻¹‖₂, which compiles in a tenth of the time of Eigen's decompositions
/// into singular values.
double smallest_singular_value(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& factors) {
  if (!factors.isInjective()) return 0;
  const Eigen::Index n = factors.cols();
  const Eigen::MatrixXd R = factors.matrixQR().topRows(n);
  const Eigen::MatrixXd inverse = R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  return 1 / std::sqrt(symmetric_eigenvalues(inverse * inverse.transpose())[n - 1]);
}

/// N = T N with sum 1, and the smallest singular value of these equations.
struct FixedVector {
  Eigen::VectorXd N;
  double residual, smallest;
};

FixedVector fixed_vector(const Eigen::MatrixXd& T, const std::string& name) {
  const Eigen::Index n = T.rows();
  Eigen::MatrixXd A(n + 1, n);
  A.topRows(n) = T - Eigen::MatrixXd::Identity(n, n);
  A.row(n).setOnes();
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(n + 1, n);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(A);
  const double smallest = smallest_singular_value(factors);
  const Eigen::VectorXd N = factors.solve(right);
  const double scale = A.norm() * N.norm() * static_cast<double>(n + 1) * epsilon;
  const double residual = (A * N - right).norm() + scale;
  if (smallest < 1e-10 || residual > 1e-10)
    throw InvalidInput("bounded_values_at_level: the values of " + name +
                       " must be determined by its last mask, found that its scheme is not continuous");
  return {N, residual, smallest};
}

/// max over the points m of Σ_j |S[m - arity^level j]|: what a bound for values on Z^D grows to.
template <int D>
double largest_rule(const LaurentPolynomial<double, D>& S, int steps) {
  double most = 0;
  Index<D> residue{};
  for (int y = 0; y < (D == 1 ? 1 : steps); ++y)
    for (int x = 0; x < steps; ++x) {
      residue[D - 1] = y;  // overwritten in one dimension
      residue[0] = x;
      most = std::max(most, absolute_sum(coset(S, residue, steps)));
    }
  return most;
}

/// s_1[x^(arity^(level - 1))] ... s_level[x]
template <int D>
LaurentPolynomial<double, D> mask_to_level(const Masks<D>& masks, int level, int arity) {
  auto S = LaurentPolynomial<double, D>::constant(1);
  for (int k = 0; k < level; ++k) S = upsampled(S, arity) * masks.levels[static_cast<std::size_t>(k)];
  return S;
}

/// n_level on its own grid Z^D + half/2.
template <int D>
BoundedValues<D> values_of_level(const SubdivisionScheme<D>& scheme, const Masks<D>& masks, int level) {
  const auto points = support_points(scheme);
  const auto T = [&](std::size_t k) { return transition(masks.levels[k], scheme.arity(), points); };
  const auto fixed = fixed_vector(T(masks.levels.size() - 1), scheme.name());
  const double largest = fixed.N.cwiseAbs().maxCoeff();
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(points.count(), points.count());
  double growth = 1, norm = 1;
  if (!scheme.is_stationary())
    for (auto k = static_cast<std::size_t>(level); k < masks.levels.size(); ++k) {
      P *= T(k);
      growth = std::max(growth, row_sum_norm(P));
      norm = std::max(norm, row_sum_norm(T(k)));
    }
  const Eigen::VectorXd v = P * fixed.N;
  // the masks still to come: all of their changes, seen by the fixed vector, and the sum of those still to come on each
  const double q = masks.rate, left = masks.last_change * q / (1 - q);
  const double rounds = static_cast<double>(masks.levels.size()), n = static_cast<double>(points.count());
  const double of_fixed = (std::sqrt(n) * largest * left + fixed.residual) / fixed.smallest;
  const double tail = growth * (largest * left / (1 - q) + of_fixed);
  const double rounding = rounds * n * epsilon * growth * growth * norm * largest;
  return {LaurentPolynomial<double, D>(points.lower, points.size, {v.begin(), v.end()}, masks.levels[0].half()),
          tail + rounding};
}

}  // namespace

template <int D>
BoundedValues<D> bounded_values_at_level(const SubdivisionScheme<D>& scheme, int level) {
  if (level < 0)
    throw InvalidInput("bounded_values_at_level: the level must not be negative, found " + std::to_string(level));
  const bool is_shifted = scheme.mask(1).half() != Index<D>{};
  if (is_shifted && scheme.arity() != 2)
    throw InvalidInput("bounded_values_at_level: a mask of arity 3 must have whole powers, found half ones in " +
                       scheme.name());
  const bool is_between = level == 0 && is_shifted;  // integers appear on level 1
  const int from = is_between ? 1 : level;
  const auto masks = settled_masks(scheme, from);
  const auto n = values_of_level(scheme, masks, from);
  const auto S = mask_to_level(masks, from, scheme.arity());
  int steps = 1;
  double rules = 1;  // bounds what rounding of the masks' products grows to
  for (int k = 0; k < from; ++k) {
    steps *= scheme.arity();
    rules *= largest_rule(masks.levels[static_cast<std::size_t>(k)], scheme.arity());
  }
  double largest = 0;
  for (double v : n.values.coefficients()) largest = std::max(largest, std::abs(v));
  const double rounding = (from + 2) * static_cast<double>(scheme.mask(1).coefficients().size() + 2) * epsilon;
  const double error = largest_rule(S, steps) * n.error + rounding * rules * largest;
  const auto values = S * n.values;
  return {is_between ? coset(values, Index<D>{}, scheme.arity()) : values, error};
}

template BoundedValues<1> bounded_values_at_level(const Scheme&, int);
template BoundedValues<2> bounded_values_at_level(const Scheme2&, int);

}  // namespace batten
