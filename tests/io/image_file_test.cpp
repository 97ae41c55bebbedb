// SPDX-License-Identifier: MIT
#ifdef BATTEN_WITH_VTK
#include <batten/domains/errors.h>
#include <batten/io/image_file.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/io/vtk_text.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// 3 x 2 points with a value that is blank at one of them.
GridSamples sample_grid() {
  GridSamples grid;
  grid.points = {3, 2};
  grid.origin = {100.5, -7};
  grid.spacing = {0.25, 2};
  grid.arrays = {{"value", 1, {1, 2, 3, 4, 5, std::nan("")}},
                 {"gradient", 3, std::vector<double>(18, 0.1)},
                 {"standard_error", 1, std::vector<double>(6, 0.01)}};
  return grid;
}

std::vector<double> doubles_of_all_kinds(std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<double> values = {0.0, -0.0, 0.1, 5e-324, std::numeric_limits<double>::max(), -1e300};
  while (values.size() < count) values.push_back(std::bit_cast<double>(random()));
  return values;
}

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  bits.reserve(values.size());
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

Record sample_record() {
  Record record;
  record.kind = "surface";
  record.degree = 3;
  record.cells = {256, 171};
  record.region = {-110.1, 1.0 / 3, 1e-300, 6478701.7};
  record.arrays["coefficients"] = doubles_of_all_kinds(5000);
  record.arrays["two words, ' %"] = {1};
  record.arrays["empty"] = {};
  record.numbers["lambda"] = 1e-7 / 3;
  record.numbers["not computed"] = std::nan("");
  record.texts["energy"] = "thin-plate";
  record.texts["empty"] = "";
  record.texts["title"] = "Höhe <m> & \"rain\"\nline 2";
  return record;
}

TEST(ImageFile, restores_the_record_bit_for_bit) {
  const TemporaryFolder folder;
  const Record record = sample_record();
  write_image(folder / "a.vti", sample_grid(), record);
  const Record found = read_record(folder / "a.vti");
  EXPECT_EQ(found.kind, record.kind);
  EXPECT_EQ(found.degree, record.degree);
  EXPECT_EQ(found.cells, record.cells);
  EXPECT_EQ(found.region, record.region);
  EXPECT_EQ(found.texts, record.texts);
  ASSERT_EQ(found.arrays.size(), record.arrays.size());
  for (const auto& [name, values] : record.arrays) EXPECT_EQ(bits(found.arrays.at(name)), bits(values)) << name;
  ASSERT_EQ(found.numbers.size(), record.numbers.size());
  for (const auto& [name, value] : record.numbers) EXPECT_EQ(bits({found.numbers.at(name)}), bits({value})) << name;
}

TEST(ImageFile, has_the_grid_and_its_arrays) {
  const TemporaryFolder folder;
  const GridSamples grid = sample_grid();
  write_image(folder / "a.vti", grid, sample_record());
  const std::string file = bytes_of(folder / "a.vti");
  const std::string image = tag_with(file, "<ImageData ");
  EXPECT_EQ(attribute(image, "WholeExtent"), "0 2 0 1 0 0");
  EXPECT_EQ(attribute(image, "Origin"), "100.5 -7 0");
  EXPECT_EQ(attribute(image, "Spacing"), "0.25 2 1");
  const std::string point_data = tag_with(file, "<PointData");
  EXPECT_EQ(attribute(point_data, "Scalars"), "value");
  EXPECT_EQ(attribute(point_data, "Vectors"), "gradient");
  EXPECT_EQ(attribute(tag_with(file, " Name=\"gradient\""), "NumberOfComponents"), "3");
  for (const PointArray& array : grid.arrays) {
    EXPECT_EQ(bits(appended_array<double>(file, array.name)), bits(array.values)) << array.name;
  }
}

