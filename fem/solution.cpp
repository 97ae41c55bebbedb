// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/solution.h>

#include <cmath>
#include <limits>
#include <string>

namespace batten {
namespace {

std::vector<double> sampled(const BandedRows& y, const BandedRows& x, double factor, std::span<const double> c) {
  const TensorSum sampling({{factor, y, x}});
  std::vector<double> values(sampling.output_size());
  sampling.apply(c, values);
  return values;
}

}  // namespace

Solution::Solution(const Rectangle& region, int degree, std::vector<double> coefficients)
    : region_(region), x_(region.x, degree), y_(region.y, degree), coefficients_(std::move(coefficients)) {
  if (degree < 1) throw InvalidInput("Solution: expected a degree of at least 1, found " + std::to_string(degree));
  const auto expected = static_cast<std::size_t>(x_.size()) * static_cast<std::size_t>(y_.size());
  if (coefficients_.size() != expected)
    throw InvalidInput("Solution: expected " + std::to_string(expected) + " coefficients, found " +
                       std::to_string(coefficients_.size()));
}

double Solution::derivative(double x, double y, int a, int b) const {
  if (!region_.contains(x, y)) return std::numeric_limits<double>::quiet_NaN();
  if (a > degree() || b > degree()) return 0;
  const auto nx = x_.at(region_.x.to_cells(x), a), ny = y_.at(region_.y.to_cells(y), b);
  double sum = 0;
  for (int j = 0; j <= degree(); ++j) {
    const double* row = coefficients_.data() + static_cast<std::ptrdiff_t>(ny.first + j) * x_.size() + nx.first;
    double line = 0;
    for (int i = 0; i <= degree(); ++i) line += nx.values[static_cast<std::size_t>(i)] * row[i];
    sum += ny.values[static_cast<std::size_t>(j)] * line;
  }
  return sum * std::pow(region_.x.finest_cells() / region_.x.length(), a) *
         std::pow(region_.y.finest_cells() / region_.y.length(), b);
}

GridSamples Solution::samples() const {
  const int nx = region_.x.cells(), ny = region_.y.cells();
  const double hx = region_.x.length() / nx, hy = region_.y.length() / ny;
  GridSamples result{{nx + 1, ny + 1}, {region_.x.lower(), region_.y.lower()}, {hx, hy}, {}};
  result.arrays.push_back({"value", 1, sampled(y_.samples(0), x_.samples(0), 1, coefficients_)});
  PointArray gradient{"gradient", 3, std::vector<double>(3 * result.arrays[0].values.size())};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto slope = axis == 0 ? sampled(y_.samples(0), x_.samples(1), 1 / hx, coefficients_)
                                 : sampled(y_.samples(1), x_.samples(0), 1 / hy, coefficients_);
    for (std::size_t i = 0; i < slope.size(); ++i) gradient.values[3 * i + axis] = slope[i];
  }
  result.arrays.push_back(std::move(gradient));
  return result;
}

Record Solution::to_record() const {
  Record record;
  record.kind = "surface";
  record.degree = degree();
  record.cells = {region_.x.cells(), region_.y.cells()};
  record.region = {region_.x.lower(), region_.x.upper(), region_.y.lower(), region_.y.upper()};
  record.arrays["coefficients"] = coefficients_;
  return record;
}

Solution Solution::from_record(const Record& record) {
  if (record.kind != "surface")
    throw InvalidInput("Solution::from_record: expected a result of kind \"surface\", found \"" + record.kind + "\"");
  const auto coefficients = record.arrays.find("coefficients");
  if (coefficients == record.arrays.end())
    throw InvalidInput("Solution::from_record: expected an array \"coefficients\", found none");
  const auto& r = record.region;
  return {{Interval(r[0], r[1], record.cells[0]), Interval(r[2], r[3], record.cells[1])},
          record.degree,
          coefficients->second};
}

}  // namespace batten
