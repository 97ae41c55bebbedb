// SPDX-License-Identifier: MIT
#include <batten/app/constraint_report.h>
#include <batten/domains/number_text.h>

#include <nlohmann/json.hpp>

namespace batten {

std::string constraint_json(const std::optional<ConstraintAccount>& account) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["energy_gap"] = account ? Json(account->energy_gap) : Json();
  json["largest_violation"] = account ? Json(account->largest_violation) : Json();
  json["least_tolerance"] = account && account->least_tolerance ? Json(*account->least_tolerance) : Json();
  json["active"] = account ? Json(account->active) : Json();
  json["cycles"] = account ? Json(account->cycles) : Json();
  return json.dump();
}

std::string constraint_text(const std::optional<ConstraintAccount>& account) {
  if (!account || account->least_tolerance) return {};
  constexpr double percent = 100;
  constexpr int digits = 2;
  return ", " + std::to_string(account->active) + " active constraints, at most " +
         number_text(percent * account->energy_gap, digits) + " % above the least";
}

}  // namespace batten
