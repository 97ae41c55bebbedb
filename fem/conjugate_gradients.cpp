// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/preconditioned_system.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace batten {
namespace {

using Vector = std::vector<double>;

constexpr int row_length = 1024;  // vectors are cut into rows of this length, for the fixed blocks

template <typename Work>
double sum_over(std::size_t n, Work&& work) {
  const int rows = static_cast<int>((n + row_length - 1) / row_length);
  return sum_blocks(RowBlocks(rows, row_length), [&](int begin, int end) {
    return work(static_cast<std::size_t>(begin) * row_length, std::min(n, static_cast<std::size_t>(end) * row_length));
  });
}

double distance(std::span<const double> a, std::span<const double> b) {
  return std::sqrt(sum_over(a.size(), [&](std::size_t from, std::size_t to) {
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = from; i < to; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
  }));
}

/// c += step p and r -= step q in one pass.
void move(double step, std::span<const double> p, std::span<const double> q, std::span<double> c, std::span<double> r) {
  sum_over(p.size(), [&](std::size_t from, std::size_t to) {
#pragma omp simd
    for (std::size_t i = from; i < to; ++i) {
      c[i] += step * p[i];
      r[i] -= step * q[i];
    }
    return 0.;
  });
}

bool is_zero(std::span<const double> c) {
  return sum_over(c.size(), [&](std::size_t from, std::size_t to) {
           double others = 0;
#pragma omp simd reduction(+ : others)
           for (std::size_t i = from; i < to; ++i) others += c[i] == 0 ? 0. : 1.;
           return others;
         }) == 0;
}

/// A x = b on one level of the multigrid.
struct LevelSystem {
  const Multigrid& system;
  std::size_t level;

  /// out = A c; returns c·A c.
  double apply(std::span<const double> c, std::span<double> out) const { return system.apply(c, out, level); }
  Multigrid::Vectors& vectors() const { return system.vectors(level); }
  /// z = B r; returns r·z, which rounding can make negative.
  double precondition(const Vector& r, Vector& z) const {
    system.precondition(r, z, level);
    return dot(r, z);
  }
};

/// A x = b of a system that is known by its operator and preconditioner.
struct OpenSystem {
  const PreconditionedSystem& system;
  Multigrid::Vectors& buffers;

