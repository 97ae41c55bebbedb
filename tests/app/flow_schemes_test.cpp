// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr const char* eddies = "examples/data/eddies.csv";  // 13 x 11 vertices, on walls without divergence
constexpr const char* whirls = "examples/data/whirls.csv";  // the same, at rest in the outermost cells

double largest(const std::vector<double>& values) {
  double found = 0;
  for (double value : values) found = std::max(found, std::abs(value));
  return found;
}

/// Rows of a grid of 6 x 5 vertices with steps of 1/2 from (1, -2).
template <class U, class V>
std::string table_of(U&& u, V&& v) {
  std::string text = "x,y,u,v\n";
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 6; ++i) {
      const double x = 1 + 0.5 * i, y = -2 + 0.5 * j;
      for (double number : {x, y, u(x, y)}) text += std::to_string(number) + ',';
      text += std::to_string(v(x, y)) + '\n';
    }
  return text;
}

std::string steady_table() {
  return table_of([](double, double) { return 2.; }, [](double, double) { return -3.; });
}

struct Vectors {
  std::vector<double> x, y, u, v;
};

/// The velocities of out.csv.
Vectors written_vectors(const Folder& folder) {
  const auto values = [&](const char* name) { return column(folder, "out.csv", name); };
  return {values("x"), values("y"), values("velocity_x"), values("velocity_y")};
}

TEST(FlowSchemes, keep_divergence_away_when_they_commute) {
  const Folder folder;
  for (const char* scheme : {"perfect-flow", "slow-flow"}) {
    const std::string line =
        std::string("subdivide ") + eddies + " --samples walls --levels 3 -o out.csv --quiet --scheme " + scheme;
    expect_success(folder, line);
    const auto divergence = column(folder, "out.csv", "divergence"), speed = column(folder, "out.csv", "speed");
    ASSERT_THAT(divergence, SizeIs(97 * 81));                            // 12 x 10 cells, 3 levels
    EXPECT_LE(largest(divergence), 8 * 200 * 2.2e-16 * largest(speed));  // 200 products, spacing 1/8
    EXPECT_GT(largest(column(folder, "out.csv", "rotation")), 1);
    expect_success(folder, line + " --kind book");
    EXPECT_GT(largest(column(folder, "out.csv", "divergence")), 1e-3);
  }
}

TEST(FlowSchemes, keep_constants_and_places) {
  const Folder folder;
  folder.write("steady.csv", steady_table());
  for (const char* options : {"perfect-flow", "slow-flow --kind book", "slow-flow --size 5 --samples walls"}) {
    expect_success(folder, std::string("subdivide steady.csv --levels 2 -o out.csv --quiet --scheme ") + options);
    const auto [x, y, u, v] = written_vectors(folder);
    ASSERT_THAT(x, SizeIs(21 * 17));
    EXPECT_EQ(x.front(), 1);
    EXPECT_EQ(x.back(), 3.5);
    EXPECT_EQ(y.front(), -2);
    EXPECT_EQ(y.back(), 0);
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_NEAR(u[k], 2, 1e-13);
      EXPECT_NEAR(v[k], -3, 1e-13);
    }
  }
}

TEST(FlowSchemes, read_vertices_and_walls_where_they_are) {
  // Level 0: u = y at vertices is y + 1/4 in the middle of the wall above, so averages give u back; taken for walls it
  // is y there, and the average at a vertex lies 1/4 lower.
  const Folder folder;
  folder.write("shear.csv", table_of([](double, double y) { return y; }, [](double, double) { return 0.; }));
  const std::string line = "subdivide shear.csv --levels 0 --boundary open --scheme slow-flow -o out.csv --quiet";
  for (const auto& [samples, shift] : {std::pair{"vertices", 0.}, {"walls", -0.25}}) {
    expect_success(folder, line + " --samples " + samples);
    const auto y = column(folder, "out.csv", "y"), u = column(folder, "out.csv", "velocity_x");
    ASSERT_THAT(y, SizeIs(4 * 3));  // inner vertices
    for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(u[k], y[k] + shift, 1e-14);
    for (double rotation : column(folder, "out.csv", "rotation")) EXPECT_NEAR(rotation, 1, 1e-14);
    for (double divergence : column(folder, "out.csv", "divergence")) EXPECT_NEAR(divergence, 0, 1e-14);
  }
}

TEST(FlowSchemes, write_the_stream_function_of_fields_without_divergence) {
  // u at a vertex is the mean of two walls, so the difference of psi over both; the spacing is 1/4.
  const Folder folder;
  expect_success(
      folder, std::string("subdivide ") + eddies + " --samples walls --levels 2 --scheme slow-flow -o out.csv --quiet");
  const auto psi = column(folder, "out.csv", "stream_function");
  const auto u = column(folder, "out.csv", "velocity_x"), v = column(folder, "out.csv", "velocity_y");
  ASSERT_THAT(psi, SizeIs(49 * 41));
  EXPECT_EQ(psi[0], 0);
  for (std::size_t j = 1; j < 40; ++j)
    for (std::size_t i = 1; i < 48; ++i) {
      const std::size_t at = i + 49 * j;
      EXPECT_NEAR((psi[at + 49] - psi[at - 49]) / 0.5, u[at], 1e-12);
      EXPECT_NEAR((psi[at - 1] - psi[at + 1]) / 0.5, v[at], 1e-12);
    }
}

