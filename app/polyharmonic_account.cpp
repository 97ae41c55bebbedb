// SPDX-License-Identifier: MIT
#include <batten/app/polyharmonic_account.h>
#include <batten/bases/lattice_green.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/polyharmonic_residual.h>
#include <batten/bases/smoothness.h>
#include <batten/bases/sum_rules.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t short_text = 12;  // characters of a fraction that a reader takes in

Json fraction_json(const Rational& v, Fractions fractions) {
  std::string text = v.str();
  if (fractions == Fractions::Short && text.size() > short_text) return v.convert_to<double>();
  return text;
}

/// `4 - 8/pi`
std::string pi_text(const PiNumber& v) {
  if (v.over_pi == 0) return v.rational.str();
  const Rational size = abs(v.over_pi);
  std::string over_pi = size.str();
  if (over_pi.find('/') != over_pi.npos) over_pi.insert(0, 1, '(').append(")");
  over_pi += "/pi";
  if (v.rational == 0) return (v.over_pi < 0 ? "-" : "") + over_pi;
  return v.rational.str() + (v.over_pi < 0 ? " - " : " + ") + over_pi;
}

/// One row for each power of y, the lowest first, of the square |i|, |j| <= half.
template <class Entry>
Json rows_json(int half, Entry&& entry) {
  Json rows = Json::array();
  for (int j = -half; j <= half; ++j) {
    Json row = Json::array();
    for (int i = -half; i <= half; ++i) row.push_back(entry(Index<2>{i, j}));
    rows.push_back(row);
  }
  return {{"offset", {-half, -half}}, {"coefficients", rows}};
}

Json mask_json(const PolyharmonicMask& m, Fractions fractions) {
  const int half = (m.size - 1) / 2;
  if (m.method == "exact" && m.order == 1) {
    LatticeGreen green;
    return rows_json(half, [&](const Index<2>& i) -> Json { return pi_text(harmonic_coefficient(green, i[0], i[1])); });
  }
  return rows_json(half, [&](const Index<2>& i) -> Json {
    return m.is_rational ? fraction_json(m.mask[i], fractions) : Json(m.mask[i].convert_to<double>());
  });
}

Json coset_sums_json(const PolyharmonicMask& m, Fractions fractions) {
  Json rows = Json::array();
  for (int j : {0, 1}) {
    Json row = Json::array();
    for (int i : {0, 1}) {
      const Rational total = sum(coset(m.mask, {i, j}));
      row.push_back(m.is_rational ? fraction_json(total, fractions) : Json(total.convert_to<double>()));
    }
    rows.push_back(row);
  }
  return rows;
}

void add_residuals(const PolyharmonicMask& m, const SchemeArguments& arguments, Json& json) {
  const auto rounded = to_double(m.mask);
  if (m.is_rational) {
    const Rational norm = residual_norm(m.mask, m.order);
    json["residual"] = norm.convert_to<double>();
    json["residual_exact"] = norm.str();
  } else {
    json["residual"] = residual_norm(rounded, m.order);
  }
  Json rounds = Json::array();
  for (int k = 1; k <= arguments.rounds; ++k) rounds.push_back(multilevel_residual(rounded, m.order, k));
  json["multilevel_residuals"] = rounds;
}

void add_smoothness(const PolyharmonicMask& m, Json& json) {
  const auto scheme = custom_scheme(m.mask);
  require_affine_invariance(scheme);
  // Polyharmonic splines are C^(2m-3) and no more. Proofs take milliseconds, obstacles of large masks minutes.
  const int most = std::max(0, 2 * m.order - 3);
  const auto verdict = smoothness(scheme, {.largest_continuity = most, .seek_obstacles = false});
  const std::string text = explanation(verdict, 2);
  json["smoothness"] = {{"continuity", verdict.continuity}, {"certificate", text.substr(0, text.find(';'))}};
}

}  // namespace

std::string polyharmonic_account(const PolyharmonicMask& m, const SchemeArguments& arguments, Fractions fractions) {
  Json json = {{"name", "polyharmonic"}, {"dimension", 2},     {"arity", 2},
               {"order", m.order},       {"method", m.method}, {"size", m.size}};
  json["mask"] = mask_json(m, fractions);
  if (m.method == "exact") {
    json["sum_rules"] = 2 * m.order;
    json["reproduction_degree"] = 1;
    return json.dump(2);
  }
  json["coset_sums"] = coset_sums_json(m, fractions);
  add_residuals(m, arguments, json);
  json["sum_rules"] = sum_rule_order(m.mask);
  json["reproduction_degree"] = polynomial_degrees(m.mask).reproduced;
  if (arguments.smoothness) add_smoothness(m, json);
  return json.dump(2);
}

}  // namespace batten