TEST(ImageFile, refuses_arrays_that_do_not_fit) {
  const TemporaryFolder folder;
  GridSamples grid = sample_grid();
  grid.arrays[1].values.pop_back();
  EXPECT_EQ(message_of<InvalidInput>([&] { write_image(folder / "a.vti", grid, {}); }),
            "write_image: array 'gradient' must have 18 values, it has 17");
  EXPECT_THROW(write_image(folder / "a.vti", GridSamples(), {}), InvalidInput);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ImageFile, refuses_names_that_would_break_its_xml) {
  const TemporaryFolder folder;
  const auto message = [&](const Record& record) {
    return message_of<InvalidInput>([&] { write_image(folder / "a.vti", sample_grid(), record); });
  };
  for (const std::string name : {"a<b", "a>b", "a&b", "a\"b", "a\nb"}) {
    Record number, text, array;
    number.numbers[name] = 1;
    text.texts[name] = "1";
    array.arrays[name] = {1};
    EXPECT_THAT(message(number), HasSubstr("not allowed in VTK files"));
    EXPECT_THAT(message(text), HasSubstr("not allowed in VTK files"));
    EXPECT_THAT(message(array), HasSubstr("not allowed in VTK files"));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

class FullDisk : public ::testing::TestWithParam<rlim_t> {};

TEST_P(FullDisk, is_reported_and_leaves_nothing) {
  const TemporaryFolder folder;
  GridSamples grid;
  grid.points = {300, 300};
  grid.arrays = {{"value", 1, std::vector<double>(90000, 1)}};
  const auto write = [&] {
    rlimit limit = {};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit full = {GetParam(), limit.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
    const std::string text = message_of<IoError>([&] { write_image(folder / "a.vti", grid, sample_record()); });
    ::setrlimit(RLIMIT_FSIZE, &limit);  // the test collects standard error in a file
    std::fputs(text.c_str(), stderr);
    std::_Exit(0);
  };
  EXPECT_EXIT(write(), ::testing::ExitedWithCode(0), "^[^\n]*a.vti: cannot be written: [^\n]+$");
  EXPECT_THAT(folder.names(), IsEmpty());
}

// From the start of the text to the middle of the data.
INSTANTIATE_TEST_SUITE_P(ImageFile, FullDisk, ::testing::Values(0, 100, 5000, 300000));

TEST(ImageFile, keeps_the_old_file_if_writing_fails) {
  const TemporaryFolder folder;
  write_image(folder / "a.vti", sample_grid(), sample_record());
  const std::string before = bytes_of(folder / "a.vti");
  const auto write = [&] {
    const rlimit limit = {2000, 2000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::_Exit(message_of<IoError>([&] { write_image(folder / "a.vti", sample_grid(), {}); }).empty());
  };
  EXPECT_EXIT(write(), ::testing::ExitedWithCode(0), "");
  EXPECT_EQ(bytes_of(folder / "a.vti"), before);
  EXPECT_THAT(folder.names(), ElementsAre("a.vti"));
}

TEST(ImageFile, must_exist_to_be_read) {
  EXPECT_EQ(message_of<IoError>([] { read_record("no/such.vti"); }), "no/such.vti: there is no such file");
  EXPECT_EQ(message_of<IoError>([] { read_record("/tmp"); }), "/tmp: is a folder, a file is expected");
}

TEST(ImageFile, must_be_of_a_grid_to_be_read) {
  const TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& path) {
    return message_of<InvalidInput>([&] { read_record(path); });
  };
  EXPECT_THAT(message(folder.file("a.csv", "x,y\n1,2\n")), HasSubstr("a.csv: is neither a VTK image file (.vti) nor"));
  EXPECT_THAT(message(folder.file("empty.vti", "")), HasSubstr("empty.vti: is neither a VTK image file (.vti) nor"));
}

TEST(ImageFile, must_be_written_by_batten_to_be_read) {
  const TemporaryFolder folder;
  const auto path = folder.file("foreign.vti",
                                "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                                "<ImageData WholeExtent=\"0 1 0 1 0 0\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\n"
                                "<Piece Extent=\"0 1 0 1 0 0\"></Piece></ImageData></VTKFile>\n");
  EXPECT_THAT(message_of<InvalidInput>([&] { read_record(path); }),
              HasSubstr("foreign.vti: was not written by Batten"));
}

TEST(ImageFile, is_refused_with_one_line_if_it_is_damaged) {
  const TemporaryFolder folder;
  write_image(folder / "a.vti", sample_grid(), sample_record());
  const std::string bytes = bytes_of(folder / "a.vti");
  ::testing::internal::CaptureStderr();
  for (const std::size_t length : {std::size_t{600}, bytes.size() / 2}) {
    const auto path = folder.file("cut.vti", bytes.substr(0, length));
    EXPECT_THAT(message_of<Error>([&] { read_record(path); }), HasSubstr("cut.vti: ")) << length;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace batten
#endif