TEST(FlowSchemes, have_the_formula_of_a_wall_as_limit) {
  const Folder folder;
  expect_success(
      folder, "subdivide examples/data/wall.csv --samples walls --limit --levels 2 --scheme perfect-flow -o out.csv");
  const auto [x, y, u, v] = written_vectors(folder);
  ASSERT_THAT(x, SizeIs(25 * 21));
  int infinite = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] == 0 && std::abs(y[k]) == 0.5) {
      EXPECT_TRUE(std::isnan(u[k]));
      ++infinite;
      continue;
    }
    const std::complex<double> z(x[k], y[k]), f = 1. / (2 * std::numbers::pi * (z * z + 0.25));
    EXPECT_NEAR(u[k], f.real(), 1e-14);
    EXPECT_NEAR(v[k], -f.imag(), 1e-14);
  }
  EXPECT_EQ(infinite, 2);
}

TEST(FlowSchemes, have_the_generator_as_limit_of_a_rotor) {
  const Folder folder;
  expect_success(
      folder, "subdivide examples/data/rotor.csv --samples rotors --limit --levels 1 --scheme perfect-flow -o out.csv");
  const auto [x, y, u, v] = written_vectors(folder);
  ASSERT_THAT(x, SizeIs(25));
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double rho = 2 * std::numbers::pi * (x[k] * x[k] + y[k] * y[k]);
    if (rho == 0) continue;
    EXPECT_NEAR(u[k], y[k] / rho, 1e-15);
    EXPECT_NEAR(v[k], -x[k] / rho, 1e-15);
  }
}

/// The largest difference of velocities between two tables.
double difference(const Folder& folder, const std::string& a, const std::string& b) {
  double found = 0;
  for (const char* name : {"velocity_x", "velocity_y"}) {
    const auto of_a = column(folder, a, name), of_b = column(folder, b, name);
    EXPECT_EQ(of_a.size(), of_b.size());
    for (std::size_t k = 0; k < std::min(of_a.size(), of_b.size()); ++k)
      found = std::max(found, std::abs(of_a[k] - of_b[k]));
  }
  return found;
}

TEST(FlowSchemes, come_near_to_their_limit) {  // by as much as docs/flow_schemes.md says
  const Folder folder;
  const std::string line = std::string("subdivide ") + whirls + " --samples walls --scheme slow-flow --quiet ";
  expect_success(folder, line + "--limit -o limit.csv");
  const double speed = largest(column(folder, "limit.csv", "speed"));
  const auto error = [&](const std::string& options) {
    expect_success(folder, line + options + " -o out.csv");
    return difference(folder, "out.csv", "limit.csv") / speed;
  };
  EXPECT_LT(error("--kind book --size 7"), 0.04);
  EXPECT_LT(error("--size 17"), 0.02);
  EXPECT_GT(error("--size 5"), 2 * error("--size 13"));
}

TEST(FlowSchemes, write_what_paraview_opens_and_a_picture) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  const std::string line = std::string("subdivide ") + eddies + " --scheme slow-flow --levels 2 ";
  const Outcome outcome = run_batten(folder, words(line + "-o f.vti --picture f.png --view map"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("slow-flow, commuting, size 9: 12 x 10 cells -> 48 x 40, speed up to"));
  EXPECT_EQ(folder.read("f.png").substr(1, 3), "PNG");
  expect_success(folder, line + "-o f.vtu");
  for (const char* file : {"f.vti", "f.vtu"})
    for (const char* name : {"subdivided flow", "velocity", "divergence", "rotation", "speed", "stream_function",
                             "cell_divergence", "Scalars=\"speed\" Vectors=\"velocity\""})
      EXPECT_THAT(folder.read(file), HasSubstr(name)) << file;
  for (const char* count : {"NumberOfPoints=\"2009\"", "NumberOfCells=\"1920\""})
    EXPECT_THAT(folder.read("f.vtu"), HasSubstr(count));
}

TEST(FlowSchemes, write_and_draw_limits) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  const Outcome outcome = expect_success(
      folder, std::string("subdivide ") + whirls +
                  " --samples walls --scheme perfect-flow --limit -o f.vtu --picture f.png --pixels 300 240");
  EXPECT_THAT(outcome.out, HasSubstr("perfect-flow, limit: 12 x 10 cells -> 96 x 80, speed up to"));
  EXPECT_EQ(folder.read("f.png").substr(16, 8), std::string("\0\0\x01\x2c\0\0\0\xf0", 8));  // width and height
  EXPECT_THAT(folder.read("f.vtu"), HasSubstr("perfect-flow, limit"));
  folder.write("at.csv", "x,y\n1,1\n");
  expect_refusal(run_batten(folder, words("evaluate f.vtu --at at.csv -o there.csv")), 1,
                 "f.vtu: is a subdivided flow, values at points alone; expected a result of fit, flow or solve");
}

