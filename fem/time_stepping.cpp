// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/load_vector.h>
#include <batten/fem/mass.h>
#include <batten/fem/shifted_solver.h>
#include <batten/fem/side_data.h>
#include <batten/fem/support_points.h>
#include <batten/fem/time_stepping.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>
#include <optional>

namespace batten {
namespace {

using Vector = std::vector<double>;

void expect(bool holds, const char* rule, double found) {
  if (!holds || !std::isfinite(found))
    throw InvalidInput(std::string("march: expected ") + rule + ", found " + number_text(found, 6));
}

void expect_valid(const BoundaryProblem& problem, const Motion& motion) {
  expect(motion.step > 0, "a step > 0", motion.step);
  expect(motion.end > 0, "an end > 0", motion.end);
  expect(motion.end / motion.step <= 1e9, "at most 1e9 steps", motion.end / motion.step);
  expect(motion.damping >= 0, "a damping >= 0", motion.damping);
  if (problem.is_plate()) return;
  expect(motion.damping == 0, "no damping, which plates alone have", motion.damping);
  if (!motion.velocity.is_zero())
    throw InvalidInput("march: expected no velocity at time 0, which plates alone have, found one");
}

/// The same splines without conditions, loads and supports.
BoundaryProblem unconditional(const BoundaryProblem& problem) {
  return {Conduction{}, problem.region, problem.degree, {}, {}, {}};
}

/// ∫∫ f N_i for all splines.
Vector moments(const BoundaryProblem& problem, const Field& f, const char* what) {
  auto integrals = unconditional(problem);
  integrals.loads.area = f;
  const auto refuse = [&](const std::string& found) {
    throw InvalidInput(std::string("march: expected finite ") + what + found);
  };
  if (f.is_constant() && !std::isfinite(f(0, 0))) refuse(", found " + number_text(f(0, 0)));
  try {
    return load_vector(integrals);
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    refuse(text.substr(std::min(text.size(), text.find(", found"))));
    throw;
  }
}

/// What does not depend on the length of the step. A state is u = g + v: g takes the values of sides and supports, v
/// vanishes there.
struct Statics {
  const BoundaryProblem& problem;
  const Motion& motion;
  SupportPoints supports;
  Mass mass;
  Operator whole_energy, energy;  // A
  std::vector<std::string> notes;
  Vector g;             // whole coefficients
  Vector ag;            // A g and ...
  Vector force;         // b - A g on the splines that keep the conditions
  double g_energy = 0;  // g·A g

  Statics(const BoundaryProblem& p, const Motion& m)
      : problem(p),
        motion(m),
        supports(support_points(p, {})),
        mass(p, m.density),
        whole_energy(batten::whole_energy(p)),
        energy(restricted_energy(p, whole_energy)) {}

  void lift(const ShiftedSolver& solver);
  Vector projected(const Field& f, const Vector& without, const ShiftedSolver& solver, const char* what) const;
};

void Statics::lift(const ShiftedSolver& solver) {
  auto sides = lifting(problem);
  notes = std::move(sides.notes);
  g = std::move(sides.coefficients);
  if (supports.constraints.size() > 0) {
    const Solution lifted(problem.region, problem.degree, g);
    const Vector miss = missing_values(supports.constraints, solver.system().order(), lifted);
    const Vector rest = solver.system().whole(solver.projection().lifting(miss));
    combine(1, rest, 1, g);
  }
  Vector product(g.size()), b = load_vector(problem);
  whole_energy.apply(g, product);
  g_energy = dot(g, product);
  ag = solver.system().restricted(product);
  combine(-1, product, 1, b);
  force = solver.system().restricted(b);
}

/// The v nearest to f - without in L2.
Vector Statics::projected(const Field& f, const Vector& without, const ShiftedSolver& solver, const char* what) const {
  Vector b = moments(problem, f, what), product(b.size());
  Mass(unconditional(problem), 1).apply(without, product);
  combine(-1, product, 1, b);
  Vector r = solver.system().restricted(b);
  const MassInverse inverse(solver.system().space(), problem.region);
  const auto& projection = solver.projection();
  if (projection.is_identity() && inverse.is_exact()) {
    inverse.apply(r);
    return r;
  }
  const Mass unit(problem, 1);
  ProjectedGradients gradients({[&](std::span<const double> v, std::span<double> out) { unit.apply(v, out); },
                                [&](Vector& residual, Vector& z) {
                                  projection.project_transposed(residual);
                                  z = residual;
                                  inverse.apply(z);
                                  projection.project(z);
                                }});
  Vector v(r.size());
  gradients.solve(r, v, {.accuracy = 1e-12}, 0);
  return v;
}

/// Heat: (A + M / (γ dt)) s_1 = b - A u, the same for s_2 with u + s_1 (1 - γ) / γ, and u moves by both, γ = 1 - √½.
class Heat {
public:
  static constexpr double gamma = 1 - 1 / std::numbers::sqrt2;

