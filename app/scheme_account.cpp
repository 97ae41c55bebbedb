// SPDX-License-Identifier: MIT
#include <batten/app/scheme_account.h>
#include <batten/app/usage_error.h>
#include <batten/bases/box_spline.h>
#include <batten/bases/hoelder.h>
#include <batten/bases/inner_products.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/non_stationary_values.h>
#include <batten/bases/scaling_values.h>
#include <batten/bases/smoothness.h>
#include <batten/bases/sum_rules.h>
#include <batten/domains/errors.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(const Rational& v) { return v.str(); }
Json number_json(double v) { return v; }

/// Exponents are whole numbers or halves.
Json exponent_json(int index, int half) { return half == 0 ? Json(index) : Json(index + 0.5); }

template <class T>
Json polynomial_json(const LaurentPolynomial<T, 1>& s) {
  Json coefficients = Json::array();
  for (const T& c : s.coefficients()) coefficients.push_back(number_json(c));
  return {{"offset", exponent_json(s.first()[0], s.half()[0])}, {"coefficients", coefficients}};
}

/// One row for each power of y, the lowest first.
template <class T>
Json polynomial_json(const LaurentPolynomial<T, 2>& s) {
  Json rows = Json::array();
  for (int j = 0; j < s.size()[1]; ++j) {
    Json row = Json::array();
    for (int i = 0; i < s.size()[0]; ++i) row.push_back(number_json(s[{s.first()[0] + i, s.first()[1] + j}]));
    rows.push_back(row);
  }
  return {{"offset", {exponent_json(s.first()[0], s.half()[0]), exponent_json(s.first()[1], s.half()[1])}},
          {"coefficients", rows}};
}

template <int D>
Json support_json(const SubdivisionScheme<D>& scheme) {
  const auto support = scheme.support();
  Json ends = Json::array();
  for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d)
    ends.push_back({number_json(support.lower[d]), number_json(support.upper[d])});
  return D == 1 ? ends[0] : ends;
}

template <int D>
Index<D> order_of(const std::string& option, const std::vector<int>& found, const std::string& text) {
  Index<D> order{};
  if (found.size() != order.size())
    throw UsageError(option + ": expected " + (D == 1 ? "one order" : "orders in x and y, as in 1,0") + ", found '" +
                     text + "'");
  std::copy(found.begin(), found.end(), order.begin());
  return order;
}

template <int D>
std::string key_of(const Index<D>& order) {
  return D == 1 ? std::to_string(order[0]) : std::to_string(order[0]) + "," + std::to_string(order.back());
}

template <int D>
using Orders = std::pair<Index<D>, Index<D>>;

/// "0,1" on the line, "1,0;0,1" in the plane.
template <int D>
Orders<D> orders_of(const std::string& text) {
  auto rows = parse_integers("--inner-product", text);
  if (D == 1 && rows.size() == 1 && rows[0].size() == 2) rows = {{rows[0][0]}, {rows[0][1]}};
  if (rows.size() != 2)
    throw UsageError(std::string("--inner-product: expected ") + (D == 1 ? "r,s" : "orders as in 1,0;1,0") +
                     ", found '" + text + "'");
  return {order_of<D>("--inner-product", rows[0], text), order_of<D>("--inner-product", rows[1], text)};
}

template <int D>
std::string key_of(const Orders<D>& orders) {
  return key_of<D>(orders.first) + (D == 1 ? "," : ";") + key_of<D>(orders.second);
}

template <int D>
std::vector<Index<D>> usual_derivatives() {
  if constexpr (D == 1)
    return {{1}, {2}};
  else
    return {{1, 0}, {0, 1}};
}

template <int D>
std::vector<Orders<D>> usual_inner_products() {
  if constexpr (D == 1)
    return {{{0}, {0}}, {{0}, {1}}, {{1}, {1}}};
  else
    return {{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}, {{1, 0}, {0, 1}}};
}

/// What is asked, and whether a thing that does not exist is an error or left out.
template <int D>
struct Questions {
  bool values = false, smoothness = false;
  bool everything = false;
  std::vector<Index<D>> derivatives;
  std::vector<Orders<D>> inner_products;

  explicit Questions(const SchemeArguments& a) : values(a.values), smoothness(a.smoothness) {
    for (const std::string& text : a.derivatives) {
      const auto rows = parse_integers("--derivative", text);
      derivatives.push_back(order_of<D>("--derivative", rows.size() == 1 ? rows[0] : std::vector<int>{}, text));
    }
    for (const std::string& text : a.inner_products) inner_products.push_back(orders_of<D>(text));
    everything = !values && !smoothness && derivatives.empty() && inner_products.empty();
    if (!everything) return;
    values = true;
    smoothness = D == 1;
    derivatives = usual_derivatives<D>();
    inner_products = usual_inner_products<D>();
  }
};

