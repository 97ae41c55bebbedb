// SPDX-License-Identifier: MIT
#ifdef BATTEN_WITH_VTK
#include <batten/domains/errors.h>
#include <batten/io/colour_map.h>
#include <batten/io/picture.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;
using Colour = std::array<int, 3>;
using View = PictureOptions::View;

constexpr Colour white = {255, 255, 255};

// The steepest channel of the colour map grows by 59 of 255 within 1/11 of the levels. One of 256 entries of the table
// is then 2.5, one of at least 300 pixels of a map or a bar 2.2, and rounding 1.
constexpr int tolerance = 6;

Colour colour_at(const Picture& picture, int column, int row) {
  const auto at = static_cast<std::size_t>(3 * (column + row * picture.width));
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

Colour level_colour(double level) {
  const auto colour = viridis(level);
  return {colour[0], colour[1], colour[2]};
}

int distance(const Colour& a, const Colour& b) {
  int largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

// The share of pixels in a box that are not white.
double inked_share(const Picture& picture, const Picture::Box& box) {
  int inked = 0;
  for (int row = box.top; row < box.bottom; ++row) {
    for (int column = box.left; column < box.right; ++column) inked += colour_at(picture, column, row) != white;
  }
  return inked / static_cast<double>((box.right - box.left) * (box.bottom - box.top));
}

Picture::Box whole(const Picture& picture) { return {0, 0, picture.width, picture.height}; }

// A function sampled on the unit square, 65 points a side, raised by `offset`.
GridSamples sampled(const std::function<double(double, double)>& f) {
  constexpr int n = 65;
  GridSamples grid;
  grid.points = {n, n};
  grid.spacing = {1.0 / (n - 1), 1.0 / (n - 1)};
  grid.arrays = {{"value", 1, {}}};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) grid.arrays[0].values.push_back(f(i * grid.spacing[0], j * grid.spacing[1]));
  }
  return grid;
}

double ramp(double x, double) { return 20 + 7 * x; }

PictureOptions map_options() {
  PictureOptions options;
  options.view = View::Map;
  options.width = 600;
  options.height = 450;
  return options;
}

// The column or row of the map where the point x or y of the unit square lies.
int column_of(const Picture& map, double x) {
  return map.plot.left + static_cast<int>(x * (map.plot.right - map.plot.left));
}
int row_of(const Picture& map, double y) {
  return map.plot.bottom - 1 - static_cast<int>(y * (map.plot.bottom - map.plot.top));
}

TEST(Map, has_the_colour_of_each_value) {
  const Picture map = draw_picture(sampled(ramp), {}, map_options());
  for (const double x : {0.02, 0.11, 0.33, 0.52, 0.63, 0.81, 0.98}) {
    for (const double y : {0.1, 0.5, 0.9}) {
      EXPECT_LE(distance(colour_at(map, column_of(map, x), row_of(map, y)), level_colour(x)), tolerance)
          << x << ' ' << y;
    }
  }
}

TEST(Map, has_y_upwards) {
  const Picture map = draw_picture(sampled([](double, double y) { return y; }), {}, map_options());
  EXPECT_LE(distance(colour_at(map, column_of(map, 0.5), row_of(map, 0.03)), level_colour(0.03)), tolerance);
  EXPECT_LE(distance(colour_at(map, column_of(map, 0.5), row_of(map, 0.97)), level_colour(0.97)), tolerance);
}

TEST(Map, has_contour_lines_at_round_values) {
  const Picture map = draw_picture(sampled(ramp), {}, map_options());
  const int row = row_of(map, 0.5);
  for (int value = 21; value <= 26; ++value) {
    const int column = column_of(map, (value - 20) / 7.0);
    int darkest = 255 * 3;
    for (int k = column - 2; k <= column + 2; ++k) {
      const Colour colour = colour_at(map, k, row);
      darkest = std::min(darkest, colour[0] + colour[1] + colour[2]);
    }
    const Colour beside = colour_at(map, column + 6, row);
    EXPECT_LT(darkest, 0.8 * (beside[0] + beside[1] + beside[2])) << value;
  }
}

