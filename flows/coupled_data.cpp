// SPDX-License-Identifier: MIT
#include <batten/flows/coupled_data.h>

namespace batten {

CoupledData::CoupledData(const CoupledParts& parts, int level) : parts_(parts), level_(level) {}

void CoupledData::set(const PairWeights& weights, bool stored) {
  if (!own_psi_ || (stored && !own_psi_->is_stored())) {
    own_psi_.emplace(parts_.psi(level_).space, parts_.stream.points(), stored);
    own_phi_.emplace(parts_.phi(level_).space, parts_.potential.points(), stored);
  }
  own_psi_->set_weights(weights);
  own_phi_->set_weights(weights.scaled(parts_.factor));
  set_cross(weights, nullptr);
}

void CoupledData::share(const DataTerm& psi, const DataTerm& phi, const PairWeights& weights,
                        const CoupledData* finer) {
  own_psi_.reset();
  own_phi_.reset();
  shared_psi_ = &psi;
  shared_phi_ = &phi;
  set_cross(weights, finer);
}

void CoupledData::set_cross(const PairWeights& weights, const CoupledData* finer) {
  if (weights == weights_ && !cross_.is_empty()) return;
  weights_ = weights;
  cross_ = {};
  if (!is_stored()) return;
  if (finer && !finer->cross_.is_empty()) {
    cross_ = finer->cross_.galerkin(*parts_.psi(level_ - 1).restriction, *parts_.phi(level_ - 1).restriction);
    return;
  }
  CrossWeights factored{weights_.diagonal, {}};
  for (std::size_t i = 0; i < size(); ++i) factored.own[i] *= parts_.factor[i];
  for (std::size_t i = 0; weights_.are_paired() && i < size(); ++i)
    factored.beside.push_back(weights_.beside[i / 2] * parts_.factor[i % 2 == 0 ? i + 1 : i - 1]);
  cross_ = CrossStencil(parts_.psi(level_).space, psi(), phi(), factored);
}

std::vector<double> CoupledData::values(std::span<const double> c) const {
  std::vector<double> result(size()), more(size());
  psi().values(psi_of(c), result);
  phi().values(phi_of(c), more);
  for (std::size_t i = 0; i < size(); ++i) result[i] += parts_.factor[i] * more[i];
  return result;
}

void CoupledData::add_adjoint(std::span<const double> v, std::span<double> c) const {
  std::vector<double> factored(v.begin(), v.end());
  for (std::size_t i = 0; i < size(); ++i) factored[i] *= parts_.factor[i];
  psi().add_adjoint(v, psi_of(c));
  phi().add_adjoint(factored, phi_of(c));
}

void CoupledData::add_normal(double factor, std::span<const double> c, std::span<double> out) const {
  if (!is_stored()) {
    auto v = values(c);
    if (weights_.are_paired()) {
      weights_.multiply(v);
      for (double& force : v) force *= factor;
    } else {
      for (std::size_t i = 0; i < size(); ++i) v[i] *= factor * weights_.diagonal[i];
    }
    return add_adjoint(v, out);
  }
  psi().add_normal(factor, psi_of(c), psi_of(out));
  phi().add_normal(factor, phi_of(c), phi_of(out));
  add_cross(factor, c, out);
}

void CoupledData::add_cross(double factor, std::span<const double> c, std::span<double> out) const {
  if (is_stored()) {
    cross_.add_products(factor, psi_of(c), phi_of(c), psi_of(out), phi_of(out));
    fold_images(parts_.psi(level_).space, psi_of(out));
    return fold_images(parts_.phi(level_).space, phi_of(out));
  }
  std::vector<double> of_psi(size()), of_phi(size());
  psi().values(psi_of(c), of_psi);
  phi().values(phi_of(c), of_phi);
  multiply_cross(factor, of_psi, of_phi);
  psi().add_adjoint(of_phi, psi_of(out));
  phi().add_adjoint(of_psi, phi_of(out));
}

/// of_psi <- factor F W of_psi, of_phi <- factor W F of_phi
void CoupledData::multiply_cross(double factor, std::vector<double>& of_psi, std::vector<double>& of_phi) const {
  if (!weights_.are_paired()) {
    for (std::size_t i = 0; i < size(); ++i) {
      const double w = factor * weights_.diagonal[i] * parts_.factor[i];
      of_psi[i] *= w;
      of_phi[i] *= w;
    }
    return;
  }
  for (std::size_t i = 0; i < size(); ++i) of_phi[i] *= factor * parts_.factor[i];
  weights_.multiply(of_psi);
  weights_.multiply(of_phi);
  for (std::size_t i = 0; i < size(); ++i) of_psi[i] *= factor * parts_.factor[i];
}

std::vector<double> CoupledData::lumped() const {
  auto result = psi().lumped();
  const auto more = phi().lumped();
  result.insert(result.end(), more.begin(), more.end());
  if (is_stored())
    cross_.add_absolute_sums(psi_of(std::span(result)), phi_of(std::span(result)));
  else
    for (double& v : result) v *= 2;  // 2 a b <= a² + b²
  return result;
}

std::vector<double> CoupledData::compliance(std::span<const double> inverse) const {
  auto result = psi().compliance(psi_of(inverse));
  const auto more = phi().compliance(phi_of(inverse));
  for (std::size_t i = 0; i < size(); ++i) result[i] += parts_.factor[i] * parts_.factor[i] * more[i];
  return result;
}

Eigen::SparseMatrix<double> CoupledData::columns() const {
  const Eigen::SparseMatrix<double> of_psi = psi().columns(), of_phi = phi().columns();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(of_psi.nonZeros() + of_phi.nonZeros()));
  for (Eigen::Index i = 0; i < of_psi.outerSize(); ++i) {
    for (Eigen::SparseMatrix<double>::InnerIterator a(of_psi, i); a; ++a)
      entries.emplace_back(a.row(), static_cast<int>(i), a.value());
    for (Eigen::SparseMatrix<double>::InnerIterator b(of_phi, i); b; ++b)
      entries.emplace_back(of_psi.rows() + b.row(), static_cast<int>(i),
                           parts_.factor[static_cast<std::size_t>(i)] * b.value());
  }
  Eigen::SparseMatrix<double> result(of_psi.rows() + of_phi.rows(), of_psi.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace batten