void expect_failure(const Folder& folder, const std::string& arguments, int status, const std::string& message) {
  const auto before = folder.names();
  const Outcome outcome = run_batten(folder, words("subdivide " + arguments));
  expect_refusal(outcome, status, message);
  EXPECT_EQ(folder.names(), before);
}

TEST(FlowSchemes, say_what_cannot_be) {
  const Folder folder;
  const std::string steady = steady_table(), flow = " --scheme slow-flow -o a.csv";
  folder.write("steady.csv", steady);
  folder.write("missing.csv", steady.substr(0, steady.rfind("3.5")));
  folder.write("twice.csv", steady + "1,-2,5,5\n");
  folder.write("off.csv", "x,y,u,v\n0,0,1,1\n1,0,1,1\n0,1,1,1\n1.1,1,1,1\n");
  folder.write("row.csv", "x,y,u,v\n0,0,1,1\n1,0,1,1\n2,0,1,1\n");
  folder.write("oblong.csv", "x,y,u,v\n0,0,1,1\n1,0,1,1\n0,2,1,1\n1,2,1,1\n");
  folder.write("text.csv", "x,y,u,v\n0,0,1,fast\n");
  folder.write("scalar.csv", "x,y,z\n0,0,1\n");
  std::string scattered = "x,y,u,v\n";
  for (int k = 0; k < 30; ++k) scattered += std::to_string(k) + ',' + std::to_string(k * k) + ",1,1\n";
  folder.write("scattered.csv", scattered);
  expect_failure(folder, "scattered.csv" + flow, 1, "must form a grid, found 30 different x and 30 different y of 30");
  expect_failure(folder, "none.csv" + flow, 1, "none.csv");
  expect_failure(folder, "missing.csv" + flow, 1, "of a grid of 6 x 5 points the point (3.5, 0) is missing");
  expect_failure(folder, "twice.csv" + flow, 1, "twice.csv, line 32: the point (1, -2) is given twice");
  expect_failure(folder, "off.csv" + flow, 1, "off.csv, line 3: the point (1, 0) is off a grid of 3 x 2 points");
  expect_failure(folder, "row.csv" + flow, 1, "a grid of 2 x 2 points or more is needed, all points have y = 0");
  expect_failure(folder, "oblong.csv" + flow, 1, "cells must be square, found steps of 1 in x and 2 in y");
  expect_failure(folder, "text.csv" + flow, 1, "fast");
  expect_failure(folder, "scalar.csv" + flow, 1, "u");
  expect_failure(folder, "steady.csv --boundary open" + flow, 1, "is too small for these masks");
  expect_failure(folder, "steady.csv --boundary reflect" + flow, 2, "extend, open or zero, found reflect");
  expect_failure(folder, "steady.csv --size 6" + flow, 2, "--size of a flow is odd and from 3 to 17, found 6");
  expect_failure(folder, "steady.csv --order 2" + flow, 2, "--order");
  expect_failure(folder, "steady.csv --closed" + flow, 2, "no options of curves");
  expect_failure(folder, "steady.csv --levels 12 --boundary zero --kind slow" + flow, 2, "--kind");
  expect_failure(folder, "steady.csv --scheme slow-flow -o a.vtp", 2, "must end with .vti or .vtu or .csv");
  expect_failure(folder, "steady.csv --view surface --picture a.png" + flow, 2, "--view of a flow is map");
  expect_failure(folder, "steady.csv --pixels 20 20 --picture a.png" + flow, 2, "--pixels");
  expect_failure(folder, "steady.csv --scheme bspline --order 4 --pixels 300 300 --picture a.png -o a.csv", 2,
                 "--pixels is for --scheme perfect-flow and slow-flow, found bspline");
  expect_failure(folder, "steady.csv --scheme bspline --order 4 --kind book -o a.csv", 2,
                 "--kind is for --scheme perfect-flow and slow-flow, found bspline");
}

TEST(FlowSchemes, say_what_a_limit_cannot_have) {
  const Folder folder;
  folder.write("steady.csv", steady_table());
  const std::string limit = "steady.csv --scheme slow-flow -o a.csv --limit ";
  expect_failure(folder, limit + "--kind book", 2, "--limit is that of the exact scheme: no --kind and no --size");
  expect_failure(folder, limit + "--size 7", 2, "no --kind and no --size");
  expect_failure(folder, limit + "--boundary extend", 2, "at rest outside, --boundary zero; found extend");
  expect_failure(folder, limit + "--samples rotors", 1, "there is no column 'rotation'");
  expect_failure(folder, "steady.csv --scheme slow-flow -o a.csv --samples rotors", 2,
                 "--samples rotors is for --limit");
  expect_failure(folder, limit + "--levels 12", 1, "more than 2^28 vertices, on level 12");
}

}  // namespace
}  // namespace batten::test