TEST(Map, draws_one_value_in_bold_and_black) {
  PictureOptions options = map_options();
  options.bold_value = 23.3;
  const Picture map = draw_picture(sampled(ramp), {}, options);
  const int column = column_of(map, 3.3 / 7), row = row_of(map, 0.5);
  for (const int k : {column - 1, column, column + 1}) {
    const Colour colour = colour_at(map, k, row);
    EXPECT_LT(colour[0] + colour[1] + colour[2], 120);
  }
}

TEST(Map, has_the_proportions_of_the_region) {
  const auto proportion = [](const Picture& map) {
    return (map.plot.right - map.plot.left) / static_cast<double>(map.plot.bottom - map.plot.top);
  };
  PictureOptions options = map_options();
  EXPECT_NEAR(proportion(draw_picture(sampled(ramp), {}, options)), 1, 0.01);
  options.y_scale = 2;
  EXPECT_NEAR(proportion(draw_picture(sampled(ramp), {}, options)), 0.5, 0.01);
}

TEST(Map, leaves_blank_values_empty) {
  const auto with_hole = [](double x, double y) { return std::hypot(x - 0.5, y - 0.5) < 0.2 ? std::nan("") : x; };
  const Picture map = draw_picture(sampled(with_hole), {}, map_options());
  EXPECT_EQ(colour_at(map, column_of(map, 0.5), row_of(map, 0.5)), white);
  EXPECT_NE(colour_at(map, column_of(map, 0.5), row_of(map, 0.8)), white);
  // A disc of radius 0.2, seen up to half a cell more or less.
  EXPECT_NEAR(1 - inked_share(map, map.plot), 3.14159 * 0.04, 0.03);
}

TEST(Map, has_dots_at_the_data_points_inside) {
  ScatteredSamples points;
  points.x = {0.25, 0.7, 3};
  points.y = {0.75, 0.2, 0.5};
  points.z = {1, 1, 1};
  const Picture map = draw_picture(sampled(ramp), points, map_options());
  for (const std::size_t i : {0, 1}) {
    const Colour colour = colour_at(map, column_of(map, points.x[i]), row_of(map, points.y[i]));
    EXPECT_LE(distance(colour, {13, 13, 13}), tolerance);
  }
}

TEST(Map, does_not_depend_on_large_offsets) {
  const auto far_away = [](double x, double y) { return 1e9 + 1e-3 * ramp(x, y); };
  GridSamples grid = sampled(far_away);
  grid.origin = {2667400, 6478700};
  const Picture map = draw_picture(grid, {}, map_options());
  for (const double x : {0.04, 0.47, 0.96}) {
    EXPECT_LE(distance(colour_at(map, column_of(map, x), row_of(map, 0.4)), level_colour(x)), tolerance) << x;
  }
}

// A level line through the middle, from x = 0.2 to 0.8.
PictureOptions with_line(PictureOptions::Heads heads) {
  PictureOptions options = map_options();
  options.contours = false;
  options.heads = heads;
  options.curves = {{.x = {0.2, 0.8}, .y = {0.5, 0.5}}};
  return options;
}

// How many pixels around (x, 0.5) are white.
int white_around(const Picture& map, double x) {
  int count = 0;
  for (int row = row_of(map, 0.5) - 12; row <= row_of(map, 0.5) + 12; ++row)
    for (int column = column_of(map, x) - 12; column <= column_of(map, x) + 12; ++column)
      count += colour_at(map, column, row) == white;
  return count;
}

TEST(Map, has_white_curves_with_dark_edges) {
  const Picture map = draw_picture(sampled(ramp), {}, with_line(PictureOptions::Heads::End));
  for (const double x : {0.25, 0.4, 0.6}) {
    int lightest = 0, darkest = 255 * 3;
    for (int row = row_of(map, 0.5) - 4; row <= row_of(map, 0.5) + 4; ++row) {
      const Colour c = colour_at(map, column_of(map, x), row);
      lightest = std::max(lightest, c[0] + c[1] + c[2]);
      darkest = std::min(darkest, c[0] + c[1] + c[2]);
    }
    const Colour ground = level_colour(x);
    EXPECT_EQ(lightest, 255 * 3) << x;
    EXPECT_LT(darkest, 0.7 * (ground[0] + ground[1] + ground[2])) << x;
    EXPECT_LE(distance(colour_at(map, column_of(map, x), row_of(map, 0.5) - 8), ground), tolerance) << x;
  }
  EXPECT_EQ(white_around(map, 0.1), 0);
}

