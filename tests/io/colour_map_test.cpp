// SPDX-License-Identifier: MIT
#include <batten/io/colour_map.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using ::testing::ElementsAre;

// CIE lightness L* of an sRGB colour (IEC 61966-2-1).
double lightness(const std::array<std::uint8_t, 3>& colour) {
  const auto linear = [](std::uint8_t byte) {
    const double c = byte / 255.;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double luminance = 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
  return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
}

TEST(ColourMap, has_the_published_ends) {
  EXPECT_THAT(viridis(0), ElementsAre(68, 1, 84));
  EXPECT_THAT(viridis(1), ElementsAre(253, 231, 37));
  EXPECT_EQ(viridis(-1), viridis(0));
  EXPECT_EQ(viridis(2), viridis(1));
}

TEST(ColourMap, grows_evenly_in_lightness) {
  constexpr int steps = 20;
  const double mean = (lightness(viridis(1)) - lightness(viridis(0))) / steps;
  for (int k = 0; k < steps; ++k) {
    const double growth = lightness(viridis((k + 1.) / steps)) - lightness(viridis(static_cast<double>(k) / steps));
    EXPECT_GT(growth, 0.5 * mean);
    EXPECT_LT(growth, 1.5 * mean);
  }
}

}  // namespace
}  // namespace batten
