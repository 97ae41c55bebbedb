// SPDX-License-Identifier: MIT
#ifdef BATTEN_WITH_VTK
#include <batten/domains/errors.h>
#include <batten/io/image_file.h>
#include <batten/io/quad_file.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/io/vtk_text.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace batten {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// 3 x 2 points, 2 cells.
GridSamples sample_grid() {
  return {.points = {3, 2},
          .origin = {100.5, -7},
          .spacing = {0.25, 2},
          .arrays = {{"speed", 1, {1, 2, 3, 4, 5, 6}}, {"velocity", 3, std::vector<double>(18, 0.1)}},
          .cell_arrays = {{"outflow", 1, {-0.5, 0.75}}}};
}

TEST(QuadFile, has_the_points_and_their_cells) {
  const TemporaryFolder folder;
  write_quads(folder / "a.vtu", sample_grid(), {});
  const std::string file = bytes_of(folder / "a.vtu");
  const std::string piece = tag_with(file, "<Piece");
  EXPECT_EQ(attribute(tag_with(file, "<VTKFile"), "type"), "UnstructuredGrid");
  EXPECT_EQ(attribute(piece, "NumberOfPoints"), "6");
  EXPECT_EQ(attribute(piece, "NumberOfCells"), "2");
  EXPECT_THAT(appended_array<double>(file, "Points"), ElementsAre(100.5, -7, 0, 100.75, -7, 0, 101, -7, 0,  //
                                                                  100.5, -5, 0, 100.75, -5, 0, 101, -5, 0));
  EXPECT_THAT(appended_array<std::int64_t>(file, "connectivity"), ElementsAre(0, 1, 4, 3, 1, 2, 5, 4));
  EXPECT_THAT(appended_array<std::int64_t>(file, "offsets"), ElementsAre(4, 8));
  constexpr std::uint8_t quad = 9;
  EXPECT_THAT(appended_array<std::uint8_t>(file, "types"), ElementsAre(quad, quad));
}

TEST(QuadFile, has_the_arrays_of_points_and_of_cells) {
  const TemporaryFolder folder;
  const GridSamples grid = sample_grid();
  write_quads(folder / "a.vtu", grid, {});
  write_image(folder / "a.vti", grid, {});
  for (const char* const name : {"a.vtu", "a.vti"}) {
    const std::string file = bytes_of(folder / name);
    EXPECT_EQ(attribute(tag_with(file, "<PointData"), "Scalars"), "speed");
    EXPECT_EQ(attribute(tag_with(file, "<PointData"), "Vectors"), "velocity");
    EXPECT_EQ(appended_array<double>(file, "speed"), grid.arrays[0].values);
    EXPECT_THAT(appended_array<double>(file, "velocity"), Each(0.1));
    EXPECT_THAT(appended_array<double>(file, "outflow"), ElementsAre(-0.5, 0.75));
    EXPECT_GT(file.find("\"outflow\""), file.find("<CellData"));
  }
}

TEST(QuadFile, restores_the_record) {
  const TemporaryFolder folder;
  Record record{.kind = "flow", .degree = 4, .cells = {2, 1}, .region = {100.5, 101, -7, 1. / 3}};
  record.arrays["coefficients"] = {0.1, -0., 5e-324};
  record.numbers["lambda"] = 1e-7 / 3;
  record.texts["model"] = "smooth";
  write_quads(folder / "a.vtu", sample_grid(), record);
  const Record found = read_record(folder / "a.vtu");
  EXPECT_EQ(found.kind, record.kind);
  EXPECT_EQ(found.degree, record.degree);
  EXPECT_EQ(found.cells, record.cells);
  EXPECT_EQ(found.region, record.region);
  EXPECT_EQ(found.arrays, record.arrays);
  EXPECT_EQ(found.numbers, record.numbers);
  EXPECT_EQ(found.texts, record.texts);
}

TEST(QuadFile, refuses_what_does_not_fit) {
  const TemporaryFolder folder;
  const auto message = [&](const GridSamples& grid) {
    return message_of<InvalidInput>([&] { write_quads(folder / "a.vtu", grid, {}); });
  };
  GridSamples grid = sample_grid();
  grid.cell_arrays[0].values.push_back(0);
  EXPECT_EQ(message(grid), "write_quads: array 'outflow' must have 2 values, it has 3");
  grid = {.points = {6, 1}, .arrays = {{"speed", 1, {1, 2, 3, 4, 5, 6}}}};
  EXPECT_EQ(message(grid), "write_quads: the grid must have 2 x 2 points or more, found 6 x 1");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(QuadFile, is_refused_with_one_line_if_it_is_damaged_or_foreign) {
  const TemporaryFolder folder;
  write_quads(folder / "a.vtu", sample_grid(), {});
  const std::string bytes = bytes_of(folder / "a.vtu");
  const auto cut = folder.file("cut.vtu", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(message_of<Error>([&] { read_record(cut); }), HasSubstr("cut.vtu: "));
  const auto foreign = folder.file(
      "foreign.vtu",
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"1\" NumberOfCells=\"1\"><Points>\n"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points><Cells>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0</DataArray>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">1</DataArray>\n"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">1</DataArray></Cells></Piece>\n"
      "</UnstructuredGrid></VTKFile>\n");
  EXPECT_THAT(message_of<InvalidInput>([&] { read_record(foreign); }),
              HasSubstr("foreign.vtu: was not written by Batten"));
}

}  // namespace
}  // namespace batten
#endif
