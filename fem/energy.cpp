// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/energy.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {

Energy Energy::thin_plate() { return tension(0); }
Energy Energy::membrane() { return tension(1); }
Energy Energy::third_derivatives() { return sum_of({{1, 3, 0}, {3, 2, 1}, {3, 1, 2}, {1, 0, 3}}); }

Energy Energy::tension(double tension) {
  if (!(tension >= 0 && tension <= 1))
    throw InvalidInput("Energy::tension: expected a tension from 0 to 1, found " + std::to_string(tension));
  std::vector<Term> terms;
  if (tension < 1) terms = {{1 - tension, 2, 0}, {2 * (1 - tension), 1, 1}, {1 - tension, 0, 2}};
  if (tension > 0) terms.insert(terms.end(), {{tension, 1, 0}, {tension, 0, 1}});
  return Energy(std::move(terms));
}

Energy Energy::sum_of(std::vector<Term> terms) {
  if (terms.empty()) throw InvalidInput("Energy::sum_of: expected at least one term, found none");
  for (const Term& t : terms) {
    if (!std::isfinite(t.weight) || t.weight <= 0)
      throw InvalidInput("Energy::sum_of: expected finite positive weights, found " + std::to_string(t.weight));
    if (t.x_order < 0 || t.y_order < 0 || t.x_order > 3 || t.y_order > 3 || t.x_order + t.y_order == 0)
      throw InvalidInput("Energy::sum_of: expected orders from 0 to 3, not both 0, found " + std::to_string(t.x_order) +
                         " and " + std::to_string(t.y_order));
  }
  return Energy(std::move(terms));
}

namespace {

void expect_finite(const char* function, const char* rule, bool holds, double found) {
  if (!holds || !std::isfinite(found))
    throw InvalidInput(std::string(function) + ": expected " + rule + ", found " + std::to_string(found));
}

}  // namespace

Energy Energy::conduction(double k, double c) {
  expect_finite("Energy::conduction", "k > 0", k > 0, k);
  expect_finite("Energy::conduction", "c >= 0", c >= 0, c);
  std::vector<Term> terms = {{k, 1, 0}, {k, 0, 1}};
  if (c > 0) terms.push_back({c, 0, 0});
  return Energy(std::move(terms));
}

Energy Energy::plate(const Plate& p) {
  expect_finite("Energy::plate", "a rigidity > 0", p.rigidity > 0, p.rigidity);
  expect_finite("Energy::plate", "-1 <= Poisson's ratio <= 0.5", p.poisson_ratio >= -1 && p.poisson_ratio <= 0.5,
                p.poisson_ratio);
  expect_finite("Energy::plate", "a tension >= 0", p.tension >= 0, p.tension);
  expect_finite("Energy::plate", "a foundation >= 0", p.foundation >= 0, p.foundation);
  std::vector<Term> terms = {{p.rigidity, 2, 0}, {2 * p.rigidity, 1, 1}, {p.rigidity, 0, 2}};
  if (p.tension > 0) terms.insert(terms.end(), {{p.tension, 1, 0}, {p.tension, 0, 1}});
  if (p.foundation > 0) terms.push_back({p.foundation, 0, 0});
  return Energy(std::move(terms), p.poisson_ratio * p.rigidity);
}

Energy Energy::scaled(double length) const {
  Energy result = *this;
  for (auto& t : result.terms_) t.weight *= std::pow(length, 2 - 2 * (t.x_order + t.y_order));
  result.curvature_ *= std::pow(length, -2);
  return result;
}

int Energy::order() const {
  int order = 0;
  for (const auto& t : terms_) order = std::max(order, t.x_order + t.y_order);
  return order;
}

int Energy::null_degree() const {
  int least = 3;
  for (const auto& t : terms_) least = std::min(least, t.x_order + t.y_order);
  return least - 1;
}

}  // namespace batten