  double apply(std::span<const double> c, std::span<double> out) const { return system.apply(c, out); }
  Multigrid::Vectors& vectors() const { return buffers; }
  double precondition(const Vector& r, Vector& z) const {
    system.precondition(r, z);
    return dot(r, z);
  }
};

/// The size of what is left in the energy norm, from r·B r.
double norm_of(double rz) { return std::sqrt(std::abs(rz)); }

/// r = b - A c
template <typename System>
void residual(const System& system, std::span<const double> b, std::span<const double> c, Vector& r) {
  system.apply(c, r);
  combine(1, b, -1, r);
}

/// What conjugate gradients carry from one run to the next besides their vectors, the residual r and z = B r.
struct State {
  double rz = 0;  ///< r·z
  int iterations = 0;
};

constexpr double rounding_of_energy = 1e-11;  // of the system's norm, more than ε

/// True if p·Ap, although not positive, is no more than rounding against r·Ar. Overwrites `work`.
template <typename System>
bool is_rounding(const System& system, double curvature, const Vector& p, const Vector& r, Vector& work) {
  const double stiff = system.apply(r, work) / dot(r, r);
  return std::abs(curvature) <= rounding_of_energy * stiff * dot(p, p);
}

/// Iterates until the recursive residual says that sqrt(rz) is at most `goal`. Where
/// the coming step is expected to be the last, the true residual is put in place of the recursive one if the two agree,
/// which saves a V-cycle; one more step may follow, in case it was not the last. Returns whether r is the true one.
template <typename System>
bool run(const System& system, std::span<const double> b, std::span<double> c, double goal, int most_iterations,
         State& state) {
  auto& [rz, iterations] = state;
  auto& [r, z, p, q] = system.vectors();
  p.assign(z.begin(), z.end());
  double factor = 0.3;
  bool guessed = false, is_true = false;
  while (iterations < most_iterations && !(rz <= 0)) {
    ++iterations;
    const double curvature = system.apply(p, q);
    if (!(curvature > 0)) {
      if (is_rounding(system, curvature, p, r, q)) break;
      throw SolverError("solve: expected a positive definite system, found a direction of energy " +
                        number_text(curvature, 3));
    }
    move(rz / curvature, p, q, c, r);
    const bool was_true = is_true;
    if (!guessed && norm_of(rz) * factor <= goal) {
      guessed = true;
      residual(system, b, c, q);
      is_true = distance(q, r) <= 0.1 * std::sqrt(dot(r, r));
      if (is_true) std::swap(q, r);
    }
    const double next = system.precondition(r, z), ratio = next / rz;
    rz = next;
    if (was_true || norm_of(rz) <= goal) break;
    factor = norm_of(ratio);
    combine(1, z, ratio, p);
  }
  return is_true;
}

/// Conjugate gradients from the start c until sqrt(r·Br) <= accuracy * scale; a scale of 0 stands for the first
/// sqrt(r·Br).
template <typename System>
IterationResult iterate(const System& system, std::span<const double> b, std::span<double> c,
                        const IterationLimits& limits, double scale) {
  auto& [r, z, p, q] = system.vectors();
  State state;
  auto& [rz, iterations] = state;
  r.assign(b.begin(), b.end());
  q.resize(b.size());
  if (!is_zero(c)) {
    residual(system, b, c, r);
    if (dot(c, r) + dot(c, b) < 0) {  // c·A c > 2 b·c: the start is farther from the solution than 0
      std::fill(c.begin(), c.end(), 0.);
      r.assign(b.begin(), b.end());
    }
  }
  rz = system.precondition(r, z);
  if (scale == 0) scale = norm_of(rz);
  const auto reached = [&] { return scale > 0 ? norm_of(state.rz) / scale : 0; };
  for (int restarts = 0; restarts < 2 && reached() > limits.accuracy; ++restarts) {
    if (!run(system, b, c, limits.accuracy * scale, limits.most_iterations, state)) {
      residual(system, b, c, r);
      rz = system.precondition(r, z);
    }
    if (reached() <= 10 * limits.accuracy || iterations >= limits.most_iterations) break;
  }
  return {iterations, reached()};
}

constexpr double predictor_accuracy = 0.2;  // on each coarse level, relative to its own start

/// Full multigrid: the solution on the coarsest level is refined and improved level by level. `c` receives the start
/// for the finest level. Returns the V-cycles spent, in units of the finest level.
double predict(const Multigrid& system, std::span<const double> b, std::span<double> c) {
  std::vector<Vector> right(system.levels()), solution(system.levels());  // of the levels below the finest
  for (std::size_t k = 1; k < right.size(); ++k) {
    right[k].resize(system.size(k));
    solution[k].resize(system.size(k));
    system.hierarchy().restrict_from(static_cast<int>(k) - 1, k == 1 ? b : right[k - 1], right[k]);
  }
  double work = 0;
  for (std::size_t k = right.size() - 1; k > 0; --k) {
    const auto spent = iterate(LevelSystem{system, k}, right[k], solution[k],
                               {.accuracy = predictor_accuracy, .most_iterations = 20}, 0);
    work += (spent.iterations + 1.) * static_cast<double>(system.size(k)) / static_cast<double>(system.size());
    system.hierarchy()[static_cast<int>(k) - 1].refinement->apply(solution[k], k == 1 ? c : solution[k - 1]);
  }
  return work;
}

// A V-cycle that leaves more of the error than `slow` converges better within conjugate gradients; where one leaves
// more than `standstill` of a delicate energy's although the one before was not slow, and no more is left than
// `most_rounding`, what remains is rounding.
constexpr double slow = 0.25, standstill = 0.5;

/// Rounding of a plate's residual, ε / h^4, in the energy norm, at most. Where splines of high degree have free sides,
/// smooth errors go fast and leave slow ones above it.
double most_rounding(double unknowns) { return std::numeric_limits<double>::epsilon() * std::pow(unknowns, 1.5); }

/// What is to be said of V-cycles one after another, which need neither the vectors of conjugate gradients nor the time
/// to move them.
struct CyclesResult {
  IterationResult spent;
  double scale = 0;
  bool is_slow = false;
};

/// Full multigrid or V-cycles from the start c, then further V-cycles until they have reached the accuracy or are slow.
CyclesResult repeat_cycles(const Multigrid& system, StreamedCycle::Begin begin, std::span<const double> b,
                           std::span<double> c, const IterationLimits& limits, double scale) {
  const bool is_delicate = system.hierarchy().finest().energy.is_delicate();
  CyclesResult result{{}, scale};
  auto& [iterations, accuracy] = result.spent;
  double before = 0, ratio = 0;
  system.streamed()->iterate(begin, b, c, [&](const StreamedCycle::Iterate& found) {
    if (result.scale == 0) result.scale = found.size;
    const double last_ratio = std::exchange(ratio, before > 0 ? found.error / before : 0);
    before = found.error;
    ++iterations;
    accuracy = result.scale > 0 ? found.error / result.scale : 0;
    const bool may_be_rounding = is_delicate && accuracy < most_rounding(static_cast<double>(c.size()));
    result.is_slow = ratio > slow && !(may_be_rounding && ratio > standstill && last_ratio < slow);
    return accuracy > limits.accuracy && ratio <= slow && iterations < limits.most_iterations;
  });
  return result;
}

/// Full multigrid, then V-cycles, then conjugate gradients where those are too slow.
IterationResult solve_streamed(const Multigrid& system, std::span<const double> b, std::span<double> c,
                               IterationLimits limits, double scale) {
  const bool by_levels = is_zero(c);
  if (!by_levels && scale == 0) scale = energy_size(system, b);
  auto [result, size, is_slow] = repeat_cycles(
      system, by_levels ? StreamedCycle::Begin::ByLevels : StreamedCycle::Begin::AtStart, b, c, limits, scale);
  if (is_slow && result.accuracy > limits.accuracy && result.iterations < limits.most_iterations) {
    limits.most_iterations -= result.iterations;
    const auto more = iterate(LevelSystem{system, 0}, b, c, limits, size);
    result = {result.iterations + more.iterations, more.accuracy};
  }
  if (by_levels) result.iterations += static_cast<int>(std::ceil(system.streamed()->work_by_levels()));
  return result;
}

}  // namespace