  explicit Heat(const Statics& statics) : statics_(statics) {}
  static Field mass(const Motion& motion, double dt) { return motion.density.affine(1 / (gamma * dt)); }
  void begin(const ShiftedSolver& solver) {
    v_ = statics_.projected(statics_.motion.initial, statics_.g, solver, what);
  }
  void take_solver(ShiftedSolver& solver, double) {
    solver_ = &solver;
    Vector product = solver.system().apply_whole(statics_.g);
    g_size_ = dot(statics_.g, product);
    kg_ = solver.system().restricted(product);
  }
  void step() {
    const double scale = size();
    combine((1 - gamma) / gamma, solver_->solve(residual(), scale), 1, v_);
    combine(1, solver_->solve(residual(), scale), 1, v_);
  }
  const Vector& state() const { return v_; }

private:
  static constexpr const char* what = "initial values";

  /// b - A u
  const Vector& residual() {
    r_.resize(v_.size());
    statics_.energy.apply(v_, r_);
    combine(1, statics_.force, -1, r_);
    return r_;
  }
  /// sqrt(u·K u)
  double size() {
    r_.resize(v_.size());
    solver_->system().hierarchy().finest().energy.apply(v_, r_);
    return std::sqrt(std::max(0., dot(v_, r_) + 2 * dot(v_, kg_) + g_size_));
  }

  const Statics& statics_;
  ShiftedSolver* solver_ = nullptr;
  Vector v_, r_, kg_;
  double g_size_ = 0;
};

/// Plates: with the mean velocity w̄_t = (w_1 - w_0) / dt of a step, half its way s = w̄_t dt / 2 solves
///
///   (A + (4 density / dt² + 2 damping / dt) M) s = b - A w_0 + 2 / dt M density w_0t.
///
/// What the step changes of the energy is s · (the residual that the solver leaves), and so nothing where they are
/// orthogonal.
class Vibrating {
public:
  explicit Vibrating(const Statics& statics) : statics_(statics) {}
  static Field mass(const Motion& motion, double dt) {
    return motion.density.affine(4 / (dt * dt), 2 * motion.damping / dt);
  }
  void begin(const ShiftedSolver& solver) {
    w_ = statics_.projected(statics_.motion.initial, statics_.g, solver, "initial values");
    velocity_ = statics_.projected(statics_.motion.velocity, Vector(statics_.g.size()), solver, "initial velocities");
    aw_.resize(w_.size());
    b_.resize(w_.size());
  }
  void take_solver(ShiftedSolver& solver, double dt) {
    solver_ = &solver;
    dt_ = dt;
  }
  void step() {
    statics_.energy.apply(w_, aw_);
    statics_.mass.apply(velocity_, b_);
    const double stored = dot(w_, aw_) + 2 * dot(w_, statics_.ag) + statics_.g_energy;
    const double scale = std::sqrt(std::max(0., dot(velocity_, b_) + stored));
    combine(-1, aw_, 2 / dt_, b_);
    combine(1, statics_.force, 1, b_);
    solver_->solve(b_, scale);
    const auto s = solver_->balanced(b_);
    combine(2, s, 1, w_);
    combine(4 / dt_, s, -1, velocity_);
  }
  const Vector& state() const { return w_; }

private:
  const Statics& statics_;
  ShiftedSolver* solver_ = nullptr;
  double dt_ = 0;
  Vector w_, velocity_, aw_, b_;
};

template <typename Method>
concept Stepping = requires(Method method, const Motion& motion, ShiftedSolver& solver, double dt) {
  { Method::mass(motion, dt) } -> std::same_as<Field>;
  method.begin(solver);
  method.take_solver(solver, dt);
  method.step();
  { method.state() } -> std::same_as<const Vector&>;
};

template <Stepping Method>
MarchResult march_by(const BoundaryProblem& problem, const Motion& motion,
                     const std::function<void(double time, const Solution& state)>& frame,
                     const BoundarySolveOptions& options) {
  constexpr double rounding = 1e-9;  // of a step
  const auto whole_steps = static_cast<int>(std::floor(motion.end / motion.step + rounding));
  const double rest = motion.end - whole_steps * motion.step;
  const int steps = whole_steps + (rest > rounding * motion.step ? 1 : 0);
  Statics statics(problem, motion);
  Method method(statics);
  std::optional<ShiftedSolver> solver;
  MarchResult result;
  const auto use_step = [&](double dt) {
    if (solver) result.cycles += solver->cycles();
    solver.emplace(problem, Method::mass(motion, dt), statics.supports.constraints, options.limits);
    if (statics.g.empty()) {
      statics.lift(*solver);
      method.begin(*solver);
    }
    method.take_solver(*solver, dt);
  };
  const auto show = [&](double time) {
    Vector u = solver->system().whole(method.state());
    combine(1, statics.g, 1, u);
    frame(time, Solution(problem.region, problem.degree, std::move(u)));
    if (options.progress) options.progress("march", time / motion.end);
  };
  use_step(whole_steps > 0 ? motion.step : rest);
  show(0);
  for (int k = 1; k <= steps; ++k) {
    if (k > 1 && k > whole_steps) use_step(rest);
    method.step();
    show(k == steps ? motion.end : k * motion.step);
  }
  result.steps = steps;
  result.cycles += solver->cycles();
  result.notes = statics.notes;
  return result;
}

}  // namespace

MarchResult march(const BoundaryProblem& problem, const Motion& motion,
                  const std::function<void(double time, const Solution& state)>& frame,
                  const BoundarySolveOptions& options) {
  expect_valid(problem, motion);
  if (problem.is_plate()) return march_by<Vibrating>(problem, motion, frame, options);
  return march_by<Heat>(problem, motion, frame, options);
}

}  // namespace batten
