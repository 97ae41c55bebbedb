// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/lowest_eigenpairs.h>
#include <batten/fem/mass.h>
#include <batten/fem/random_signs.h>
#include <batten/fem/rigid_motions.h>
#include <batten/fem/support_points.h>
#include <batten/fem/support_projection.h>
#include <batten/fem/vibration.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Vector = std::vector<double>;

/// Loads, and what supports prescribe, play no part.
BoundaryProblem homogeneous(BoundaryProblem problem) {
  problem.loads = {};
  for (auto& p : problem.supports.points) p.value = 0;
  for (auto& line : problem.supports.lines) line.value = 0.;
  return problem;
}

/// The geometric mean of a coefficient over the rectangle.
double typical(const Field& f, const Rectangle& region) {
  constexpr int samples = 8;
  double sum = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i)
      sum += std::log(f(region.x.lower() + region.x.length() * (i + 0.5) / samples,
                        region.y.lower() + region.y.length() * (j + 0.5) / samples));
  return std::exp(sum / (samples * samples));
}

/// Where motions without energy make A singular, A + shift M is taken in its place. The shift is about the lowest
/// eigenvalue that is not 0, so that relative accuracy is kept and the motions are no longer nearly singular.
double shift_of(const BoundaryProblem& problem, const RigidMotions& motions, const Field& density) {
  if (motions.count() == 0) return 0;
  const double wave = std::pow(std::numbers::pi / std::max(problem.region.x.length(), problem.region.y.length()), 2);
  const auto* plate = std::get_if<KirchhoffPlate>(&problem.material);
  const double stiffness = plate ? typical(plate->rigidity, problem.region) * wave * wave
                                 : typical(std::get<Conduction>(problem.material).k, problem.region) * wave;
  const double shift = stiffness / typical(density, problem.region);
  return std::isfinite(shift) ? shift : 0;  // a coefficient out of range is refused where it is integrated
}

void clear_removed(const SplineSpace& space, std::span<double> v) {
  const int nx = space.x.size();
  for (int j = 0; j < space.y.size(); ++j)
    for (int i = 0; i < nx; ++i)
      if (space.is_removed(i, j)) v[static_cast<std::size_t>(j) * nx + i] = 0;
}

std::span<double> column(MatrixXd& a, Index k) { return {a.data() + k * a.rows(), static_cast<std::size_t>(a.rows())}; }

std::vector<Mass> masses(const Mass& finest, const Hierarchy& hierarchy) {
  std::vector<Mass> result = {finest};
  for (int k = 1; k < hierarchy.size(); ++k) result.push_back(result.back().coarser(hierarchy[k - 1], hierarchy[k]));
  return result;
}

class VibrationSolve {
public:
  VibrationSolve(const BoundaryProblem& problem, int count, const Field& density, const BoundarySolveOptions& options);
  Vibration run();

private:
  /// Rigid motions on a level.
  struct Motions {
    MatrixXd q, mq;  ///< Q^T M Q = I, and M Q
  };
  Motions motions_on(int level) const;
  EigenProblem problem_on(int level, const Motions& motions) const;
  int first_level(Index block) const;
  MatrixXd random_start(int level, Index block, const EigenProblem& problem) const;
  Eigenpairs elastic_modes(const Motions& finest, int wanted, Vibration& result) const;
  MatrixXd refined(const MatrixXd& coarse, int level, const Motions& motions) const;
  void into_space(std::span<double> v, int level, const Motions& motions) const;
  Mode mode(const MatrixXd& vectors, Index k, double residual) const;

  BoundaryProblem problem_;
  int count_;
  const BoundarySolveOptions& options_;
  RigidMotions motions_;
  SupportPoints supports_;
  Mass finest_mass_;
  double shift_;
  BoundarySystem system_;  // of A + shift M
  SupportProjection projection_;
  std::vector<Mass> mass_;
};

