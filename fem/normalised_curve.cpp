// SPDX-License-Identifier: MIT
#include <batten/fem/normalised_curve.h>

#include <cmath>

namespace batten {

NormalisedCurve::NormalisedCurve(const std::vector<double>& knots, const Eigen::MatrixXd& data, Less less)
    : dimension(static_cast<int>(data.cols())),
      range((data.colwise().maxCoeff() - data.colwise().minCoeff()).maxCoeff()),
      cell((knots.back() - knots.front()) / static_cast<double>(knots.size() - 1)),
      line(2, data.cols()) {
  if (range == 0) range = 1;
  const double middle = knots.front() / 2 + knots.back() / 2, half = (knots.back() - knots.front()) / 2;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) widths.push_back((knots[i + 1] - knots[i]) / cell);
  for (Eigen::Index i = 0; i < data.rows(); ++i) places.push_back((knots[static_cast<std::size_t>(i)] - middle) / half);
  const Eigen::Map<const Eigen::VectorXd> t(places.data(), data.rows());
  const Eigen::RowVectorXd first = data.row(0), mean = first + (data.rowwise() - first).colwise().mean();
  const double mean_place = t.mean(), squares = (t.array() - mean_place).square().sum();
  line.row(1).setZero();
  if (less == Less::Line)
    line.row(1) = (t.array() - mean_place).matrix().transpose() * (data.rowwise() - mean) / squares;
  line.row(0) = mean - mean_place * line.row(1);
  for (Eigen::Index i = 0; i < data.rows(); ++i)
    for (Eigen::Index k = 0; k < data.cols(); ++k)
      points.push_back((data(i, k) - line(0, k) - t[i] * line(1, k)) / range);
}

Eigen::MatrixXd NormalisedCurve::values(const std::vector<double>& v) const {
  Eigen::MatrixXd result = second_derivatives(v) * (cell * cell);
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    result.row(i) += line.row(0) + places[static_cast<std::size_t>(i)] * line.row(1);
  return result;
}

Eigen::MatrixXd NormalisedCurve::second_derivatives(const std::vector<double>& v) const {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(places.size());
  return Eigen::Map<const Rows>(v.data(), rows, dimension) * (range / cell / cell);
}

double NormalisedCurve::normalised_energy(double energy) const {
  return energy / 2 / std::pow(static_cast<double>(widths.size()), 3);
}

double NormalisedCurve::energy_of(double normalised) const {
  return 2 * normalised * std::pow(static_cast<double>(widths.size()), 3);
}

}  // namespace batten
