// SPDX-License-Identifier: MIT
#include <batten/bases/modular_elimination.h>
#include <batten/bases/rational_elimination.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace batten {
namespace {

/// The three largest primes below 2^26.
constexpr std::array<std::uint32_t, 3> primes = {67108859, 67108837, 67108819};

/// An equation times the common denominator of its numbers.
struct IntegerEquation {
  std::vector<std::pair<std::size_t, Integer>> terms;
  Integer right;
};

/// Numerators over one denominator.
struct CommonFraction {
  std::vector<Integer> numerators;
  Integer denominator = 1;
};

IntegerEquation cleared(const ExactEquation& equation, int unknowns) {
  std::map<int, Rational> factors;
  Integer common = denominator(equation.right);
  for (const auto& [unknown, factor] : equation.terms) {
    if (unknown < 0 || unknown >= unknowns)
      throw InvalidInput("unique_solution: unknowns are numbered 0 .. " + std::to_string(unknowns - 1) + ", found " +
                         std::to_string(unknown));
    factors[unknown] += factor;
    common = lcm(common, Integer(denominator(factor)));
  }
  IntegerEquation result;
  for (const auto& [unknown, factor] : factors)
    if (factor != 0) result.terms.emplace_back(static_cast<std::size_t>(unknown), Integer(numerator(factor * common)));
  result.right = numerator(equation.right * common);
  return result;
}

std::uint32_t remainder(const Integer& a, std::uint32_t prime) {
  return static_cast<std::uint32_t>(mpz_fdiv_ui(a.backend().data(), prime));
}

/// The first equations that determine all unknowns modulo a prime; `equations` are as many as there are unknowns, or
/// less where there is a choice.
struct Selection {
  ModularElimination elimination;
  std::vector<std::size_t> equations;
};

Selection independent_equations(const std::vector<IntegerEquation>& equations, int unknowns, std::uint32_t prime) {
  Selection selection{ModularElimination(unknowns, prime), {}};
  std::vector<std::uint32_t> row(static_cast<std::size_t>(unknowns));
  for (std::size_t e = 0; e < equations.size() && !selection.elimination.is_full(); ++e) {
    std::fill(row.begin(), row.end(), 0);
    for (const auto& [unknown, factor] : equations[e].terms) row[unknown] = remainder(factor, prime);
    if (selection.elimination.add(row)) selection.equations.push_back(e);
  }
  return selection;
}

bool satisfies(const CommonFraction& x, const IntegerEquation& equation) {
  Integer rest = -equation.right * x.denominator;
  for (const auto& [unknown, factor] : equation.terms) rest += factor * x.numerators[unknown];
  return rest == 0;
}

/// The denominator d <= bound of the fraction n/d = a modulo `modulus` with |n| <= bound, by Euclid's algorithm
/// [Wang 1981]; 0 when there is none.
Integer denominator_of_residue(const Integer& a, const Integer& modulus, const Integer& bound) {
  Integer r0 = modulus, r1 = a, t0 = 0, t1 = 1;
  while (r1 > bound) {
    const Integer q = r0 / r1;
    r0 -= q * r1;
    swap(r0, r1);
    t0 -= q * t1;
    swap(t0, t1);
  }
  const Integer d = abs(t1);
  return d <= bound ? d : Integer(0);
}

/// The fractions of small numerators over a small common denominator that equal x modulo `modulus`.
std::optional<CommonFraction> fractions_of(const std::vector<Integer>& x, const Integer& modulus) {
  const Integer bound = sqrt(Integer(modulus / 2));
  const auto residue = [&](const Integer& a, const Integer& times) {
    const Integer r = a * times % modulus;
    return r < 0 ? Integer(r + modulus) : r;
  };
  CommonFraction result;
  for (const Integer& a : x) {
    const Integer d = denominator_of_residue(residue(a, result.denominator), modulus, bound);
    result.denominator *= d;
    if (d == 0 || result.denominator > bound) return std::nullopt;
  }
  for (const Integer& a : x) {
    const Integer r = residue(a, result.denominator);
    result.numerators.push_back(2 * r > modulus ? Integer(r - modulus) : r);
  }
  return result;
}

/// x of the selected equations, p-adic digit by digit: x = x_0 + p x_1 + ..., A x_k = r_k mod p, r_{k+1} = (r_k - A
/// x_k) / p [Dixon 1982]. Ends because the equations are independent; what it gives is checked in them.
CommonFraction lifted_solution(const std::vector<IntegerEquation>& equations, const Selection& selection,
                               std::uint32_t prime) {
  const std::size_t n = selection.equations.size();
  std::vector<Integer> residual(n), x(n);
  std::vector<std::uint32_t> right(n);
  for (std::size_t i = 0; i < n; ++i) residual[i] = equations[selection.equations[i]].right;
  Integer modulus = 1;
  for (int digits = 1, next_try = 3;; ++digits) {
    for (std::size_t i = 0; i < n; ++i) right[i] = remainder(residual[i], prime);
    const auto digit = selection.elimination.solve(right);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += modulus * digit[i];
      auto* r = residual[i].backend().data();
      for (const auto& [unknown, factor] : equations[selection.equations[i]].terms)
        mpz_submul_ui(r, factor.backend().data(), digit[unknown]);
      mpz_divexact_ui(r, r, prime);
    }
    modulus *= prime;
    if (digits < next_try) continue;
    next_try += 1 + next_try / 2;
    const auto found = fractions_of(x, modulus);
    const auto holds = [&](std::size_t e) { return satisfies(*found, equations[e]); };
    if (found && std::all_of(selection.equations.begin(), selection.equations.end(), holds)) return *found;
  }
}

}  // namespace

std::optional<std::vector<Rational>> unique_solution(std::span<const ExactEquation> equations, int unknowns) {
  if (unknowns < 0)
    throw InvalidInput("unique_solution: the number of unknowns must not be negative, found " +
                       std::to_string(unknowns));
  std::vector<IntegerEquation> integral;
  for (const auto& equation : equations) integral.push_back(cleared(equation, unknowns));
  for (const std::uint32_t prime : primes) {
    const auto selection = independent_equations(integral, unknowns, prime);
    if (!selection.elimination.is_full()) continue;
    const auto x = lifted_solution(integral, selection, prime);
    for (const auto& equation : integral)
      if (!satisfies(x, equation)) return std::nullopt;
    std::vector<Rational> result;
    for (const Integer& n : x.numerators) result.emplace_back(n, x.denominator);
    return result;
  }
  return std::nullopt;
}

}  // namespace batten
