// SPDX-License-Identifier: MIT
#include <batten/bases/tensor_sum.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/null_space.h>
#include <batten/fem/rigid_motions.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double balance_tolerance = 1e-10;  // of Σ |b_i m_i|

double centred(const Interval& interval, double x) { return 2 * (x - interval.lower()) / interval.length() - 1; }

/// Rows that vanish on the motions that are left free.
class Conditions {
public:
  explicit Conditions(const BoundaryProblem& problem) : problem_(problem) {
    add_energy();
    add_side(problem.sides.left, -1, true);
    add_side(problem.sides.right, 1, true);
    add_side(problem.sides.bottom, -1, false);
    add_side(problem.sides.top, 1, false);
    for (const auto& p : problem.supports.points) add_value(p.x, p.y);
    for (const auto& line : problem.supports.lines) {
      add_value(line.from[0], line.from[1]);
      add_value(line.to[0], line.to[1]);
    }
  }

  /// Orthonormal columns that span the kernel.
  Eigen::MatrixXd kernel() const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()) + 3, 3);
    for (std::size_t i = 0; i < rows_.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = rows_[i];
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
    const Eigen::Index rank = (svd.singularValues().array() > 1e-9).count();
    return svd.matrixV().rightCols(3 - rank);
  }

private:
  void add_energy() {
    const auto gradient = [&] {
      rows_.emplace_back(0, 1, 0);
      rows_.emplace_back(0, 0, 1);
    };
    const auto* conduction = std::get_if<Conduction>(&problem_.material);
    const auto* plate = std::get_if<KirchhoffPlate>(&problem_.material);
    if (conduction || !plate->tension.is_zero()) gradient();
    if (!(conduction ? conduction->c : plate->foundation).is_zero()) {
      gradient();
      rows_.emplace_back(1, 0, 0);
    }
  }

  void add_side(const Side& side, double place, bool vertical) {
    if (side.periodic) rows_.emplace_back(0, vertical ? 1 : 0, vertical ? 0 : 1);
    if (side.normal && problem_.is_plate()) rows_.emplace_back(0, vertical ? 1 : 0, vertical ? 0 : 1);
    if (!side.value) return;
    rows_.emplace_back(1, vertical ? place : 0, vertical ? 0 : place);
    rows_.emplace_back(0, vertical ? 0 : 1, vertical ? 1 : 0);
  }

  void add_value(double x, double y) {
    rows_.emplace_back(1, centred(problem_.region.x, x), centred(problem_.region.y, y));
  }

  const BoundaryProblem& problem_;
  std::vector<Eigen::RowVector3d> rows_;
};

/// Coefficients of 1, s, t: columns.
Eigen::MatrixXd linear_functions(const SplineSpace& space) {
  const auto &x = space.x.interval(), &y = space.y.interval();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(space.size()), 3);
  const auto column = [&](Eigen::Index k) { return std::span(result.col(k).data(), space.size()); };
  LinearFunction{.a = 1}.add_to(space, column(0));
  LinearFunction{.b = 2 / x.length(), .x0 = (x.lower() + x.upper()) / 2}.add_to(space, column(1));
  LinearFunction{.c = 2 / y.length(), .y0 = (y.lower() + y.upper()) / 2}.add_to(space, column(2));
  return result;
}

}  // namespace

RigidMotions::RigidMotions(const BoundaryProblem& problem)
    : region_(problem.region),
      degree_(problem.degree),
      plate_(problem.is_plate()),
      motions_(Conditions(problem).kernel()) {}

std::vector<std::array<double, 2>> RigidMotions::pins() const {
  std::vector<Eigen::RowVector3d> candidates;
  for (const double t : {-0.6, 0., 0.6})
    for (const double s : {-0.6, 0., 0.6}) candidates.emplace_back(1, s, t);
  Eigen::MatrixXd values(candidates.size(), count());
  for (std::size_t i = 0; i < candidates.size(); ++i)
    values.row(static_cast<Eigen::Index>(i)) = candidates[i] * motions_;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(values.transpose());
  std::vector<std::array<double, 2>> result;
  for (int k = 0; k < count(); ++k) {
    const auto& c = candidates[static_cast<std::size_t>(qr.colsPermutation().indices()[k])];
    result.push_back({region_.x.lower() + region_.x.length() * (1 + c[1]) / 2,
                      region_.y.lower() + region_.y.length() * (1 + c[2]) / 2});
  }
  return result;
}

Eigen::MatrixXd RigidMotions::functions(const SplineSpace& space) const { return linear_functions(space) * motions_; }

void RigidMotions::expect_balanced(std::span<const double> b) const {
  if (count() == 0) return;
  const Eigen::Map<const Eigen::VectorXd> load(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::MatrixXd n = linear_functions(finest_space(region_, degree_));
  const Eigen::RowVector3d work = load.transpose() * n;
  const Eigen::RowVector3d size = load.cwiseAbs().transpose() * n.cwiseAbs();
  const Eigen::RowVectorXd free = work * motions_;
  if (free.cwiseAbs().maxCoeff() <= balance_tolerance * std::max(size.maxCoeff(), 1e-300)) return;
  if (!plate_)
    throw InvalidInput(
        "solve_boundary_problem: expected loads and fluxes that add up to 0, since no side or support fixes a value; "
        "found a sum of " +
        number_text(work[0], 6));
  throw InvalidInput(
      "solve_boundary_problem: expected balanced loads, since sides and supports leave the plate free to move; found a "
      "net force of " +
      number_text(work[0], 6) + " and moments about the centre of " + number_text(work[1] * region_.x.length() / 2, 6) +
      " (in x) and " + number_text(work[2] * region_.y.length() / 2, 6) + " (in y)");
}

void RigidMotions::remove_from(std::span<double> coefficients) const {
  if (count() == 0) return;
  Eigen::Map<Eigen::VectorXd> c(coefficients.data(), static_cast<Eigen::Index>(coefficients.size()));
  const SplineSpace space = finest_space(region_, degree_);
  const Eigen::MatrixXd m = functions(space);
  const TensorSum mass({{1., space.y.inner_products(0), space.x.inner_products(0)}});
  Eigen::MatrixXd product(m.rows(), m.cols());
  for (Eigen::Index k = 0; k < m.cols(); ++k)
    mass.apply({m.col(k).data(), coefficients.size()}, {product.col(k).data(), coefficients.size()});
  c -= m * (m.transpose() * product).ldlt().solve(product.transpose() * c);
}

}  // namespace batten
