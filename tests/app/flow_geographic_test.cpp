// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>
#include <batten/tests/io/vtk_text.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double degree = std::numbers::pi / 180;
constexpr double earth = 6371;  // km

const std::string in = "flow in.csv --x lon --y lat --u u --v v --geographic --smoothing 1e-10 ";

// The Earth turning about its axis: u = cos(lat) 1000, v = 0, vorticity 2000 sin(lat) / R.
std::string turning_earth() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, 1);
  std::ostringstream text;
  text.precision(17);
  text << "lon,lat,u,v\n";
  for (int k = 0; k < 300; ++k) {
    const double x = 5 + 20 * place(random), y = 40 + 20 * place(random);
    text << x << ',' << y << ',' << 1000 * std::cos(y * degree) << ",0\n";
  }
  return text.str();
}

class FlowGeographic : public testing::Test {
protected:
  void SetUp() override {
    if (!has_vtk) GTEST_SKIP() << "built without VTK";
    folder_.write("in.csv", turning_earth());
  }

  void expect_failure(const std::string& line, int status, const std::string& message) const {
    const Outcome run = run_batten(folder_, words(line));
    expect_refusal(run, status, message);
    EXPECT_THAT(run.err, StartsWith("batten flow: "));
  }

  Folder folder_;
};

TEST_F(FlowGeographic, has_velocity_and_vorticity_of_the_sphere) {
  folder_.write("at.csv", "lon,lat\n10,42\n20,50\n15,58\n");
  expect_success(folder_, in + "--region 5 25 40 60 --cells 24 32 -o f.vti --report f.json");
  expect_success(folder_, "evaluate f.vti --at at.csv --x lon --y lat -o there.csv --derivatives");
  const auto u = column(folder_, "there.csv", "u"), vorticity = column(folder_, "there.csv", "vorticity");
  const auto divergence = column(folder_, "there.csv", "divergence"), u_y = column(folder_, "there.csv", "u_y");
  const auto psi = column(folder_, "there.csv", "stream_function");
  for (const auto& [k, y] : {std::pair{0, 42.}, {1, 50.}, {2, 58.}}) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_NEAR(u[i], 1000 * std::cos(y * degree), 0.01);
    EXPECT_NEAR(vorticity[i], 2000 * std::sin(y * degree) / earth, 1e-3 * 1000 / earth);
    EXPECT_NEAR(u_y[i], -1000 * std::sin(y * degree) / earth, 1e-3 * 1000 / earth);
    EXPECT_EQ(divergence[i], 0);
    // u = -psi_lat / R
    EXPECT_NEAR(psi[i] - psi[0], -1000 * earth * (std::sin(y * degree) - std::sin(42 * degree)), 1000);
  }
  const auto report = nlohmann::json::parse(folder_.read("f.json"));
  EXPECT_EQ(report["geographic"], true);
  EXPECT_LE(report["largest_divergence"], 1e-6);
  EXPECT_THAT(folder_.read("f.vti"), HasSubstr("batten.number.sphere_radius"));
}

TEST_F(FlowGeographic, writes_the_vectors_at_longitudes_and_latitudes) {
  expect_success(folder_, in + "--region 5 25 40 60 --cells 24 32 -o f.vti --points-out p.vtp");
  const std::string file = folder_.read("p.vtp");
  const auto place = appended_array<double>(file, "Points"), velocity = appended_array<double>(file, "velocity"),
             fit = appended_array<double>(file, "fit"), residual = appended_array<double>(file, "residual");
  const auto lon = column(folder_, "in.csv", "lon"), lat = column(folder_, "in.csv", "lat");
  ASSERT_EQ(place.size(), 3 * lon.size());
  for (std::size_t i = 0; i < lon.size(); ++i) {
    EXPECT_EQ(place[3 * i], lon[i]);
    EXPECT_EQ(place[3 * i + 1], lat[i]);
    EXPECT_NEAR(velocity[3 * i], 1000 * std::cos(lat[i] * degree), 1e-12 * 1000);
    EXPECT_NEAR(fit[3 * i], 1000 * std::cos(lat[i] * degree), 0.01);
    EXPECT_EQ(residual[3 * i], fit[3 * i] - velocity[3 * i]);
    EXPECT_EQ(residual[3 * i + 2], 0);
  }
}

TEST_F(FlowGeographic, goes_around_the_earth_with_periodic_longitudes) {
  std::ostringstream text;
  text << "lon,lat,u,v\n";
  for (int k = 0; k < 400; ++k) {  // psi of an eddy: 1.5 R cos(lat) sin(2 lon)
    const double lon = 0.9 * k, lat = -40 + (k * 37 % 80);
    text << lon << ',' << lat << ',' << 7 + 1.5 * std::sin(lat * degree) * std::sin(2 * lon * degree) << ','
         << 3 * std::cos(2 * lon * degree) << '\n';
  }
  folder_.write("in.csv", text.str());
  folder_.write("at.csv", "lon,lat\n0,5\n360,5\n180,-10\n");
  expect_success(folder_, in + "--region 0 360 -45 45 --cells 64 16 --periodic x -o f.vti --picture f.png");
  expect_success(folder_, "evaluate f.vti --at at.csv --x lon --y lat -o there.csv");
  const auto u = column(folder_, "there.csv", "u"), v = column(folder_, "there.csv", "v");
  EXPECT_NEAR(v[0], v[1], 1e-9);
  EXPECT_NEAR(u[0], u[1], 1e-9);
  EXPECT_NEAR(u[0], 7, 0.02);
  EXPECT_NEAR(v[0], 3, 0.02);
  EXPECT_NEAR(v[2], 3, 0.02);
}

TEST_F(FlowGeographic, refuses_latitudes_that_are_none) {
  expect_failure("flow examples/data/wind.csv --x x --y y --u u --v v --geographic -o f.vti", 1,
                 "--geographic: latitudes (--y) must lie between -90 and 90 degrees, found ");
  expect_failure(in + "--region 5 25 40 90 -o f.vti", 1, "poles excluded, found 40 to 90");
  expect_failure(in + "--region -180 200 40 60 -o f.vti", 1, "over at most 360 degrees, found -180 to 200");
  expect_failure(in + "--periodic x,y -o f.vti", 2, "--geographic: longitudes go around, latitudes do not");
}

}  // namespace
}  // namespace batten::test
