// SPDX-License-Identifier: MIT
#include <batten/io/axis_ticks.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> labels(double low, double high, int most) {
  std::vector<std::string> labels;
  for (const Tick& tick : nice_ticks(low, high, most)) labels.push_back(tick.label);
  return labels;
}

TEST(Ticks, are_multiples_of_one_two_or_five_times_a_power_of_ten) {
  EXPECT_THAT(labels(94, 195, 9), ElementsAre("100", "120", "140", "160", "180"));
  EXPECT_THAT(labels(0, 1, 6), ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels(-0.3, 0.3, 4), ElementsAre("-0.2", "0.0", "0.2"));
  EXPECT_THAT(labels(0, 1, 3), ElementsAre("0.0", "0.5", "1.0"));
  EXPECT_THAT(labels(0, 1, 2), ElementsAre("0", "1"));
}

TEST(Ticks, tell_close_and_large_numbers_apart) {
  EXPECT_THAT(labels(1e6, 1e6 + 0.4, 5), ElementsAre("1000000.0", "1000000.1", "1000000.2", "1000000.3", "1000000.4"));
  EXPECT_THAT(labels(0, 3e9, 4), ElementsAre("0", "1e+09", "2e+09", "3e+09"));
  EXPECT_THAT(labels(2.5e-9, 4e-9, 4), ElementsAre("2.5e-09", "3e-09", "3.5e-09", "4e-09"));
}

class TickRange : public ::testing::TestWithParam<std::tuple<double, double, int>> {};

TEST_P(TickRange, holds_its_ticks_and_no_more_than_asked_for) {
  const auto [low, length, most] = GetParam();
  const std::vector<Tick> ticks = nice_ticks(low, low + length, most);
  EXPECT_LE(ticks.size(), static_cast<std::size_t>(most));
  for (const Tick& tick : ticks) {
    EXPECT_GE(tick.value, low - 1e-8 * length);
    EXPECT_LE(tick.value, low + length * (1 + 1e-8));
  }
}

INSTANTIATE_TEST_SUITE_P(Ticks, TickRange,
                         ::testing::Combine(::testing::Values(-17.3, 0.0, 1e-3, 251.7),
                                            ::testing::Values(1e-5, 0.37, 1.0, 1e4), ::testing::Values(2, 5, 9)));

TEST(Ticks, are_none_for_a_single_value) { EXPECT_THAT(nice_ticks(3, 3, 9), IsEmpty()); }

}  // namespace
}  // namespace batten
