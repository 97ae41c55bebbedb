// SPDX-License-Identifier: MIT
#include <batten/fem/balls.h>
#include <batten/fem/dense_energy.h>
#include <batten/fem/interior_point.h>
#include <batten/fem/line_within.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// Distance of the line from centre i, over the radius.
double miss(const LineGoals& goals, const std::vector<double>& line, std::size_t i) {
  const auto dimension = static_cast<std::size_t>(goals.dimension);
  double square = 0;
  for (std::size_t k = 0; k < dimension; ++k) {
    const double away = line[k] + goals.places[i] * line[dimension + k] - goals.centre[i * dimension + k];
    square += away * away;
  }
  return std::sqrt(square) / goals.radius[i];
}

/// The balls that a line misses most, of each of a few stretches one.
std::vector<std::size_t> most_missed(const LineGoals& goals, const std::vector<double>& line) {
  constexpr std::size_t stretches = 16;
  const std::size_t n = goals.radius.size();
  std::vector<std::size_t> worst;
  for (std::size_t s = 0; s < std::min(stretches, n); ++s) {
    const std::size_t end = (s + 1) * n / std::min(stretches, n);
    std::size_t found = s * n / std::min(stretches, n);
    double most = 0;
    for (std::size_t i = found; i < end; ++i)
      if (const double here = miss(goals, line, i); here > most) {
        most = here;
        found = i;
      }
    worst.push_back(found);
  }
  return worst;
}

double largest_miss(const LineGoals& goals, const std::vector<double>& line) {
  double most = 0;
  for (const std::size_t i : most_missed(goals, line)) most = std::max(most, miss(goals, line, i));
  return most;
}

struct NearestLine {
  std::vector<double> line;
  double least = 0;  ///< no line has a smaller largest miss
};

/// The line whose largest miss of the chosen balls is least. `unit`: about as large as that.
NearestLine nearest_line(const LineGoals& goals, const std::vector<std::size_t>& chosen, double unit) {
  constexpr double hardly_any = 1e-9, accuracy = 1e-6;
  const Eigen::Index dimension = goals.dimension, lines = goals.is_constant ? dimension : 2 * dimension;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(chosen.size()) * (dimension + 1), lines + 1);
  std::vector<double> centre;
  for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(chosen.size()); ++j) {
    const std::size_t i = chosen[static_cast<std::size_t>(j)];
    const double width = unit * goals.radius[i];
    rows(j * (dimension + 1), lines) = 1;
    for (Eigen::Index k = 0; k < dimension; ++k) {
      const Eigen::Index row = j * (dimension + 1) + 1 + k;
      rows(row, k) = 1 / width;
      if (!goals.is_constant) rows(row, dimension + k) = goals.places[i] / width;
      centre.push_back(goals.centre[i * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(k)] / width);
    }
  }
  // Least θ with |c(t_i) - centre_i| <= (1 + θ) unit radius_i.
  DenseEnergy energy(hardly_any * Eigen::MatrixXd::Identity(lines + 1, lines + 1),
                     -Eigen::VectorXd::Unit(lines + 1, lines), std::move(rows));
  Balls balls(std::move(centre), std::vector<double>(chosen.size(), 1.),
              {.dimension = goals.dimension, .is_elastic = true});
  balls.start(energy.values(), 1);
  InteriorPointOptions options;
  options.gap = accuracy;
  options.least_energy = 1;
  const InteriorPointResult result = minimise(energy, balls, options);
  NearestLine found;
  found.line.resize(2 * static_cast<std::size_t>(dimension));
  for (Eigen::Index k = 0; k < lines; ++k) found.line[static_cast<std::size_t>(k)] = energy.coefficients()[k];
  if (result.converged) found.least = unit * (1 + result.energy - 2 * accuracy);
  return found;
}

}  // namespace

// As in linear programming of few unknowns, few balls decide: those that are missed are added until no line is left or
// none is missed.
std::optional<std::vector<double>> line_within(const LineGoals& goals) {
  constexpr int most_rounds = 30;
  std::vector<double> line(2 * static_cast<std::size_t>(goals.dimension));
  const double unit = largest_miss(goals, line);
  double miss = unit;
  std::vector<std::size_t> chosen;
  for (int round = 0; round < most_rounds && miss > 1; ++round) {
    const std::size_t before = chosen.size();
    for (const std::size_t i : most_missed(goals, line))
      if (std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
    if (chosen.size() == before) return std::nullopt;
    NearestLine nearest = nearest_line(goals, chosen, unit);
    if (nearest.least > 1) return std::nullopt;
    line = std::move(nearest.line);
    miss = largest_miss(goals, line);
  }
  if (miss > 1) return std::nullopt;
  return line;
}

}  // namespace batten
