// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/energy.h>

#include <algorithm>
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
