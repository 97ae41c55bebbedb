// SPDX-License-Identifier: MIT
#include <batten/fem/dense_energy.h>
#include <batten/fem/interior_point.h>
#include <batten/fem/null_element.h>

#include <limits>

namespace batten {

std::optional<Eigen::VectorXd> element_within(const Eigen::MatrixXd& rows, FeasibleSet& set) {
  constexpr double slight = 1e-8;  // an energy, so that there is one to be least
  const Eigen::MatrixXd products = rows.transpose().lazyProduct(rows);
  const double size = products.trace();
  DenseEnergy energy(slight * (products / size + Eigen::MatrixXd::Identity(products.rows(), products.cols())),
                     Eigen::VectorXd::Zero(products.rows()), rows);
  set.start(energy.values(), 1);
  InteriorPointOptions options;
  options.gap = std::numeric_limits<double>::infinity();  // the first that is within
  options.least_energy = 1;
  options.most_steps = 40;
  const auto found = minimise(energy, set, options);
  if (!found.converged) return std::nullopt;
  return energy.coefficients();
}

}  // namespace batten