/// The result of work(), or nothing if it does not exist and was not asked for by name.
template <class Work>
std::optional<Json> found(bool everything, Work&& work) {
  if (!everything) return work();
  try {
    return work();
  } catch (const InvalidInput&) {
    return {};
  }
}

template <int D>
Json smoothness_json(const Smoothness<D>& verdict, const SubdivisionScheme<D>& scheme) {
  Json json = {{"continuity", verdict.continuity}, {"certificate", explanation(verdict, scheme.arity())}};
  if (verdict.continuity < 0) return json;
  const auto bounds = hoelder_bounds(scheme);
  json["hoelder_lower"] = bounds.lower;
  json["hoelder_upper"] = bounds.upper;
  return json;
}

/// Throws InvalidInput if limits do not exist. Splines, which are limits of a weaker kind where they jump, are known
/// to.
template <int D>
void require_convergence(const SubdivisionScheme<D>& scheme, const Smoothness<D>& verdict) {
  if (verdict.continuity >= 0 || !verdict.is_decided() || !scheme.structure().directions.empty()) return;
  throw InvalidInput(scheme.name() +
                     " does not converge to continuous limits: " + explanation(verdict, scheme.arity()));
}

/// Splines that jump have values from the right, others the same from both sides.
template <int D>
Limit limit_of(const SubdivisionScheme<D>& scheme) {
  const auto& directions = scheme.structure().directions;
  return !directions.empty() && box_continuity(directions) < 0 ? Limit::FromRight : Limit::TwoSided;
}

template <int D>
void add_exact(const SubdivisionScheme<D>& scheme, const SchemeArguments& arguments, Json& json) {
  const Questions<D> asked(arguments);
  const auto degrees = polynomial_degrees(scheme.exact_mask(), scheme.arity());
  json["sum_rules"] = sum_rule_order(scheme.exact_mask(), scheme.arity());
  json["reproduction_degree"] = degrees.reproduced;
  const bool needs_limits = asked.values || !asked.derivatives.empty() || !asked.inner_products.empty();
  if (needs_limits) require_affine_invariance(scheme);
  std::optional<Smoothness<D>> verdict;
  if (asked.smoothness || (needs_limits && scheme.structure().directions.empty())) verdict = smoothness(scheme);
  if (needs_limits && verdict) require_convergence(scheme, *verdict);

  const Limit limit = limit_of(scheme);
  if (asked.values) json["values"] = polynomial_json(values_at_level(scheme, arguments.level, {}, limit));
  for (const auto& order : asked.derivatives) {
    const auto values = found(asked.everything,
                              [&] { return polynomial_json(values_at_level(scheme, arguments.level, order, limit)); });
    if (values) json["derivatives"][key_of<D>(order)] = *values;
  }
  for (const auto& orders : asked.inner_products) {
    const auto products = found(asked.everything, [&] {
      return polynomial_json(inner_products<D>({scheme, orders.first}, {scheme, orders.second}));
    });
    if (products) json["inner_products"][key_of<D>(orders)] = *products;
  }
  if (asked.smoothness) json["smoothness"] = smoothness_json(*verdict, scheme);
}

/// What is known of a scheme whose masks change from level to level, or are not rational.
template <int D>
void add_numeric(const SubdivisionScheme<D>& scheme, const SchemeArguments& arguments, Json& json) {
  const Questions<D> asked(arguments);
  if (!asked.everything && (!asked.derivatives.empty() || !asked.inner_products.empty() || asked.smoothness))
    throw InvalidInput(scheme.name() + " is not a stationary scheme with a rational mask: there are values only");
  const auto found = bounded_values_at_level(scheme, arguments.level);
  json["values"] = polynomial_json(found.values);
  json["values_error"] = found.error;
}

template <int D>
Json account_of(const SubdivisionScheme<D>& scheme, const SchemeArguments& arguments) {
  Json json = {{"name", scheme.name()}, {"dimension", D}, {"arity", scheme.arity()}};
  if (!scheme.is_stationary()) json["level"] = std::max(1, arguments.level);
  json["mask"] = scheme.is_exact() ? polynomial_json(scheme.exact_mask())
                                   : polynomial_json(scheme.mask(std::max(1, arguments.level)));
  json["support"] = support_json(scheme);
  scheme.is_exact() ? add_exact(scheme, arguments, json) : add_numeric(scheme, arguments, json);
  return json;
}

}  // namespace

std::string scheme_account(const AnyScheme& scheme, const SchemeArguments& arguments) {
  return std::visit([&](const auto& s) { return account_of(s, arguments).dump(2); }, scheme);
}

std::string mask_text(const AnyScheme& scheme, const SchemeArguments& arguments) {
  return std::visit(
      [&](const auto& s) {
        return s.is_exact() ? to_string(s.exact_mask()) : to_string(s.mask(std::max(1, arguments.level)));
      },
      scheme);
}

}  // namespace batten
