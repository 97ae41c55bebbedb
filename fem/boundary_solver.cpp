// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/boundary_solver.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/load_vector.h>
#include <batten/fem/rigid_motions.h>
#include <batten/fem/side_data.h>
#include <batten/fem/support_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace batten {
namespace {

using Vector = std::vector<double>;

/// The problem in its discrete form, and its solution while it is found.
class BoundarySolve {
public:
  BoundarySolve(const BoundaryProblem& problem, const BoundarySolveOptions& options)
      : problem_(problem),
        options_(options),
        motions_(problem),
        supports_(support_points(problem, motions_.pins())),
        load_(load_vector(problem)) {
    motions_.expect_balanced(load_);
  }

  BoundaryResult run();

private:
  template <typename Work>
  void run_phase(const std::string& phase, Work&& work) {
    if (options_.progress) options_.progress(phase, 0);
    timed(seconds_, phase, work);
  }
  void set_residual(Vector& r);
  void set_homogeneous_part(const Vector& v);
  void iterate();
  void measure(BoundaryResult& result);

  const BoundaryProblem& problem_;
  const BoundarySolveOptions& options_;
  RigidMotions motions_;
  SupportPoints supports_;
  Vector load_;      // b of all splines
  Lifting lifting_;  // g
  std::optional<BoundarySystem> system_;
  Vector solution_;      // whole coefficients of u
  Vector force_of_all_;  // b - A u of all splines
  Vector force_;         // of the supports on u, in the order of the system's points
  IterationResult iterations_;
  std::vector<PhaseTime> seconds_;
};

bool has_side_data(const Sides& sides) {
  const auto prescribes = [](const std::optional<Field>& data) { return data && !data->is_zero(); };
  return std::ranges::any_of(std::array{&sides.left, &sides.right, &sides.bottom, &sides.top},
                             [&](const Side* s) { return prescribes(s->value) || prescribes(s->normal); });
}

/// u = g + v
void BoundarySolve::set_homogeneous_part(const Vector& v) {
  solution_.assign(v.begin(), v.end());
  to_unconstrained(system_->space(), solution_);
  if (!lifting_.coefficients.empty()) combine(1, lifting_.coefficients, 1, solution_);
}

/// b - A u of the splines that keep the conditions.
void BoundarySolve::set_residual(Vector& r) {
  if (solution_.empty()) {
    r = system_->restricted(load_, std::move(r));
    return;
  }
  force_of_all_ = system_->apply_whole(solution_, std::move(force_of_all_));
  combine(1, load_, -1, force_of_all_);
  r = system_->restricted(force_of_all_, std::move(r));
}

/// What V-cycles for a plate with constant coefficients are asked for before corrections follow: rounding ends them at
/// 3e-11, 3e-10 and 2e-9 on 512^2, 1024^2 and 2048^2 cells, about 1e-3 ε n^1.5, and each gains a factor of 50.
double accuracy_above_rounding(double unknowns) {
  return 0.1 * std::numeric_limits<double>::epsilon() * std::pow(unknowns, 1.5);
}

/// Each step finds the correction that the residual asks for, formed anew with all its digits, and that the springs ask
/// for, whose forces add up (the method of multipliers). One V-cycle finds it as long as V-cycles alone converge well.
/// Membranes without supports are done after the first step.
void BoundarySolve::iterate() {
  constexpr double correction_accuracy = 1e-4;  // of itself: what the springs gain in a step
  constexpr double fast = 0.25;                 // of the error is left by a V-cycle at most
  const auto& multigrid = system_->multigrid();
  const auto& data = multigrid.data();
  const bool is_plate = problem_.is_plate(), streams = multigrid.streamed() && !multigrid.null_projection();
  const int most_steps = data.size() == 0 && !is_plate ? 1 : 8;
  Vector v(multigrid.size()), step, r, pull(data.size());
  if (!lifting_.coefficients.empty() || data.size() > 0) set_homogeneous_part(v);
  const Vector target = data.size() > 0 ? missing_values(supports_.constraints, system_->order(),
                                                         Solution(problem_.region, problem_.degree, solution_))
                                        : Vector();
  Vector miss = target;
  force_.assign(data.size(), 0.);
  double before = std::numeric_limits<double>::infinity();
  bool was_cycle = false;
  double scale = 0;  // energy norm of the solution: accuracies are relative to it
  for (int k = 0; k < most_steps; ++k) {
    set_residual(r);
    for (std::size_t i = 0; i < pull.size(); ++i) pull[i] = force_[i] + data.weights().diagonal[i] * miss[i];
    data.add_adjoint(pull, r);
    IterationLimits limits = options_.limits;
    if (k == 0) {
      if (is_plate && streams)
        limits.accuracy = std::max(limits.accuracy, accuracy_above_rounding(static_cast<double>(v.size())));
      iterations_ = solve(multigrid, r, v, limits);
      scale = std::sqrt(data.size() == 0 ? std::max(0., dot(v, r)) : dot(v, system_->apply(v)));
    } else {
      multigrid.precondition(r, step);
      const double size = std::sqrt(std::abs(dot(r, step)));  // rounding can make r·Br negative
      iterations_.accuracy = size / scale;
      if (iterations_.accuracy <= limits.accuracy || (size > before / 2 && !was_cycle)) break;
      was_cycle = streams && size <= fast * before;
      if (was_cycle) {
        ++iterations_.iterations;
      } else {
        limits.accuracy = std::max(limits.accuracy, correction_accuracy) * iterations_.accuracy;
        std::fill(step.begin(), step.end(), 0.);
        const auto found = solve(multigrid, r, step, limits, scale);
        iterations_.iterations += found.iterations;
        iterations_.accuracy = found.accuracy;
      }
      before = size;
      combine(1, step, 1, v);
    }
    set_homogeneous_part(v);
    data.values(v, miss);
    for (std::size_t i = 0; i < miss.size(); ++i) {
      miss[i] = target[i] - miss[i];
      force_[i] += data.weights().diagonal[i] * miss[i];
    }
    if (options_.progress) options_.progress("solve", (k + 1.) / most_steps);
  }
}

/// The forces that keep the conditions of the sides: the residual A u - b of all splines is the force on each function.
/// A function held by two sides counts half for each.
std::array<double, 4> side_reactions(const BoundaryProblem& problem, const SplineSpace& space, const Vector& residual) {
  const int nx = space.x.size(), ny = space.y.size();
  const auto held = [&](const Side& side, int from_side) {
    return side.value && from_side <= (problem.is_plate() && side.normal ? 1 : 0);
  };
  const auto& s = problem.sides;
  std::array<double, 4> result{};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      if (i > 1 && i < nx - 2 && j > 1 && j < ny - 2) continue;
      const std::array<bool, 4> by = {held(s.left, i), held(s.right, nx - 1 - i), held(s.bottom, j),
                                      held(s.top, ny - 1 - j)};
      const auto holders = std::count(by.begin(), by.end(), true);
      for (std::size_t k = 0; k < 4; ++k)
        if (by[k]) result[k] += residual[static_cast<std::size_t>(j) * nx + i] / static_cast<double>(holders);
    }
  return result;
}

