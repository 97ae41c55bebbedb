// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/variational_scheme.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

std::size_t step_of(const EnergyLevels& levels, int k) {
  if (k < 0 || k >= levels.finest())
    throw InvalidInput("VariationalScheme: expected a step from 0 to " + std::to_string(levels.finest() - 1) +
                       ", found " + std::to_string(k));
  return static_cast<std::size_t>(k);
}

double largest(const Eigen::MatrixXd& m) { return m.size() == 0 ? 0 : m.cwiseAbs().maxCoeff(); }

void check_solvable(const EnergyLevels::Level& coarse, const EnergyLevels::Level& fine,
                    const Eigen::SparseMatrix<double>& M) {
  const Eigen::MatrixXd image = M * fine.null_space;
  const double energy = largest(coarse.E * image);
  const double size = coarse.E.coeffs().cwiseAbs().maxCoeff() * largest(image);
  if (!(energy <= 1e-9 * size))
    throw InvalidInput(
        "VariationalScheme: expected measurements that map the null space of the fine energy into that of the coarse "
        "one, found a relative energy of " +
        std::to_string(energy / size));
}

}  // namespace

std::vector<int> unisolvent_rows(const Eigen::MatrixXd& Z) {
  Eigen::MatrixXd rest = Z;
  std::vector<int> rows;
  for (Eigen::Index step = 0; step < Z.cols(); ++step) {
    Eigen::Index row = 0, column = 0;
    rest.cwiseAbs().maxCoeff(&row, &column);
    rows.push_back(static_cast<int>(row));
    const Eigen::RowVectorXd pivot = rest.row(row) / rest(row, column);
    rest -= (rest.col(column) * pivot).eval();
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

Eigen::SparseMatrix<double> lower_submatrix(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& kept) {
  std::vector<int> number(static_cast<std::size_t>(matrix.rows()), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) number[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index c = 0; c < matrix.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator e(matrix, c); e; ++e) {
      const int i = number[static_cast<std::size_t>(e.row())], j = number[static_cast<std::size_t>(e.col())];
      if (i >= 0 && j >= 0 && i >= j) entries.emplace_back(i, j, e.value());
    }
  Eigen::SparseMatrix<double> result(static_cast<Eigen::Index>(kept.size()), static_cast<Eigen::Index>(kept.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

VariationalScheme::VariationalScheme(const EnergyLevels& levels, int k, const NullSpaceRule& rule) {
  const std::size_t step = step_of(levels, k);
  const auto &coarse = levels.levels[step], &fine = levels.levels[step + 1];
  const auto& M = levels.steps[step].M;
  check_solvable(coarse, fine, M);
  E_ = fine.E;
  Z_ = fine.null_space;
  right_ = M.transpose() * coarse.E;
  if (rule.interpolated.empty()) {
    functionals_ = fine.weights;
    targets_ = coarse.weights;
  } else {
    functionals_ = targets_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rule.interpolated.size()), columns());
    for (std::size_t i = 0; i < rule.interpolated.size(); ++i) {
      const int j = rule.interpolated[i];
      if (j < 0 || j >= columns())
        throw InvalidInput("VariationalScheme: expected places to interpolate from 0 to " +
                           std::to_string(columns() - 1) + ", found " + std::to_string(j));
      targets_(static_cast<Eigen::Index>(i), j) = 1;
    }
    functionals_ = targets_ * M;
  }
  const Eigen::MatrixXd square = functionals_ * Z_;
  const bool fits = square.rows() == square.cols();
  const Eigen::VectorXd singular =
      fits ? Eigen::JacobiSVD<Eigen::MatrixXd>(square).singularValues() : Eigen::VectorXd();
  if (!fits || !(singular.tail(1)[0] > 1e-12 * singular[0]))
    throw InvalidInput("VariationalScheme: expected " + std::to_string(Z_.cols()) +
                       " independent weights or interpolated places to fix the null space, found " +
                       std::to_string(functionals_.rows()) + (fits ? " that depend on each other on it" : ""));
  inverse_ = square.inverse();
  const auto held = unisolvent_rows(Z_);
  for (int i = 0; i < rows(); ++i)
    if (!std::binary_search(held.begin(), held.end(), i)) free_.push_back(i);
  factor_ = std::make_shared<const SparseCholesky>(lower_submatrix(E_, free_));
}

/// A solution of E x = f for f without work on the null space, then once more for what rounding left of f.
Eigen::VectorXd VariationalScheme::solve(Eigen::VectorXd f) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(rows());
  std::vector<double> b(free_.size());
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = f[free_[i]];
    factor_->solve(b);
    Eigen::VectorXd dx = Eigen::VectorXd::Zero(rows());
    for (std::size_t i = 0; i < b.size(); ++i) dx[free_[i]] = b[i];
    x += dx;
    f -= E_ * dx;
  }
  return x;
}

Eigen::VectorXd VariationalScheme::apply(const Eigen::VectorXd& p) const {
  const Eigen::VectorXd x = solve(right_ * p);
  return x + Z_ * (inverse_ * (targets_ * p - functionals_ * x));
}

/// S = (I - Z A F) G (U E) + Z A T with A = inverse_, F = functionals_, T = targets_, G the symmetric solve.
Eigen::VectorXd VariationalScheme::apply_transposed(const Eigen::VectorXd& q) const {
  const Eigen::VectorXd multipliers = inverse_.transpose() * (Z_.transpose() * q);
  return right_.transpose() * solve(q - functionals_.transpose() * multipliers) + targets_.transpose() * multipliers;
}

Eigen::MatrixXd VariationalScheme::matrix() const {
  Eigen::MatrixXd result(rows(), columns());
  for (int j = 0; j < columns(); ++j) result.col(j) = column(j);
  return result;
}

std::vector<Eigen::VectorXd> subdivided(const std::vector<VariationalScheme>& schemes, const Eigen::VectorXd& p0) {
  std::vector<Eigen::VectorXd> result = {p0};
  for (const auto& S : schemes) result.push_back(S.apply(result.back()));
  return result;
}

Eigen::VectorXd measured_on_coarsest(const EnergyLevels& levels, int k, Eigen::VectorXd p) {
  while (k-- > 0) p = levels.steps[static_cast<std::size_t>(k)].M * p;
  return p;
}

}  // namespace batten
