// SPDX-License-Identifier: MIT
#ifdef BATTEN_WITH_VTK
#include <batten/domains/errors.h>
#include <batten/io/chart.h>
#include <batten/io/curve_file.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/io/vtk_text.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Colour = std::array<std::uint8_t, 3>;

CurveSamples parabola(std::string name) {
  CurveSamples curve{.name = std::move(name)};
  for (int i = 0; i <= 100; ++i) {
    curve.x.push_back(i / 50. - 1);
    curve.y.push_back(curve.x.back() * curve.x.back());
    curve.z.push_back(0);
  }
  return curve;
}

ChartOptions small() {
  ChartOptions options;
  options.width = 500;
  options.height = 400;
  return options;
}

Colour colour_at(const Chart& chart, double column, double row) {
  const auto at = static_cast<std::size_t>(3 * (std::lround(column) + std::lround(row) * chart.width));
  return {chart.rgb[at], chart.rgb[at + 1], chart.rgb[at + 2]};
}

/// Whether the line's colour is seen within two pixels of the place (x, y) of the axes.
bool shows(const Chart& chart, double x, double y, const Colour& colour) {
  const double column =
      chart.plot[0] + (chart.plot[1] - chart.plot[0]) * (x - chart.range[0]) / (chart.range[1] - chart.range[0]);
  const double row =
      chart.plot[3] - (chart.plot[3] - chart.plot[2]) * (y - chart.range[2]) / (chart.range[3] - chart.range[2]);
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      if (colour_at(chart, column + i, row + j) == colour) return true;
  return false;
}

TEST(Chart, draws_each_line_at_its_place_in_its_colour) {
  ChartLine dots{parabola(""), ChartLine::Style::Dots};
  for (double& y : dots.curve.y) y = 1 - y;
  const Chart chart = draw_chart(std::array{ChartLine{parabola("first")}, dots}, small());
  ASSERT_EQ(chart.rgb.size(), 3u * 500 * 400);
  for (double x : {-0.9, -0.3, 0., 0.5, 0.8}) {
    EXPECT_TRUE(shows(chart, x, x * x, chart.line_colour[0])) << x;
    EXPECT_TRUE(shows(chart, x, 1 - x * x, chart.line_colour[1])) << x;
    EXPECT_FALSE(shows(chart, x, 0.5, chart.line_colour[0])) << x;
  }
}

TEST(Chart, closes_closed_lines_and_interrupts_lines_at_nan) {
  CurveSamples square{.name = "square", .x = {0, 1, 1, 0}, .y = {0, 0, 1, 1}, .z = {0, 0, 0, 0}, .closed = true};
  CurveSamples broken{.x = {0.2, 0.4, 0.5, 0.6, 0.8}, .y = {0.5, 0.5, std::nan(""), 0.5, 0.5}};
  const Chart chart = draw_chart(std::array{ChartLine{square}, ChartLine{broken}}, small());
  EXPECT_TRUE(shows(chart, 0, 0.5, chart.line_colour[0]));
  EXPECT_TRUE(shows(chart, 0.3, 0.5, chart.line_colour[1]));
  EXPECT_FALSE(shows(chart, 0.5, 0.5, chart.line_colour[1]));
}

TEST(Chart, keeps_circles_round_when_asked) {
  ChartOptions options = small();
  options.equal_scale = true;
  const Chart chart = draw_chart(std::array{ChartLine{parabola("")}}, options);
  EXPECT_NEAR((chart.range[1] - chart.range[0]) / (chart.plot[1] - chart.plot[0]),
              (chart.range[3] - chart.range[2]) / (chart.plot[3] - chart.plot[2]), 1e-12);
}

TEST(Chart, refuses_what_it_cannot_draw) {
  const TemporaryFolder folder;
  CurveSamples curve = parabola("p");
  curve.y.pop_back();
  EXPECT_EQ(message_of<InvalidInput>([&] { draw_chart(std::array{ChartLine{curve}}, small()); }),
            "draw_chart: x and y of 'p' must have equal lengths, found 101 and 100");
  EXPECT_EQ(message_of<InvalidInput>([&] { write_chart(folder / "a.png", {}, small()); }),
            "draw_chart: there is no finite value to draw");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(CurveFile, has_one_polyline_for_each_curve) {
  const TemporaryFolder folder;
  CurveSamples square{.name = "square", .x = {0, 1, 1, 0}, .y = {0, 0, 1, 1}, .z = {0, 0, 0, 5}, .closed = true};
  CurveSamples line{.name = "line", .x = {2, 3}, .y = {4, 5}, .z = {6, 7}};
  square.arrays = {{"t", 1, {1, 2, 3, 4}}};
  line.arrays = {{"t", 1, {5, 6}}};
  write_curves(folder / "a.vtp", std::array{square, line});
  const std::string file = bytes_of(folder / "a.vtp");
  EXPECT_EQ(attribute(tag_with(file, "<Piece"), "NumberOfLines"), "2");
  EXPECT_THAT(appended_array<double>(file, "Points"),
              ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 5, 2, 4, 6, 3, 5, 7));
  EXPECT_THAT(appended_array<double>(file, "t"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(appended_array<double>(file, "curve"), ElementsAre(0, 1));
  line.arrays.clear();
  EXPECT_EQ(message_of<InvalidInput>([&] {
              write_curves(folder / "b.vtp", std::array{square, line});
            }),
            "write_curves: 'line' must have the arrays of 'square', with a value for each of its points");
}

}  // namespace
}  // namespace batten
#endif
