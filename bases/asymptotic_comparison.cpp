// SPDX-License-Identifier: MIT
#include <batten/bases/asymptotic_comparison.h>
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

using Complex = std::complex<double>;

double norm(const Mask<double>& s) { return std::max(absolute_sum(coset(s, 0)), absolute_sum(coset(s, 1))); }

const Mask<Rational>& linear_mask() {
  static const Mask<Rational> mask(0, {Rational(1, 2), 1, Rational(1, 2)});
  return mask;
}

/// The largest m <= that of the limit with alpha < 2^-m; -1 when alpha >= 1.
int compared_continuity(int limit_continuity, Rational alpha) {
  int m = -1;
  for (; m < limit_continuity && alpha < 1; ++m) alpha *= 2;
  return m;
}

/// Looks at the levels: how close the norms come to the bound, and where they exceed it by more than rounding.
void look_at_levels(const AsymptoticProblem& problem, AsymptoticSmoothness& found) {
  const Mask<double> limit = to_double(problem.limit);
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * norm(limit);
  const double alpha = static_cast<double>(problem.bound.alpha);
  for (int k = problem.bound.from_level; k <= found.levels; ++k) {
    const double distance = norm(problem.rest(k) - limit);
    const double allowed = problem.bound.beta * std::pow(alpha, k);
    if (allowed > rounding) found.largest_ratio = std::max(found.largest_ratio, distance / allowed);
    if (distance > allowed + rounding && found.first_violation == 0) found.first_violation = k;
  }
}

std::string text_of(const AsymptoticProblem& problem, const AsymptoticSmoothness& found) {
  const std::string bound =
      "‖B_k - B_∞‖ <= " + std::to_string(problem.bound.beta) + " (" + problem.bound.alpha.str() + ")^k";
  if (found.first_violation > 0)
    return "undecided: " + bound + " fails on level " + std::to_string(found.first_violation);
  if (found.continuity < 0) return "undecided: the limit mask must converge and alpha be below 1";
  const std::string basis = found.proved_bound
                                ? " for all levels, as " + problem.bound.reason
                                : " was only observed, on levels " + std::to_string(problem.bound.from_level) + " to " +
                                      std::to_string(found.levels);
  return "C^" + std::to_string(found.continuity) + (found.proved_bound ? " because " : " provided that ") + bound +
         basis + "; " + std::to_string(problem.smoothing_factors) + " smoothing factors; the limit mask is " +
         explanation(found.limit_verdict, 2);
}

/// Moves two roots that are real or a pair to the front.
void bring_two_forward(std::vector<Complex>& roots) {
  const auto is_real = [](const Complex& a) { return a.imag() == 0; };
  const auto real = static_cast<int>(std::count_if(roots.begin(), roots.end(), is_real));
  std::stable_sort(roots.begin(), roots.end(), [&](const Complex& a, const Complex& b) {
    return real >= 2 ? is_real(a) > is_real(b) : is_real(a) < is_real(b);
  });
  if (real < 2) std::iter_swap(roots.begin() + 1, std::find(roots.begin() + 1, roots.end(), std::conj(roots[0])));
}

void require_pairs(const std::vector<Complex>& roots) {
  if (roots.size() < 2)
    throw InvalidInput("exponential_spline_problem: two roots or more are needed, found " +
                       std::to_string(roots.size()));
  for (const Complex& a : roots)
    if (std::count(roots.begin(), roots.end(), a) != std::count(roots.begin(), roots.end(), std::conj(a)))
      throw InvalidInput("exponential_spline_problem: complex roots must come in pairs, found " +
                         std::to_string(a.real()) + " + " + std::to_string(a.imag()) + "i without its own");
}

}  // namespace

AsymptoticSmoothness asymptotic_smoothness(const AsymptoticProblem& problem, int levels) {
  AsymptoticSmoothness found;
  found.levels = levels;
  found.proved_bound = !problem.bound.reason.empty();
  found.limit_verdict = smoothness(custom_scheme<1>(problem.limit));
  look_at_levels(problem, found);
  const int compared = compared_continuity(found.limit_verdict.continuity, problem.bound.alpha);
  if (found.first_violation == 0 && compared >= 0) found.continuity = compared + problem.smoothing_factors;
  found.explanation = text_of(problem, found);
  return found;
}

AsymptoticProblem tension_problem(double sigma) {
  if (!(sigma > -1) || !std::isfinite(sigma))
    throw InvalidInput("tension_problem: sigma must be greater than -1, found " + std::to_string(sigma));
  AsymptoticProblem problem;
  problem.rest = [sigma](int level) {
    double s = sigma;
    for (int k = 0; k < level; ++k) s = std::sqrt((1 + s) / 2);
    return Mask<double>(0, {1 / (1 + s), 2 * s / (1 + s), 1 / (1 + s)});
  };
  problem.limit = linear_mask();
  problem.smoothing_factors = 2;
  problem.bound = {std::abs(1 - sigma), Rational(1, 2), 1, "0 < (1-σ_k)/(1-σ_(k-1)) = 1/(2(1+σ_k)) < 1/2"};
  return problem;
}

AsymptoticProblem exponential_spline_problem(std::vector<Complex> roots) {
  require_pairs(roots);
  bring_two_forward(roots);
  const Complex a = roots[0], b = roots[1];
  AsymptoticProblem problem;
  problem.rest = [a, b](int level) {
    const Complex u = std::exp(std::ldexp(1., -level) * a), v = std::exp(std::ldexp(1., -level) * b);
    const Complex scale = 2. / ((1. + u) * (1. + v));
    return Mask<double>(0, {scale.real(), (scale * (u + v)).real(), (scale * u * v).real()});
  };
  problem.limit = linear_mask();
  problem.smoothing_factors = static_cast<int>(roots.size()) - 2;
  int from = 1;
  while (std::max(std::abs(a), std::abs(b)) > std::ldexp(1., from + 1)) ++from;
  const double beta = std::abs(a) + std::abs(b) + std::abs(a) * std::abs(b);
  problem.bound = {beta, Rational(1, 2), from, "|tanh(a/2^(k+1))| <= |a|/2^k"};
  return problem;
}

}  // namespace batten
