// SPDX-License-Identifier: MIT
#include <batten/bases/affine_maps.h>
#include <batten/bases/bezier.h>
#include <batten/domains/errors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using Triangle = Eigen::Matrix<double, 3, 2>;

double area(const Eigen::MatrixXd& t) {
  const Eigen::RowVector2d u = t.row(1) - t.row(0), v = t.row(2) - t.row(0);
  return std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
}

Triangle equilateral() { return (Triangle() << 0, 0, 0.5, std::sqrt(3.) / 2, 1, 0).finished(); }

TEST(AffineMaps, relate_two_triangles_by_barycentric_coordinates) {
  // [Warren & Weimer 2001, sec. 1.2.1]: half the triangle about its first vertex
  const Triangle p = (Triangle() << 0, 0, 2, 0, 1, 1).finished(), q = (Triangle() << 0, 0, 1, 0, .5, .5).finished();
  const Eigen::Matrix3d S = affine_map(p, q);
  EXPECT_TRUE(S.isApprox((Eigen::Matrix3d() << 1, 0, 0, .5, .5, 0, .5, 0, .5).finished(), 1e-15)) << S;
  EXPECT_TRUE((S * p).isApprox(q, 1e-15));
  EXPECT_TRUE(S.rowwise().sum().isOnes(1e-15));
  EXPECT_TRUE(barycentric_coordinates(p.row(1), p).isApprox(Eigen::RowVector3d(0, 1, 0), 1e-15));
  const Triangle flat = (Triangle() << 0, 0, 1, 1, 2, 2).finished();
  EXPECT_THROW(affine_map(flat, p), InvalidInput);
}

TEST(AffineMaps, of_sierpinski_leave_three_quarters_of_the_area_each_round) {
  const std::vector<Eigen::MatrixXd> base = {equilateral()};
  const auto triangles = iterated_maps(sierpinski_maps(), base, 5);
  EXPECT_EQ(triangles.size(), 243u);
  double total = 0;
  for (const auto& t : triangles) total += area(t);
  EXPECT_NEAR(total / area(base[0]), std::pow(0.75, 5), 1e-14);
  EXPECT_NEAR((triangles[17].row(0) - triangles[17].row(1)).norm(), 1 / 32., 1e-15);  // contraction 1/2
}

TEST(AffineMaps, of_koch_lengthen_the_chain_by_four_thirds_each_round) {
  const std::vector<Eigen::MatrixXd> base = {equilateral()};
  const auto triangles = iterated_maps(koch_maps(), base, 4);
  ASSERT_EQ(triangles.size(), 256u);
  double chain = 0;
  for (const auto& t : triangles) chain += (t.row(2) - t.row(0)).norm();
  for (std::size_t i = 1; i < triangles.size(); ++i)
    EXPECT_LT((triangles[i].row(0) - triangles[i - 1].row(2)).norm(), 1e-15);
  EXPECT_NEAR(chain, std::pow(4. / 3, 4), 1e-13);
  for (const auto& S : koch_maps()) EXPECT_TRUE(S.rowwise().sum().isOnes(1e-15));
}

TEST(AffineMaps, of_one_sierpinski_round_then_koch_give_the_snowflake) {
  const std::vector<Eigen::MatrixXd> base = {equilateral()};
  const auto snowflake = iterated_maps(koch_maps(), iterated_maps(sierpinski_maps(), base, 1), 2);
  EXPECT_EQ(snowflake.size(), 3u * 16u);
}

TEST(AffineMaps, of_the_halves_of_a_bezier_curve_put_all_ends_on_it) {
  const Eigen::MatrixXd polygon{{0, 0}, {1, 3}, {2, -1}, {4, 1}};
  const auto maps = casteljau_maps(3);
  const auto pieces = iterated_maps(std::vector{maps.left, maps.right}, std::vector{polygon}, 4);
  ASSERT_EQ(pieces.size(), 16u);  // 16 chords, 17 points at parameters j / 16
  for (std::size_t j = 0; j < 16; ++j) {
    EXPECT_LT((pieces[j].row(0) - bezier_point(polygon, static_cast<double>(j) / 16)).norm(), 1e-14);
    EXPECT_LT((pieces[j].row(3) - bezier_point(polygon, static_cast<double>(j + 1) / 16)).norm(), 1e-14);
  }
}

TEST(AffineMaps, that_do_not_fit_are_refused) {
  const std::vector<Eigen::MatrixXd> square = {Eigen::MatrixXd::Zero(4, 2)}, base = {equilateral()};
  EXPECT_THROW(iterated_maps(koch_maps(), square, 1), InvalidInput);
  EXPECT_THROW(iterated_maps(koch_maps(), base, -1), InvalidInput);
  EXPECT_THROW(iterated_maps(koch_maps(), base, 40), InvalidInput);
}

}  // namespace
}  // namespace batten
