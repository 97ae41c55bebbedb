// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/fem/block_vectors.h>
#include <batten/flows/coupled_problem.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// What a row measures besides the slope of ψ: in u = ψ_y + φ_x / c this factor of φ_x, in -c v = ψ_x - c φ_y of φ_y.
double factor_of(const FlowData& data, std::size_t row) {
  return data.rows.kind[row] == Measured::SlopeY ? 1 / data.stretch[row] : -data.stretch[row];
}

/// The slopes of φ in the rows of ψ.
FitData rows_of_potential(const FlowData& data) {
  FitData result = data.rows;
  for (std::size_t i = 0; i < result.size(); ++i) {
    Measured& kind = result.kind[i];
    kind = kind == Measured::SlopeY ? Measured::SlopeX : Measured::SlopeY;
    result.weight[i] *= factor_of(data, i) * factor_of(data, i);
  }
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
constexpr double unseen_part = 1e-9;    // of what the data see best, farther above the shift than rounding

}  // namespace

CoupledProblem::CoupledProblem(const FlowData& data, const Rectangle& region, const FitOptions& options,
                               const FlowOptions& flow)
    : data_(data),
      options_(options),
      flow_(flow),
      potential_rows_(rows_of_potential(data)),
      stream_(data.rows, region, options),
      potential_(potential_rows_, region, options),
      part_(stream_.system().size()) {
  for (const std::size_t row : stream_.order()) factor_.push_back(factor_of(data, row));
  build_null_space();
  build_coarse_data();
}

void CoupledProblem::build_null_space() {
  const auto n = static_cast<Eigen::Index>(half());
  const auto &x = region().x, &y = region().y;
  const auto quadratic = [&](bool is_second, const std::array<double, 6>& c) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(2 * n);
    const QuadraticFunction q{c, x.lower() + x.length() / 2, y.lower() + y.length() / 2,
                              std::max(x.length(), y.length())};
    q.add_to(space(), {column.data() + (is_second ? n : 0), half()});
    return column;
  };
  std::vector<Eigen::VectorXd> columns;
  if (flow_.geographic) {
    for (std::size_t k = 0; k < 12; ++k) {
      std::array<double, 6> c{};
      c[k % 6] = 1;
      columns.push_back(quadratic(k >= 6, c));
    }
  } else {
    columns = {quadratic(false, {1, 0, 0, 0, 0, 0}), quadratic(true, {1, 0, 0, 0, 0, 0})};
    for (const HarmonicPair& pair : harmonic_pairs)
      columns.emplace_back(quadratic(false, pair.psi) - quadratic(true, pair.phi));
  }
  null_space_.resize(2 * n, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) null_space_.col(static_cast<Eigen::Index>(k)) = columns[k];
  recombine(null_space_, orthonormalisation(tall_products(null_space_, null_space_)));
  if (flow_.geographic) keep_unseen();
}

/// Of the quadratics those that the data hardly see.
void CoupledProblem::keep_unseen() {
  Eigen::MatrixXd seen(static_cast<Eigen::Index>(size()), null_space_.cols());
  for (Eigen::Index k = 0; k < null_space_.cols(); ++k) {
    const auto measured = values({null_space_.col(k).data(), unknowns()});
    for (std::size_t i = 0; i < size(); ++i)
      seen(static_cast<Eigen::Index>(i), k) = std::sqrt(weight()[i]) * measured[i];
  }
  const SymmetricEigensystem parts = symmetric_eigensystem(seen.transpose() * seen);
  const double largest = parts.values.maxCoeff();
  const auto unseen = (parts.values.array() <= unseen_part * largest).count();  // the first ones
  null_space_ = (null_space_ * parts.vectors.leftCols(unseen)).eval();
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
    add_row(phi.row(i), space.x.degree(), space.x.size(), factor_[i], n, entries);
    for (const auto& [a, va] : entries)
      for (const auto& [b, vb] : entries) coarse_data_(b, a) += weight()[i] * va * vb;
  }
}

void CoupledProblem::set(double lambda) {
  stream_.set(lambda);
  potential_.set(flow_.ratio * lambda);
  const auto& level = stream_.hierarchy()[stream_.hierarchy().size() - 1];
  const int nx = level.space.x.size(), n = static_cast<int>(level.space.size()), d = level.space.x.degree();
  Eigen::MatrixXd matrix = coarse_data_;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (std::abs(a % nx - b % nx) > d || std::abs(a / nx - b / nx) > d) continue;
      const double entry = lambda * level.energy.entry(a % nx, a / nx, b % nx, b / nx);
      matrix(a, b) += entry;
      matrix(n + a, n + b) += flow_.ratio * entry;
    }
  matrix.diagonal() *= 1 + coarse_shift;
  coarse_.compute(matrix);
}

double CoupledProblem::apply(std::span<const double> c, std::span<double> out) const {
  stream_.apply(first(c), first(out));
  potential_.apply(second(c), second(out));
  std::vector<double> psi = stream_.values(first(c)), phi = potential_.values(second(c));
  for (std::size_t i = 0; i < size(); ++i) {
    psi[i] *= weight()[i] * factor_[i];
    phi[i] *= weight()[i] * factor_[i];
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

void CoupledProblem::precondition(std::span<const double> residual, std::vector<double>& out) const {
  out.resize(unknowns());
  // What the data hardly see is no exact element of the null space, and the residual has a part of it.
  Eigen::MatrixXd seen = Eigen::Map<const Eigen::VectorXd>(residual.data(), static_cast<Eigen::Index>(residual.size()));
  if (flow_.geographic) subtract_product(seen, null_space_, tall_products(null_space_, seen));
  const std::span<const double> r(seen.data(), residual.size());
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
  std::vector<double> factored(values.begin(), values.end());
  for (std::size_t i = 0; i < size(); ++i) factored[i] *= factor_[i];
  auto b = stream_.right_side(weights, values);
  const auto more = potential_.right_side(weights, factored);
  b.insert(b.end(), more.begin(), more.end());
  return b;
}

std::vector<double> CoupledProblem::values(std::span<const double> c) const {
  auto result = stream_.values(first(c));
  const auto more = potential_.values(second(c));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += factor_[i] * more[i];
  return result;
}

std::unique_ptr<PenalisedProblem> CoupledProblem::on(const Rectangle& grid) const {
  return std::make_unique<CoupledProblem>(data_, grid, options_, flow_);
}

}  // namespace batten