TEST(Map, shows_the_direction_of_curves_by_heads) {
  const Picture ends = draw_picture(sampled(ramp), {}, with_line(PictureOptions::Heads::End));
  EXPECT_GT(white_around(ends, 0.8), white_around(ends, 0.2) + 4);
  PictureOptions options = with_line(PictureOptions::Heads::End);
  std::reverse(options.curves[0].x.begin(), options.curves[0].x.end());
  const Picture reversed = draw_picture(sampled(ramp), {}, options);
  EXPECT_GT(white_around(reversed, 0.2), white_around(reversed, 0.8) + 4);
  const Picture along = draw_picture(sampled(ramp), {}, with_line(PictureOptions::Heads::Along));
  EXPECT_NEAR(white_around(along, 0.2), white_around(along, 0.8), 4);
}

TEST(Map, leaves_out_what_of_a_curve_is_outside) {
  PictureOptions options = with_line(PictureOptions::Heads::End);
  options.curves = {{.x = {0.4, 0.6, 1.5, 1.5}, .y = {0.5, 0.5, 0.5, 0.9}}};
  const Picture map = draw_picture(sampled(ramp), {}, options);
  options.curves = {{.x = {0.4, 0.6}, .y = {0.5, 0.5}}};
  EXPECT_EQ(map.rgb, draw_picture(sampled(ramp), {}, options).rgb);
}

TEST(ColourBar, spans_the_data) {
  for (const View view : {View::Map, View::Surface}) {
    PictureOptions options = map_options();
    options.view = view;
    const Picture picture = draw_picture(sampled(ramp), {}, options);
    EXPECT_THAT(picture.range, ElementsAre(20, 27));
    EXPECT_EQ(picture.bar_labels.front(), "20.0");
    EXPECT_EQ(picture.bar_labels.back(), "27.0");
    const auto& bar = picture.colour_bar;
    const int column = (bar.left + bar.right) / 2, height = bar.bottom - bar.top;
    EXPECT_GE(height, 250);
    for (const double level : {0.02, 0.25, 0.5, 0.75, 0.98}) {
      const int row = bar.bottom - 1 - static_cast<int>(level * height);
      EXPECT_LE(distance(colour_at(picture, column, row), level_colour(level)), tolerance) << level;
    }
  }
}

TEST(ColourBar, spans_the_whole_grid_where_the_picture_thins_it) {
  GridSamples grid;
  grid.points = {2500, 3};
  grid.arrays = {{"value", 1, std::vector<double>(7500, 1)}};
  grid.arrays[0].values[1] = -5;
  grid.arrays[0].values[3004] = 8;
  EXPECT_THAT(draw_picture(grid, {}, map_options()).range, ElementsAre(-5, 8));
}

TEST(Surface, fills_a_good_part_of_the_picture_and_shows_the_colours_of_its_values) {
  const auto hill = [](double x, double y) { return std::exp(-8 * (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2))); };
  PictureOptions options = map_options();
  options.view = View::Surface;
  const Picture picture = draw_picture(sampled(hill), {}, options);
  EXPECT_EQ(picture.rgb.size(), 3u * 600 * 450);
  const double share = inked_share(picture, picture.plot);
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 0.9);
  // The top, yellow, is in the middle and above the foot, violet, at the near corner.
  int first_yellow = picture.height, last_violet = 0;
  for (int row = picture.plot.top; row < picture.plot.bottom; ++row) {
    for (int column = picture.plot.left; column < picture.plot.right; ++column) {
      const Colour colour = colour_at(picture, column, row);
      if (colour[0] > 180 && colour[1] > 160 && colour[2] < 100) first_yellow = std::min(first_yellow, row);
      if (colour[2] > colour[1] + 30) last_violet = std::max(last_violet, row);
    }
  }
  EXPECT_LT(first_yellow, picture.height / 2);
  EXPECT_GT(last_violet, 0.75 * picture.height);
}