VibrationSolve::VibrationSolve(const BoundaryProblem& problem, int count, const Field& density,
                               const BoundarySolveOptions& options)
    : problem_(homogeneous(problem)),
      count_(count),
      options_(options),
      motions_(problem_),
      supports_(support_points(problem_, {})),
      finest_mass_(problem_, density),
      shift_(shift_of(problem_, motions_, density)),
      system_(problem_, density.affine(shift_), supports_.constraints),
      projection_(system_),
      mass_(masses(finest_mass_, system_.hierarchy())) {
  const auto unknowns = system_.space().kept(), held = supports_.constraints.size();
  const auto most = (unknowns - std::min(unknowns, held)) / 8;
  if (count < 1 || static_cast<std::size_t>(count) > most)
    throw InvalidInput("vibration_modes: expected a count from 1 to " + std::to_string(most) +
                       ", an eighth of the number of unknowns, found " + std::to_string(count));
}

VibrationSolve::Motions VibrationSolve::motions_on(int level) const {
  const auto& space = system_.hierarchy()[level].space;
  Motions result{motions_.functions(space), MatrixXd(static_cast<Index>(space.size()), motions_.count())};
  for (Index k = 0; k < result.q.cols(); ++k) {
    clear_removed(space, column(result.q, k));
    fill_images(space, column(result.q, k));
    mass_[static_cast<std::size_t>(level)].apply(column(result.q, k), column(result.mq, k));
  }
  const Eigen::LLT<MatrixXd> gram(tall_products(result.q, result.mq));
  for (auto* a : {&result.q, &result.mq}) gram.matrixU().solveInPlace<Eigen::OnTheRight>(*a);
  return result;
}

/// Onto the functions that vanish at the supports and are orthogonal to the motions.
void VibrationSolve::into_space(std::span<double> v, int level, const Motions& motions) const {
  if (level == 0) projection_.project(v);
  if (motions.q.cols() == 0) return;
  Eigen::Map<MatrixXd> column(v.data(), static_cast<Index>(v.size()), 1);
  subtract_product(column, motions.q, tall_products(motions.mq, column));
}

/// Coarse levels only prepare a start: there springs hold the supports.
EigenProblem VibrationSolve::problem_on(int level, const Motions& motions) const {
  const auto k = static_cast<std::size_t>(level);
  const auto& multigrid = system_.multigrid();
  EigenProblem result;
  result.stiffness = [&, k](std::span<const double> v, std::span<double> out) {
    if (k == 0)
      system_.hierarchy().finest().energy.apply(v, out);
    else
      multigrid.apply(v, out, k);
  };
  result.mass = [&, k](std::span<const double> v, std::span<double> out) { mass_[k].apply(v, out); };
  result.precondition = [&, level, k, r = Vector(), z = Vector()](std::span<const double> in,
                                                                  std::span<double> out) mutable {
    r.assign(in.begin(), in.end());
    if (k == 0) projection_.project_transposed(r);
    multigrid.precondition(r, z, k);
    std::copy(z.begin(), z.end(), out.begin());
    into_space(out, level, motions);
  };
  return result;
}

/// The coarsest level with room for the block, its residuals and directions.
int VibrationSolve::first_level(Index block) const {
  const auto& h = system_.hierarchy();
  int level = h.size() - 1;
  while (level > 0 && h[level].space.kept() < static_cast<std::size_t>(5 * block)) --level;
  return level;
}

MatrixXd VibrationSolve::random_start(int level, Index block, const EigenProblem& problem) const {
  const auto& space = system_.hierarchy()[level].space;
  MatrixXd result(static_cast<Index>(space.size()), block);
  for (Index k = 0; k < block; ++k) {
    auto signs = random_signs(space.size(), 1, static_cast<std::uint64_t>(k));
    clear_removed(space, signs);
    problem.precondition(signs, column(result, k));
  }
  return result;
}

MatrixXd VibrationSolve::refined(const MatrixXd& coarse, int level, const Motions& motions) const {
  const auto& fine = system_.hierarchy()[level];
  MatrixXd result(static_cast<Index>(fine.space.size()), coarse.cols());
  for (Index k = 0; k < coarse.cols(); ++k) {
    fine.refinement->apply({coarse.data() + k * coarse.rows(), static_cast<std::size_t>(coarse.rows())},
                           column(result, k));
    into_space(column(result, k), level, motions);
  }
  return result;
}

