// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/curve_fit.h>
#include <batten/fem/curve_multiresolution.h>

#include <string>

namespace batten {
namespace {

/// The least-energy curve through every second knot.
NaturalCubic coarsened(const NaturalCubic& fine) {
  const Eigen::MatrixXd values = fine.values();
  std::vector<double> knots;
  for (std::size_t i = 0; i < fine.knots().size(); i += 2) knots.push_back(fine.knots()[i]);
  Eigen::MatrixXd points((values.rows() + 1) / 2, values.cols());
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = values.row(2 * i);
  return interpolating_curve(std::move(knots), points, fine.is_closed());
}

/// The refined curve has the knots of `fine`, which need not be halfway: it is sampled there.
NaturalCubic on_knots_of(const NaturalCubic& coarse, const NaturalCubic& fine) {
  const Eigen::Index n = fine.coefficients().rows();
  Eigen::MatrixXd values(n, fine.dimension()), bends(n, fine.dimension());
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = fine.knots()[static_cast<std::size_t>(i)];
    values.row(i) = coarse.derivative(t);
    bends.row(i) = coarse.derivative(t, 2);
  }
  return NaturalCubic::from_values(fine.knots(), values, bends, fine.is_closed());
}

NaturalCubic combined(const NaturalCubic& a, const NaturalCubic& b, double factor) {
  return {a.knots(), a.coefficients() + factor * b.coefficients(), a.is_closed()};
}

}  // namespace

CurveMultiresolution analysed(const NaturalCubic& fine, int levels) {
  const int least = fine.is_closed() ? 3 : 1;
  if (levels < 0 || levels > 30 || fine.cells() % (1 << levels) != 0 || fine.cells() >> levels < least)
    throw InvalidInput("analysed: for " + std::to_string(levels) +
                       " levels the number of cells must be a multiple of 2^" + std::to_string(levels) +
                       " that leaves " + std::to_string(least) + ", found " + std::to_string(fine.cells()));
  CurveMultiresolution parts{fine, {}};
  for (int k = 0; k < levels; ++k) {
    NaturalCubic coarse = coarsened(parts.coarsest);
    parts.details.insert(parts.details.begin(), combined(parts.coarsest, on_knots_of(coarse, parts.coarsest), -1));
    parts.coarsest = std::move(coarse);
  }
  return parts;
}

NaturalCubic CurveMultiresolution::level(int k) const {
  NaturalCubic sum = coarsest;
  for (int i = 0; i < k; ++i) {
    const NaturalCubic& detail = details.at(static_cast<std::size_t>(i));
    sum = combined(on_knots_of(sum, detail), detail, 1);
  }
  return sum;
}

CompressedCurve compressed(const CurveMultiresolution& parts, double threshold) {
  if (!(threshold >= 0))
    throw InvalidInput("compressed: the threshold must not be negative, found " + std::to_string(threshold));
  CompressedCurve result{parts, static_cast<int>(parts.coarsest.coefficients().rows()), 0};
  for (NaturalCubic& detail : result.parts.details) {
    Eigen::MatrixXd values = detail.values();
    for (Eigen::Index i = 1; i < values.rows(); i += 2) {
      if (values.row(i).norm() > threshold)
        ++result.kept;
      else
        values.row(i).setZero();
    }
    for (Eigen::Index i = 0; i < values.rows(); i += 2) values.row(i).setZero();
    const NaturalCubic left = interpolating_curve(detail.knots(), values, detail.is_closed());
    result.energy_error += combined(detail, left, -1).energy();
    detail = left;
  }
  return result;
}

}  // namespace batten
