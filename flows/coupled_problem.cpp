// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/flows/coupled_problem.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// What ψ is measured by, u = ψ_y and -v = ψ_x, of φ: φ_x and -φ_y.
FitData rows_of_potential(const FitData& stream) {
  FitData result = stream;
  for (Measured& kind : result.kind) kind = kind == Measured::SlopeY ? Measured::SlopeX : Measured::SlopeY;
  return result;
}

std::span<const double> first(std::span<const double> c) { return c.first(c.size() / 2); }
std::span<const double> second(std::span<const double> c) { return c.last(c.size() / 2); }
std::span<double> first(std::span<double> c) { return c.first(c.size() / 2); }
std::span<double> second(std::span<double> c) { return c.last(c.size() / 2); }

/// Entries of b in the coefficients of the coarsest level, a row of the dense B.
void add_row(const PointRow& row, int degree, int columns, double factor, Eigen::Index offset,
             std::vector<std::pair<Eigen::Index, double>>& entries) {
  for (int q = 0; q <= degree; ++q)
    for (int p = 0; p <= degree; ++p)
      entries.emplace_back(offset + static_cast<Eigen::Index>(row.first_y + q) * columns + row.first_x + p,
                           factor * row.y[static_cast<std::size_t>(q)] * row.x[static_cast<std::size_t>(p)]);
}

constexpr double coarse_shift = 1e-11;  // of the diagonal: the null space is left alone

}  // namespace

CoupledProblem::CoupledProblem(const FitData& rows, const Rectangle& region, const FitOptions& options, double ratio)
    : rows_(rows),
      options_(options),
      ratio_(ratio),
      potential_rows_(rows_of_potential(rows)),
      stream_(rows, region, options),
      potential_(potential_rows_, region, options),
      part_(stream_.system().size()) {
  for (const Measured kind : stream_.points().kind) sign_.push_back(kind == Measured::SlopeY ? 1 : -1);
  build_null_space();
  build_coarse_data();
}

void CoupledProblem::build_null_space() {
  const auto n = static_cast<Eigen::Index>(half());
  const auto &x = region().x, &y = region().y;
  null_space_ = Eigen::MatrixXd::Zero(2 * n, 6);
  const auto add = [&](Eigen::Index column, bool is_second, const std::array<double, 6>& c) {
    const QuadraticFunction q{c, x.lower() + x.length() / 2, y.lower() + y.length() / 2,
                              std::max(x.length(), y.length())};
    q.add_to(space(), {null_space_.col(column).data() + (is_second ? n : 0), half()});
  };
  add(0, false, {1, 0, 0, 0, 0, 0});
  add(1, true, {1, 0, 0, 0, 0, 0});
  for (std::size_t k = 0; k < harmonic_pairs.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k) + 2;
    add(column, true, harmonic_pairs[k].phi);
    null_space_.col(column) *= -1;
    add(column, false, harmonic_pairs[k].psi);
  }
  recombine(null_space_, orthonormalisation(tall_products(null_space_, null_space_)));
}

void CoupledProblem::build_coarse_data() {
  const auto& space = stream_.hierarchy()[stream_.hierarchy().size() - 1].space;
  const auto n = static_cast<Eigen::Index>(space.size());
  const DataTerm psi(space, stream_.points()), phi(space, potential_.points());
  coarse_data_ = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  std::vector<std::pair<Eigen::Index, double>> entries;
  for (std::size_t i = 0; i < size(); ++i) {
    entries.clear();
    add_row(psi.row(i), space.x.degree(), space.x.size(), 1, 0, entries);
    add_row(phi.row(i), space.x.degree(), space.x.size(), sign_[i], n, entries);
    for (const auto& [a, va] : entries)
      for (const auto& [b, vb] : entries) coarse_data_(b, a) += weight()[i] * va * vb;
  }
}