/// From the coarsest level upwards: the modes of each one start the next.
Eigenpairs VibrationSolve::elastic_modes(const Motions& finest, int wanted, Vibration& result) const {
  constexpr double coarse_accuracy = 1e-4;
  constexpr double caution = 0.01;  // the estimate is too low by what the V-cycle lacks of an inverse
  const auto& h = system_.hierarchy();
  const auto room = static_cast<int>((h.finest().space.kept() - supports_.constraints.size()) / 4);
  const Index block = std::min(wanted + std::max(3, wanted / 4), std::max(room, wanted));
  Eigenpairs pairs;
  double cycles = 0;
  for (int first = first_level(block), level = first; level >= 0; --level) {
    const Motions motions = level == 0 ? finest : motions_on(level);
    const EigenProblem problem = problem_on(level, motions);
    EigenOptions limits{wanted, caution * options_.limits.accuracy, shift_, options_.limits.most_iterations, {}};
    if (level > 0) limits.accuracy = std::max(limits.accuracy, coarse_accuracy);
    if (options_.progress)
      limits.progress = [&](double worst) {
        const double part = std::clamp(std::log(worst) / std::log(limits.accuracy), 0., 1.);
        options_.progress("modes", (first - level + part) / (first + 1));
      };
    pairs = lowest_eigenpairs(
        problem, level == first ? random_start(level, block, problem) : refined(pairs.vectors, level, motions), limits);
    cycles += pairs.preconditionings * static_cast<double>(h[level].space.size()) /
              static_cast<double>(h.finest().space.size());
  }
  result.iterations = pairs.iterations;
  result.cycles = static_cast<int>(std::ceil(cycles));
  return pairs;
}

/// The eigenvalue is Rayleigh's quotient; with constant coefficients its energy is taken from differences, since that
/// of a plate on a fine grid drowns in the rounding of x·A x.
Mode VibrationSolve::mode(const MatrixXd& vectors, Index k, double residual) const {
  const Vector x(vectors.col(k).begin(), vectors.col(k).end());
  const auto& energy = system_.hierarchy().finest().energy;
  Vector whole = system_.whole(x), product(x.size());
  mass_.front().apply(x, product);
  const double square = dot(x, product);
  double stored = 0;
  if (energy.stencil()) {
    energy.apply(x, product);
    stored = dot(x, product);
  } else {
    stored = evaluate_energy(system_.hierarchy().energy(), finest_space(problem_.region, problem_.degree), whole);
  }
  const auto size = [](double c) { return std::abs(c); };
  const double largest = std::abs(*std::ranges::max_element(whole, {}, size));
  // Of an odd mode, the first of its largest coefficients: which one is larger is rounding.
  const double first = *std::ranges::find_if(whole, [&](double c) { return std::abs(c) > (1 - 1e-6) * largest; });
  const double factor = std::copysign(1 / std::sqrt(square), first);
  for (double& c : whole) c *= factor;
  return {stored / square - shift_, Solution(problem_.region, problem_.degree, std::move(whole)), residual};
}

Vibration VibrationSolve::run() {
  Vibration result;
  result.unknowns = system_.space().kept();
  const Motions motions = motions_on(0);
  for (Index k = 0; k < std::min<Index>(count_, motions.q.cols()); ++k) {
    result.modes.push_back(mode(motions.q, k, 0));
    result.modes.back().eigenvalue = 0;
  }
  const int wanted = count_ - static_cast<int>(result.modes.size());
  if (wanted > 0) {
    const Eigenpairs pairs = elastic_modes(motions, wanted, result);
    std::vector<Mode> elastic;
    for (Index k = 0; k < wanted; ++k) elastic.push_back(mode(pairs.vectors, k, pairs.errors[k]));
    std::ranges::stable_sort(elastic, {}, &Mode::eigenvalue);
    std::ranges::move(elastic, std::back_inserter(result.modes));
  }
  return result;
}

}  // namespace

Vibration vibration(const BoundaryProblem& problem, int count, const Field& density,
                    const BoundarySolveOptions& options) {
  std::vector<PhaseTime> seconds;
  auto result = timed(seconds, "modes", [&] { return VibrationSolve(problem, count, density, options).run(); });
  result.seconds = std::move(seconds);
  return result;
}

std::vector<Mode> vibration_modes(const BoundaryProblem& problem, int count, const Field& density,
                                  const BoundarySolveOptions& options) {
  return vibration(problem, count, density, options).modes;
}

}  // namespace batten
