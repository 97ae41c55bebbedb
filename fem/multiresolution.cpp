// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/multiresolution.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace batten {

using Eigen::VectorXd;

Multiresolution::Multiresolution(const Eigen::SparseMatrix<double>& E, const std::vector<MeasurementMatrix::Matrix>& M)
    : E_(E) {
  if (M.empty()) throw InvalidInput("Multiresolution: expected at least one level of measurements, found none");
  for (std::size_t k = 0; k < M.size(); ++k) {
    const Eigen::Index above = k + 1 < M.size() ? M[k + 1].rows() : E_.rows();
    if (M[k].cols() != above)
      throw InvalidInput("Multiresolution: expected measurements of " + std::to_string(above) + " numbers on level " +
                         std::to_string(k) + ", found " + std::to_string(M[k].cols()));
  }
  MeasurementMatrix::Matrix chain = M.back();
  for (std::size_t k = M.size(); k-- > 0;) {
    if (k + 1 < M.size()) chain = MeasurementMatrix::Matrix(M[k] * chain);
    steps_.push_back({M[k], free_coefficients(M[k]), LeastEnergy(E_, chain)});
  }
  std::reverse(steps_.begin(), steps_.end());
}

/// v_k of q.
VectorXd Multiresolution::measurements(VectorXd q, int k) const {
  for (int l = levels(); l-- > k;) q = steps_[static_cast<std::size_t>(l)].M * q;
  return q;
}

/// v_{k+1} of q_k with measurements v, and a detail.
VectorXd Multiresolution::finer(const VectorXd& v, const VectorXd& detail, int k) const {
  const Step& step = steps_[static_cast<std::size_t>(k)];
  return measurements(step.least.apply(v), k + 1) + step.variables.Z * detail;
}

Multiresolution::Analysis Multiresolution::analyse(const VectorXd& q) const {
  Analysis result;
  VectorXd v = q;
  for (int k = levels(); k-- > 0;) {
    const Step& step = steps_[static_cast<std::size_t>(k)];
    const VectorXd coarse = step.M * v;
    const VectorXd r = v - measurements(step.least.apply(coarse), k + 1);
    result.details.push_back(r(step.variables.free));
    v = coarse;
  }
  std::reverse(result.details.begin(), result.details.end());
  result.coarse = v;
  return result;
}

VectorXd Multiresolution::approximation(const Analysis& analysis, int k) const {
  VectorXd v = analysis.coarse;
  for (int l = 0; l < k; ++l) v = finer(v, analysis.details[static_cast<std::size_t>(l)], l);
  return k == levels() ? v : steps_[static_cast<std::size_t>(k)].least.apply(v);
}

VectorXd Multiresolution::synthesise(const Analysis& analysis) const { return approximation(analysis, levels()); }

/// Of the least-energy function with measurements v on level k.
double Multiresolution::energy(const VectorXd& v, int k) const {
  const VectorXd q = k == levels() ? v : steps_[static_cast<std::size_t>(k)].least.apply(v);
  return q.dot(E_ * q);
}

std::vector<double> Multiresolution::energies(const Analysis& analysis) const {
  std::vector<double> result = {energy(analysis.coarse, 0)};
  for (int k = 0; k < levels(); ++k)
    result.push_back(
        energy(steps_[static_cast<std::size_t>(k)].variables.Z * analysis.details[static_cast<std::size_t>(k)], k + 1));
  return result;
}

Compression compress(const Multiresolution& multiresolution, const Multiresolution::Analysis& analysis,
                     double threshold) {
  Compression result{analysis, static_cast<std::size_t>(analysis.coarse.size()), 0};
  Multiresolution::Analysis left_out{VectorXd::Zero(analysis.coarse.size()), analysis.details};
  for (std::size_t k = 0; k < analysis.details.size(); ++k)
    for (Eigen::Index i = 0; i < analysis.details[k].size(); ++i) {
      const bool keep = std::abs(analysis.details[k][i]) >= threshold;
      (keep ? left_out : result.kept).details[k][i] = 0;
      result.numbers += keep ? 1 : 0;
    }
  const auto energies = multiresolution.energies(left_out);
  result.energy_error = std::accumulate(energies.begin(), energies.end(), 0.);
  return result;
}

}  // namespace batten