void CoupledProblem::set(double lambda) {
  stream_.set(lambda);
  potential_.set(ratio_ * lambda);
  const auto& level = stream_.hierarchy()[stream_.hierarchy().size() - 1];
  const int nx = level.space.x.size(), n = static_cast<int>(level.space.size()), d = level.space.x.degree();
  Eigen::MatrixXd matrix = coarse_data_;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (std::abs(a % nx - b % nx) > d || std::abs(a / nx - b / nx) > d) continue;
      const double entry = lambda * level.energy.entry(a % nx, a / nx, b % nx, b / nx);
      matrix(a, b) += entry;
      matrix(n + a, n + b) += ratio_ * entry;
    }
  matrix.diagonal() *= 1 + coarse_shift;
  coarse_.compute(matrix);
}

double CoupledProblem::apply(std::span<const double> c, std::span<double> out) const {
  stream_.apply(first(c), first(out));
  potential_.apply(second(c), second(out));
  std::vector<double> psi = stream_.values(first(c)), phi = potential_.values(second(c));
  for (std::size_t i = 0; i < size(); ++i) {
    psi[i] *= weight()[i] * sign_[i];
    phi[i] *= weight()[i] * sign_[i];
  }
  stream_.system().data().add_adjoint(phi, first(out));
  potential_.system().data().add_adjoint(psi, second(out));
  return dot(c, out);
}

/// R^T r on the coarsest level, of one of the two.
Eigen::VectorXd CoupledProblem::restricted(std::span<const double> r) const {
  std::vector<double> fine(r.begin(), r.end()), coarse;
  const Hierarchy& h = stream_.hierarchy();
  for (int k = 0; k + 1 < h.size(); ++k) {
    coarse.resize(h[k + 1].space.size());
    h.restrict_from(k, fine, coarse);
    std::swap(fine, coarse);
  }
  return Eigen::Map<const Eigen::VectorXd>(fine.data(), static_cast<Eigen::Index>(fine.size()));
}

void CoupledProblem::precondition(std::span<const double> r, std::vector<double>& out) const {
  out.resize(unknowns());
  Eigen::VectorXd coarse(coarse_data_.rows());
  coarse << restricted(first(r)), restricted(second(r));
  coarse = coarse_.solve(coarse);
  const Hierarchy& h = stream_.hierarchy();
  for (const bool is_second : {false, true}) {
    const auto half_r = is_second ? second(r) : first(r);
    const auto half_out = is_second ? second(std::span<double>(out)) : first(std::span<double>(out));
    const Eigen::VectorXd part = is_second ? coarse.tail(coarse.size() / 2) : coarse.head(coarse.size() / 2);
    std::vector<double> correction(part.begin(), part.end()), finer;
    for (int k = h.size() - 2; k >= 0; --k) {
      finer.resize(h[k].space.size());
      h[k].refinement->apply(correction, finer);
      std::swap(correction, finer);
    }
    (is_second ? potential_ : stream_).system().precondition(half_r, part_);
    for (std::size_t i = 0; i < half_out.size(); ++i) half_out[i] = part_[i] + correction[i];
  }
  Eigen::Map<Eigen::MatrixXd> result(out.data(), static_cast<Eigen::Index>(out.size()), 1);
  subtract_product(result, null_space_, tall_products(null_space_, result));
}

std::vector<double> CoupledProblem::right_side(std::span<const double> weights, std::span<const double> values) const {
  std::vector<double> signed_values(values.begin(), values.end());
  for (std::size_t i = 0; i < size(); ++i) signed_values[i] *= sign_[i];
  auto b = stream_.right_side(weights, values);
  const auto more = potential_.right_side(weights, signed_values);
  b.insert(b.end(), more.begin(), more.end());
  return b;
}

std::vector<double> CoupledProblem::values(std::span<const double> c) const {
  auto result = stream_.values(first(c));
  const auto more = potential_.values(second(c));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += sign_[i] * more[i];
  return result;
}

std::unique_ptr<PenalisedProblem> CoupledProblem::on(const Rectangle& grid) const {
  return std::make_unique<CoupledProblem>(rows_, grid, options_, ratio_);
}

}  // namespace batten