// The share of the outermost pixels that are not white.
double inked_share_of_frame(const Picture& picture) {
  constexpr int frame = 2;
  const int width = picture.width, height = picture.height;
  return inked_share(picture, {0, 0, width, frame}) + inked_share(picture, {0, height - frame, width, height}) +
         inked_share(picture, {0, 0, frame, height}) + inked_share(picture, {width - frame, 0, width, height});
}

class Labels : public ::testing::TestWithParam<std::tuple<View, std::array<int, 2>, double>> {};

TEST_P(Labels, stay_inside_the_picture) {
  PictureOptions options;
  options.title = "A title that is far too long for the picture that it is written over in large letters";
  options.x_name = "easting in metres";
  options.y_name = "northing in metres";
  options.value_name = "height above mean sea level in metres";
  options.view = std::get<0>(GetParam());
  options.width = std::get<1>(GetParam())[0];
  options.height = std::get<1>(GetParam())[1];
  options.y_scale = std::get<2>(GetParam());
  GridSamples grid = sampled(ramp);
  grid.origin = {2667400, 6478700};
  EXPECT_EQ(inked_share_of_frame(draw_picture(grid, {}, options)), 0);
}

INSTANTIATE_TEST_SUITE_P(Views, Labels,
                         ::testing::Combine(::testing::Values(View::Map, View::Surface),
                                            ::testing::Values(std::array{1200, 900}, std::array{400, 300},
                                                              std::array{300, 800}),
                                            ::testing::Values(1.0, 0.1, 8.0)));

TEST(Picture, shows_a_constant) {
  for (const View view : {View::Map, View::Surface}) {
    PictureOptions options = map_options();
    options.view = view;
    const Picture picture = draw_picture(sampled([](double, double) { return 3.5; }), {}, options);
    EXPECT_THAT(picture.range, ElementsAre(3.5, 3.5));
    EXPECT_GT(inked_share(picture, whole(picture)), 0.1);
  }
}

TEST(Picture, is_the_same_each_time) {
  EXPECT_EQ(draw_picture(sampled(ramp), {}, map_options()).rgb, draw_picture(sampled(ramp), {}, map_options()).rgb);
}

TEST(Picture, is_written_as_png_of_the_size_asked_for) {
  const TemporaryFolder folder;
  write_picture(folder / "a.png", sampled(ramp), {}, map_options());
  const std::string bytes = bytes_of(folder / "a.png");
  ASSERT_GT(bytes.size(), 33u);
  EXPECT_THAT(bytes, StartsWith("\x89PNG\r\n\x1A\n"));
  const auto number = [&](std::size_t at) {  // of four bytes, the highest first
    unsigned value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = 256 * value + static_cast<unsigned char>(bytes[at + k]);
    return value;
  };
  EXPECT_EQ(number(16), 600u);
  EXPECT_EQ(number(20), 450u);
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
  EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

TEST(Picture, refuses_what_it_cannot_show) {
  const auto message = [](const GridSamples& grid, const PictureOptions& options) {
    return message_of<InvalidInput>([&] { draw_picture(grid, {}, options); });
  };
  PictureOptions options = map_options();
  EXPECT_EQ(message(sampled([](double, double) { return std::nan(""); }), options),
            "draw_picture: array 'value' has no finite value");
  options.array = "height";
  EXPECT_EQ(message(sampled(ramp), options), "draw_picture: the grid has no array 'height' with one component");
  options = map_options();
  options.width = 10;
  EXPECT_EQ(message(sampled(ramp), options),
            "draw_picture: width and height must be from 200 to 16000 pixels, found 10");
  options = map_options();
  options.y_scale = 0;
  EXPECT_EQ(message(sampled(ramp), options), "draw_picture: y_scale must be positive");
  options = map_options();
  options.curves = {{.x = {0.2, 0.8}, .y = {0.5}}};
  EXPECT_EQ(message(sampled(ramp), options), "draw_picture: x and y of a curve must have equal lengths, found 2 and 1");
  EXPECT_EQ(message_of<IoError>([] { write_picture("no/a.png", sampled(ramp), {}, map_options()); }),
            "no/a.png: the output folder no does not exist");
}

}  // namespace
}  // namespace batten
#endif
