// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/energy.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {

Energy Energy::thin_plate() { return tension(0); }
Energy Energy::membrane() { return tension(1); }

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
    if (t.x_order < 0 || t.y_order < 0 || t.x_order > 2 || t.y_order > 2 || t.x_order + t.y_order == 0)
      throw InvalidInput("Energy::sum_of: expected orders from 0 to 2, not both 0, found " + std::to_string(t.x_order) +
                         " and " + std::to_string(t.y_order));
  }
  return Energy(std::move(terms));
}

int Energy::order() const {
  int order = 0;
  for (const auto& t : terms_) order = std::max(order, t.x_order + t.y_order);
  return order;
}

int Energy::null_degree() const {
  const bool has_gradient =
      std::any_of(terms_.begin(), terms_.end(), [](const Term& t) { return t.x_order + t.y_order == 1; });
  return has_gradient ? 0 : 1;
}

}  // namespace batten
