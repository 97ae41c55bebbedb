// SPDX-License-Identifier: MIT
#include <batten/bases/staggered_field.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Of 4 x 3 cells from (-1, 2), spacing 1/2.
template <class U, class V>
StaggeredField field_of(U&& u, V&& v) {
  StaggeredField field{Eigen::MatrixXd(5, 3), Eigen::MatrixXd(4, 4), {-1, 2}, 0.5};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 5; ++i) field.u(i, j) = u(-1 + 0.5 * i, 2 + 0.5 * (j + 0.5));
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) field.v(i, j) = v(-1 + 0.5 * (i + 0.5), 2 + 0.5 * j);
  return field;
}

template <class F>
void expect_values(const ControlGrid& grid, std::size_t component, F&& f) {
  const Eigen::MatrixXd& values = grid.components.at(component);
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const double x = grid.start[0] + static_cast<double>(i) * grid.spacing[0];
      const double y = grid.start[1] + static_cast<double>(j) * grid.spacing[1];
      EXPECT_NEAR(values(i, j), f(x, y), 1e-14) << x << ", " << y;
    }
}

TEST(StaggeredField, is_differenced_and_averaged_at_the_right_places) {
  // Averages are exact for functions that are linear along the averaged direction, centred differences for quadratics.
  const auto u = [](double x, double y) { return 1 + x * x + 3 * x * y; };
  const auto v = [](double x, double y) { return -2 + y * y - x * y; };
  const StaggeredField field = field_of(u, v);
  const ControlGrid vertices = vertex_averages(field), divergence_ = divergence(field), rotation_ = rotation(field);
  ASSERT_EQ(vertices.components[0].rows(), 3);
  ASSERT_EQ(vertices.components[0].cols(), 2);
  EXPECT_EQ(vertices.start, (std::array<double, 2>{-0.5, 2.5}));
  expect_values(vertices, 0, u);
  expect_values(vertices, 1, v);
  ASSERT_EQ(divergence_.components[0].size(), 12);
  expect_values(divergence_, 0, [](double x, double y) { return 2 * x + 3 * y + 2 * y - x; });
  ASSERT_EQ(rotation_.components[0].size(), 6);
  expect_values(rotation_, 0, [](double x, double y) { return 3 * x + y; });
}

TEST(StaggeredField, comes_from_vertices_by_averages) {
  ControlGrid vertices{
      .components = {Eigen::MatrixXd(5, 4), Eigen::MatrixXd(5, 4)}, .start = {-1, 2}, .spacing = {0.5, 0.5}};
  const auto u = [](double x, double y) { return x * x + x * y; };
  const auto v = [](double x, double y) { return y * y - x * y; };
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i) {
      vertices.components[0](i, j) = u(-1 + 0.5 * i, 2 + 0.5 * j);
      vertices.components[1](i, j) = v(-1 + 0.5 * i, 2 + 0.5 * j);
    }
  const StaggeredField found = from_vertices(vertices), expected = field_of(u, v);
  EXPECT_LE((found.u - expected.u).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE((found.v - expected.v).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(found.start, expected.start);
  EXPECT_EQ(found.spacing, 0.5);
  vertices.spacing[1] = 1;
  EXPECT_THAT([&] { from_vertices(vertices); },
              ThrowsMessage<InvalidInput>(HasSubstr("cells must be square, found the spacing 0.5 in x and 1 in y")));
}

TEST(StaggeredField, is_padded_and_cropped) {
  const StaggeredField field =
      field_of([](double x, double y) { return x + 10 * y; }, [](double x, double y) { return x - 10 * y; });
  for (FieldSides sides : {FieldSides::Zero, FieldSides::Nearest}) {
    const StaggeredField wide = padded(field, 3, sides);
    EXPECT_EQ(wide.cells_x(), 10);
    EXPECT_EQ(wide.cells_y(), 9);
    EXPECT_EQ(wide.start, (std::array<double, 2>{-2.5, 0.5}));
    EXPECT_EQ(wide.u(0, 0), sides == FieldSides::Zero ? 0 : field.u(0, 0));
    EXPECT_EQ(wide.v(9, 9), sides == FieldSides::Zero ? 0 : field.v(3, 3));
    const StaggeredField again = cropped(wide, 3);
    EXPECT_EQ(again.u, field.u);
    EXPECT_EQ(again.v, field.v);
    EXPECT_EQ(again.start, field.start);
  }
  EXPECT_THAT([&] { cropped(field, 2); }, ThrowsMessage<InvalidInput>(HasSubstr("leaves none of 4 x 3")));
}

TEST(StaggeredField, must_fit_its_cells) {
  StaggeredField field{Eigen::MatrixXd::Zero(3, 3), Eigen::MatrixXd::Zero(3, 3)};
  EXPECT_THAT([&] { divergence(field); },
              ThrowsMessage<InvalidInput>(HasSubstr("divergence: u must have (nx+1) x ny values and v nx x (ny+1)")));
  field.u.resize(4, 2);
  field.u.setConstant(std::numeric_limits<double>::infinity());
  EXPECT_THAT([&] { rotation(field); }, ThrowsMessage<InvalidInput>(HasSubstr("must be finite")));
  field.u.setZero();
  field.spacing = 0;
  EXPECT_THAT([&] { divergence(field); }, ThrowsMessage<InvalidInput>(HasSubstr("the spacing must be positive")));
}

}  // namespace
}  // namespace batten
