// SPDX-License-Identifier: MIT
#include <batten/app/polyharmonic_mask.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/usage_error.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/optimal_mask.h>
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace batten {
namespace {

constexpr int usual_size = 9;

/// The place of a word in a list. Throws UsageError that lists them.
std::size_t choice(const std::string& option, const std::string& word, std::span<const char* const> words) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string list;
  for (const char* w : words) list += (list.empty() ? "" : ", ") + std::string(w);
  throw UsageError(option + ": expected one of " + list + ", found '" + word + "'");
}

/// "x,y,order;...", orders 1 where they are left out.
std::vector<PrescribedZero> zeros_of(const std::string& text) {
  std::vector<PrescribedZero> zeros;
  for (const auto& row : parse_integers("--zeros", text)) {
    if (row.size() != 2 && row.size() != 3)
      throw UsageError("--zeros: expected points and orders as in \"-1,1,2;-1,-1,1\", found '" + text + "'");
    zeros.push_back({{row[0], row[1]}, row.size() == 3 ? row[2] : 1});
  }
  return zeros;
}

void refuse_unused(const SchemeArguments& a, const std::string& method) {
  const bool constrained = method == "lp" || method == "lsq";
  const auto refuse = [&](const char* option) { throw UsageError("--method " + method + " has no option " + option); };
  if (a.relaxation && method != "jacobi") refuse("--relaxation");
  if (a.symmetry && !constrained) refuse("--symmetry");
  if (a.shape && !constrained) refuse("--shape");
  if (a.zeros && !constrained) refuse("--zeros");
  if (!a.precision || constrained) return;
  if (method == "exact") refuse("--precision");
  if (method == "laurent" && *a.precision != 0)
    throw InvalidInput(
        "--precision: coefficients of the Laurent series can be given precision 0, each coset divided by "
        "its sum, found " +
        std::to_string(*a.precision));
  if (method == "jacobi" && (*a.precision < 0 || *a.precision >= 2 * *a.order))
    throw InvalidInput("--precision: Jacobi masks of order " + std::to_string(*a.order) + " have precision " +
                       std::to_string(2 * *a.order - 1) + " and no other, found " + std::to_string(*a.precision));
}

Mask2<Rational> exactly(const Mask2<double>& s) {
  return {s.first(), s.size(), std::vector<Rational>(s.coefficients().begin(), s.coefficients().end())};
}

Mask2<Rational> jacobi_mask_of(const SchemeArguments& a, int size) {
  JacobiOptions options;
  if (a.relaxation) options.relaxation = parse_rational(*a.relaxation);
  options.rounds = jacobi_rounds(*a.order, size);
  return jacobi_mask(*a.order, options);
}

}  // namespace

MaskConstraints constraints_of(const SchemeArguments& a) {
  constexpr std::array<const char*, 4> symmetries = {"square", "rectangle", "point", "none"};
  constexpr std::array<const char*, 3> shapes = {"square", "disc", "diamond"};
  MaskConstraints constraints;
  constraints.precision = a.precision;
  if (a.zeros) constraints.zeros = zeros_of(*a.zeros);
  if (a.symmetry) constraints.symmetry = static_cast<MaskSymmetry>(choice("--symmetry", *a.symmetry, symmetries));
  if (a.shape) constraints.shape = static_cast<MaskShape>(choice("--shape", *a.shape, shapes));
  return constraints;
}

PolyharmonicMask polyharmonic_mask_of(const SchemeArguments& a) {
  const std::string method = a.method.value_or("lp");
  choice("--method", method, polyharmonic_methods);
  refuse_unused(a, method);
  const int order = *a.order, size = a.size.value_or(usual_size);
  PolyharmonicMask result{order, size, method, {}, true};
  if (method == "lp") result.mask = optimal_mask(order, size, constraints_of(a)).mask;
  if (method == "lsq") result.mask = least_squares_mask(order, size, constraints_of(a));
  if (method == "jacobi") result.mask = jacobi_mask_of(a, size);
  if (method == "laurent" || method == "exact") {
    const auto truncated = truncated_laurent_mask(order, size);
    result.mask = a.precision ? with_unit_cosets(truncated) : exactly(truncated);
    result.is_rational = false;
  }
  return result;
}

Scheme2 polyharmonic_scheme_of(const SchemeArguments& arguments) {
  constexpr double most = 1e-12;
  SchemeArguments with_precision = arguments;
  if (!arguments.precision && arguments.method != "exact") with_precision.precision = 0;
  const PolyharmonicMask found = polyharmonic_mask_of(with_precision);
  for (const Index<2>& residue : {Index<2>{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    const double total = sum(coset(found.mask, residue)).convert_to<double>();
    if (std::abs(total - 1) > most)
      throw InvalidInput("the coset " + index_text<2>(residue) + " of the mask must sum to 1, found " +
                         number_text(total, 12) + ": constants would not be kept; use --precision 0");
  }
  const std::string size = std::to_string(found.size);
  return {"polyharmonic of order " + std::to_string(found.order) + ", " + found.method + " " + size + " x " + size,
          found.mask};
}

}  // namespace batten
