// SPDX-License-Identifier: MIT
#include <batten/app/quotient_account.h>
#include <batten/app/usage_error.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/quotient_coefficients.h>
#include <batten/domains/errors.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

constexpr int usual_size = 9;

int half_of(const SchemeArguments& a) {
  const int size = a.size.value_or(usual_size);
  if (size < 1 || size % 2 == 0)
    throw InvalidInput("--size: the number of coefficients in each direction must be odd and at least 1, found " +
                       std::to_string(size));
  return (size - 1) / 2;
}

/// The power of the first of n coefficients whose middle, for even n the later one, belongs to the power 0.
int first_power(int n) { return -(n / 2); }

int columns_of(const std::string& text) {
  const std::string row = text.substr(0, text.find(';'));
  return 1 + static_cast<int>(std::count(row.begin(), row.end(), ','));
}

Json line_quotient(const SchemeArguments& a, int half) {
  const auto mask = [](const std::string& text) { return parse_mask(text, first_power(columns_of(text))); };
  const auto c = quotient_coefficients(mask(*a.numerator), mask(*a.denominator), IndexBox<1>{{-half}, {half}});
  Json coefficients = Json::array();
  for (int i = -half; i <= half; ++i) coefficients.push_back(c[i]);
  return {{"offset", -half}, {"coefficients", coefficients}};
}

Json plane_quotient(const SchemeArguments& a, int half) {
  const auto mask = [](const std::string& text) {
    const auto rows = 1 + static_cast<int>(std::count(text.begin(), text.end(), ';'));
    return parse_mask2(text, {first_power(columns_of(text)), first_power(rows)});
  };
  const auto c =
      quotient_coefficients(mask(*a.numerator), mask(*a.denominator), IndexBox<2>{{-half, -half}, {half, half}});
  Json rows = Json::array();
  for (int j = -half; j <= half; ++j) {
    Json row = Json::array();
    for (int i = -half; i <= half; ++i) row.push_back(c[{i, j}]);
    rows.push_back(row);
  }
  return {{"offset", {-half, -half}}, {"coefficients", rows}};
}

}  // namespace

std::string quotient_account(const SchemeArguments& arguments) {
  if (!arguments.numerator || !arguments.denominator) throw UsageError("quotient needs --numerator and --denominator");
  const int half = half_of(arguments);
  const bool plane = arguments.denominator->find(';') != std::string::npos;
  Json json = {{"name", "quotient"}, {"dimension", plane ? 2 : 1}};
  json["quotient"] = plane ? plane_quotient(arguments, half) : line_quotient(arguments, half);
  return json.dump(2);
}

}  // namespace batten