void BoundarySolve::measure(BoundaryResult& result) {
  Vector au = system_->apply_whole(solution_, std::move(force_of_all_));
  result.energy = dot(solution_, au);
  result.compliance = dot(solution_, load_);
  combine(-1, load_, 1, au);
  result.side_reactions = side_reactions(problem_, system_->space(), au);
  const std::size_t points = problem_.supports.points.size(), lines = problem_.supports.lines.size();
  Vector reactions(points + lines + static_cast<std::size_t>(motions_.count()));
  for (std::size_t i = 0; i < force_.size(); ++i) reactions[supports_.owner[system_->order()[i]]] += force_[i];
  const auto line = reactions.begin() + static_cast<std::ptrdiff_t>(points);
  result.point_reactions.assign(reactions.begin(), line);
  result.line_reactions.assign(line, line + static_cast<std::ptrdiff_t>(lines));
}

BoundaryResult BoundarySolve::run() {
  run_phase("assemble", [&] {
    system_.emplace(problem_, 0., supports_.constraints);
    if (has_side_data(problem_.sides)) lifting_ = lifting(problem_);
    if (std::ranges::all_of(lifting_.coefficients, [](double c) { return c == 0; }))
      Vector().swap(lifting_.coefficients);
  });
  run_phase("solve", [&] { iterate(); });
  motions_.remove_from(solution_);
  BoundaryResult result{.solution = Solution(problem_.region, problem_.degree, solution_)};
  run_phase("measure", [&] { measure(result); });
  result.unknowns = system_->space().kept();
  result.levels = system_->hierarchy().size();
  result.iterations = iterations_.iterations;
  result.accuracy = iterations_.accuracy;
  result.notes = lifting_.notes;
  if (motions_.count() > 0)
    result.notes.emplace_back(
        "sides and supports leave the solution free to move; the one with mean 0 (and, for a plate, "
        "without mean tilt) is given");
  result.seconds = seconds_;
  return result;
}

}  // namespace

BoundaryResult solve_boundary_problem(const BoundaryProblem& problem, const BoundarySolveOptions& options) {
  return BoundarySolve(problem, options).run();
}

}  // namespace batten
