// SPDX-License-Identifier: MIT
#include <batten/app/option_checks.h>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <concepts>

namespace batten {
namespace {

// Accepts the numbers that `test` does, and says of all others that they are not `what`.
template <std::predicate<double> Test>
CLI::Validator number_that(Test test, const std::string& what) {
  const auto check = [test, what](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && test(*value) ? std::string() : "'" + text + "' is not " + what;
  };
  return CLI::Validator(check, "");
}

}  // namespace

std::optional<double> finite_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

CLI::Option* must_be_finite(CLI::Option* option) {
  return option->check(number_that([](double) { return true; }, "a finite number"));
}

CLI::Option* must_be_positive(CLI::Option* option) {
  return option->check(number_that([](double v) { return v > 0; }, "a positive number"));
}

CLI::Option* must_be_fraction(CLI::Option* option) {
  return option->check(number_that([](double v) { return v >= 0 && v <= 1; }, "a number from 0 to 1"));
}

CLI::Option* must_be_whole(CLI::Option* option) {
  // CLI11 reads "-1" as a large unsigned number.
  const auto digits = [](const std::string& text) {
    if (text.find_first_not_of("0123456789") == std::string::npos) return std::string();
    return "'" + text + "' is not a whole number >= 0";
  };
  return option->check(CLI::Validator(digits, ""));
}

}  // namespace batten