double energy_size(const Multigrid& system, std::span<const double> b) {
  Vector z;
  return norm_of(LevelSystem{system, 0}.precondition({b.begin(), b.end()}, z));
}

IterationResult solve(const Multigrid& system, std::span<const double> b, std::span<double> c,
                      const IterationLimits& limits, double scale) {
  if (system.streamed() && !system.null_projection()) return solve_streamed(system, b, c, limits, scale);
  double before = 0;
  if (!is_zero(c)) {
    if (scale == 0) scale = energy_size(system, b);
  } else if (system.can_predict()) {
    before = predict(system, b, c);
    if (scale == 0) scale = std::sqrt(std::max(0., dot(b, c)));
  }
  auto result = iterate(LevelSystem{system, 0}, b, c, limits, scale);
  result.iterations += static_cast<int>(std::ceil(before));
  if (system.null_projection()) system.null_projection()->set_component(b, c);
  return result;
}

IterationResult solve_system(const PreconditionedSystem& system, std::span<const double> b, std::span<double> c,
                             const IterationLimits& limits, double scale) {
  Multigrid::Vectors vectors;
  const OpenSystem open{system, vectors};
  if (scale == 0) {
    vectors.r.assign(b.begin(), b.end());
    scale = norm_of(open.precondition(vectors.r, vectors.z));
  }
  return iterate(open, b, c, limits, scale);
}

void solve_by_levels(const Multigrid& system, std::span<const double> b, std::span<double> c) {
  if (system.streamed()) return system.streamed()->solve_by_levels(b, c);
  std::fill(c.begin(), c.end(), 0.);
  solve(system, b, c, {.accuracy = 0, .most_iterations = 1});
}

}  // namespace batten
