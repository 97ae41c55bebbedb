// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/table.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::StartsWith;

class TableFile : public ::testing::Test {
protected:
  // Columns of a file with this text.
  Table read(std::string_view text, const TableOptions& options = {}) const {
    return read_table(folder_.file("points.csv", text), options);
  }

  // The message about a file with this text, without the path that it starts with.
  std::string problem(std::string_view text, const TableOptions& options = {}) const {
    const std::string message = message_of<InvalidInput>([&] { read(text, options); });
    const std::string prefix = (folder_ / "points.csv").string() + ": ";
    return message.starts_with(prefix) ? message.substr(prefix.size()) : "no path in front: " + message;
  }

  TemporaryFolder folder_;
};

TEST_F(TableFile, is_read_by_names_in_the_order_asked_for) {
  const Table table = read("x,y,z\n1,2,3\n4,5.5,-6e3\n", {.columns = {"z", "x"}});
  EXPECT_THAT(table.names, ElementsAre("z", "x"));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(3, -6000), ElementsAre(1, 4)));
  EXPECT_THAT(table.lines, ElementsAre(2u, 3u));
  EXPECT_EQ(table.skipped, 0u);
}

TEST_F(TableFile, is_read_by_numbers_from_one_unless_a_name_matches) {
  EXPECT_THAT(read("x,y,z\n1,2,3\n", {.columns = {"3", "1"}}).columns, ElementsAre(ElementsAre(3), ElementsAre(1)));
  EXPECT_THAT(read("a,b,1\n7,8,9\n", {.columns = {"1"}}).columns, ElementsAre(ElementsAre(9)));
}

TEST_F(TableFile, is_read_whole_if_no_columns_are_named) {
  EXPECT_THAT(read("x,y\n1,2\n").names, ElementsAre("x", "y"));
}

TEST_F(TableFile, may_have_columns_without_numbers_that_are_not_asked_for) {
  EXPECT_THAT(read("x,station,y\n1,\"Bolzano, Bozen\",2\n", {.columns = {"x", "y"}}).columns,
              ElementsAre(ElementsAre(1), ElementsAre(2)));
}

TEST_F(TableFile, is_delimited_by_comma_semicolon_tab_or_blanks) {
  const auto columns = ElementsAre(ElementsAre(1, 3), ElementsAre(2, -4));
  EXPECT_THAT(read("x,y\n1,2\n3,-4\n").columns, columns);
  EXPECT_THAT(read("x;y\n1;2\n3;-4\n").columns, columns);
  EXPECT_THAT(read("x\ty\n1\t2\n3\t-4\n").columns, columns);
  EXPECT_THAT(read("  x   y\n1 2\n   3 \t -4  \n").columns, columns);
  EXPECT_THAT(read("x, y\n1, 2\n3, -4\n").columns, columns);
  EXPECT_THAT(read("# x y\n1 2\n3 -4\n").columns, columns);
}

TEST_F(TableFile, has_the_delimiter_that_its_rows_agree_with) {
  EXPECT_THAT(read("x (m; east),y (m; north)\n1,2\n").names, ElementsAre("x (m; east)", "y (m; north)"));
  EXPECT_THAT(read("depth (m) rate (m)\n1 2 3 4\n", {.columns = {"4"}}).columns, ElementsAre(ElementsAre(4)));
  EXPECT_THAT(read("height\n17\n").columns, ElementsAre(ElementsAre(17)));
}

TEST_F(TableFile, may_have_quoted_fields) {
  const Table table = read("\"x, m\",\"the \"\"y\"\"\",name\n\"1.5\",2,\"two\nlines, \"\"both\"\"\"\n3,4,b\n",
                           {.columns = {"x, m", "the \"y\""}});
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1.5, 3), ElementsAre(2, 4)));
  EXPECT_THAT(table.lines, ElementsAre(2u, 4u));
}

TEST_F(TableFile, may_have_a_mark_carriage_returns_blank_lines_and_no_last_end_of_line) {
  const Table table = read("\xEF\xBB\xBFx,y\r\n\r\n 1 , 2\r\n  \n3,4");
  EXPECT_THAT(table.names, ElementsAre("x", "y"));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1, 3), ElementsAre(2, 4)));
  EXPECT_THAT(table.lines, ElementsAre(3u, 5u));
}

TEST_F(TableFile, may_have_decimal_commas_where_the_comma_is_no_delimiter) {
  EXPECT_THAT(read("x;y\n1,5;-2,25\n3;4,125\n").columns, ElementsAre(ElementsAre(1.5, 3), ElementsAre(-2.25, 4.125)));
  EXPECT_THAT(read("x\ty\n0,125\t1,5e3\n").columns, ElementsAre(ElementsAre(0.125), ElementsAre(1500)));
}

TEST_F(TableFile, is_refused_where_a_comma_may_separate_thousands) {
  EXPECT_EQ(
      problem("x;y\n1;2\n3;1,250\n"),
      "line 3: '1,250' may have a decimal comma or a separator of thousands; write the numbers with decimal points");
  EXPECT_EQ(problem("x;y\n1.5;2,5\n"),
            "line 2, column 2 ('y'): '2,5' has a decimal comma, where numbers above have decimal points");
  EXPECT_EQ(problem("x;y\n2,5;1.5\n"),
            "line 2, column 2 ('y'): '1.5' has a decimal point, where numbers above have decimal commas");
  EXPECT_EQ(problem("x;y\n2;1,234.5\n"), "line 2, column 2 ('y'): '1,234.5' is not a number");
}

TEST_F(TableFile, may_have_plus_signs_and_numbers_beyond_double_precision) {
  EXPECT_THAT(read("x,y\n+1,+.5\n").columns, ElementsAre(ElementsAre(1), ElementsAre(0.5)));
  EXPECT_THAT(read("x,y\n0.1000000000000000055511151231257827,1e-310\n").columns,
              ElementsAre(ElementsAre(0.1), ElementsAre(1e-310)));
}

TEST_F(TableFile, must_exist_and_be_a_file) {
  const auto message = [](const std::filesystem::path& path) {
    return message_of<IoError>([&] { read_table(path, {}); });
  };
  EXPECT_EQ(message("no/such.csv"), "no/such.csv: there is no such file");
  EXPECT_EQ(message(folder_.path()), folder_.path().string() + ": is a folder, a file is expected");
}

TEST_F(TableFile, must_not_be_empty) {
  EXPECT_EQ(problem(""), "the file is empty");
  EXPECT_EQ(problem("\n  \n\r\n"), "the file is empty");
}

TEST_F(TableFile, must_have_rows_below_the_header) {
  EXPECT_EQ(problem("x,y\n"), "there are no rows below the header");
  EXPECT_EQ(problem("x,y"), "there are no rows below the header");
}

TEST_F(TableFile, must_have_a_header) {
  EXPECT_EQ(problem("1,2,3\n4,5,6\n"), "line 1 holds numbers only; a header with the names of the columns is expected");
}

TEST_F(TableFile, must_have_the_columns_asked_for) {
  EXPECT_EQ(problem("x,y,\"z, m\"\n1,2,3\n", {.columns = {"height"}}),
            "there is no column 'height'; the columns are 'x', 'y', 'z, m'");
  EXPECT_EQ(problem("x,y\n1,2\n", {.columns = {"3"}}), "there is no column '3'; the columns are 'x', 'y'");
  EXPECT_EQ(problem("x,y\n1,2\n", {.columns = {"0"}}), "there is no column '0'; the columns are 'x', 'y'");
}

TEST_F(TableFile, must_not_have_two_columns_of_the_name_asked_for) {
  EXPECT_EQ(problem("x,y,x\n1,2,3\n", {.columns = {"x"}}),
            "columns 1 and 3 are both named 'x'; ask for one of them by its number");
  EXPECT_THAT(read("x,y,x\n1,2,3\n", {.columns = {"3", "y"}}).columns, ElementsAre(ElementsAre(3), ElementsAre(2)));
}

TEST_F(TableFile, must_have_numbers_in_the_cells_asked_for) {
  EXPECT_EQ(problem("x,y\n1,2\n3,abc\n"), "line 3, column 2 ('y'): 'abc' is not a number");
  EXPECT_EQ(problem("x,y\n1,2 m\n"), "line 2, column 2 ('y'): '2 m' is not a number");
  EXPECT_EQ(problem("x,y\n0x10,2\n"), "line 2, column 1 ('x'): '0x10' is not a number");
  EXPECT_EQ(problem("x,y\n1,\n"), "line 2, column 2 ('y'): the cell is empty, a number is expected");
  EXPECT_EQ(problem("x,y\n1,1e999\n"), "line 2, column 2 ('y'): '1e999' is out of the range of a double");
  EXPECT_THAT(problem("x,y\n1," + std::string(100, 'a') + "\n"), EndsWith("aaa...' is not a number"));
}

TEST_F(TableFile, must_have_finite_numbers) {
  EXPECT_EQ(problem("x,y\n1,NaN\n"), "line 2, column 2 ('y'): 'NaN' is not finite (NaN)");
  EXPECT_EQ(problem("x,y\n-inf,1\n"), "line 2, column 1 ('x'): '-inf' is not finite");
  EXPECT_EQ(problem("x;y\n1,5;nan\n"), "line 2, column 2 ('y'): 'nan' is not finite (NaN)");
}

TEST_F(TableFile, must_have_as_many_fields_in_each_row_as_in_the_header) {
  EXPECT_EQ(problem("x,y,z\n1,2,3\n1,2\n"), "line 3: the header has 3 fields, this row has 2");
  EXPECT_EQ(problem("x,y\n1,2\n1,2,3\n"), "line 3: the header has 2 fields, this row has 3");
}

TEST_F(TableFile, must_close_its_quotation_marks) {
  EXPECT_EQ(problem("x,y\n1,2\n3,\"4\n5,6\n"), "line 3: a quotation mark is not closed");
  EXPECT_EQ(problem("x,\"y\n1,2\n"), "line 1: a quotation mark is not closed");
}

TEST_F(TableFile, must_not_be_in_utf_16) {
  EXPECT_EQ(problem(std::string_view("\xFF\xFEx\0,\0", 6)), "is encoded in UTF-16; save it as UTF-8");
}

TEST_F(TableFile, leaves_out_and_counts_invalid_rows_if_asked) {
  const Table table = read("x,y\n1,2\n3,abc\n5\n7,nan\n9,10\n", {.columns = {}, .skip_invalid = true});
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1, 9), ElementsAre(2, 10)));
  EXPECT_THAT(table.lines, ElementsAre(2u, 6u));
  EXPECT_EQ(table.skipped, 3u);
  EXPECT_EQ(problem("x,y\na,1\nb,2\n", {.columns = {}, .skip_invalid = true}),
            "none of the rows (2) can be read; the first: line 2, column 1 ('x'): 'a' is not a number");
}

TEST_F(TableFile, comes_from_standard_input_for_a_hyphen) {
  const std::filesystem::path path = folder_.file("points.csv", "x,y\n1,2\n3,oops\n");
  const auto read_standard_input = [&] {
    if (!std::freopen(path.c_str(), "r", stdin)) std::_Exit(1);
    const Table table = read_table("-", {.columns = {"x"}});
    std::fprintf(stderr, "%g %g", table.columns[0][0], table.columns[0][1]);
    std::_Exit(0);
  };
  EXPECT_EXIT(read_standard_input(), ::testing::ExitedWithCode(0), "1 3");
  const auto fail = [&] {
    if (!std::freopen(path.c_str(), "r", stdin)) std::_Exit(1);
    std::fputs(message_of<InvalidInput>([] { read_table("-", {}); }).c_str(), stderr);
    std::_Exit(0);
  };
  EXPECT_EXIT(fail(), ::testing::ExitedWithCode(0),
              "^standard input: line 3, column 2 \\('y'\\): 'oops' is not a number$");
}

TEST_F(TableFile, comes_back_from_writing_bit_for_bit) {
  std::mt19937_64 random(1);
  std::vector<double> values = {0, -0.0, 0.1, 1e300, 5e-324, std::numeric_limits<double>::max()};
  while (values.size() < 1000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  const std::vector<std::string> names = {"a, \"b\"", " c"};
  const std::vector<std::vector<double>> columns = {values, {values.rbegin(), values.rend()}};
  write_table(folder_ / "out.csv", names, columns);
  const Table table = read_table(folder_ / "out.csv", {});
  EXPECT_EQ(table.names, names);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(table.columns[k][i]), std::bit_cast<std::uint64_t>(columns[k][i]));
    }
  }
}

TEST_F(TableFile, is_written_with_the_shortest_numbers_and_nan_as_an_empty_field) {
  const std::vector<std::string> names = {"x", "y"};
  const std::vector<std::vector<double>> columns = {{0.1, 1e21}, {std::nan(""), 3}};
  write_table(folder_ / "out.csv", names, columns);
  EXPECT_EQ(bytes_of(folder_ / "out.csv"), "x,y\n0.1,\n1e+21,3\n");
  EXPECT_THAT(folder_.names(), ElementsAre("out.csv"));
}

TEST_F(TableFile, needs_a_name_for_each_column_and_equal_lengths_to_be_written) {
  const std::vector<std::string> names = {"x", "y"};
  const std::vector<std::vector<double>> ragged = {{1}, {1, 2}};
  EXPECT_THROW(write_table(folder_ / "out.csv", names, ragged), InvalidInput);
  EXPECT_THROW(write_table(folder_ / "out.csv", std::span(names).first(1), ragged), InvalidInput);
  EXPECT_THAT(folder_.names(), ElementsAre());
}

TEST_F(TableFile, holds_the_points_of_a_grid_with_x_fastest) {
  GridSamples grid;
  grid.points = {2, 2};
  grid.origin = {1, 10};
  grid.spacing = {0.5, 2};
  grid.arrays = {{"value", 1, {1, 2, 3, std::nan("")}}, {"gradient", 3, {1, 2, 0, 3, 4, 0, 5, 6, 0, 7, 8, 0}}};
  write_table(folder_ / "grid.csv", grid);
  EXPECT_EQ(bytes_of(folder_ / "grid.csv"),
            "x,y,value,gradient_x,gradient_y,gradient_z\n"
            "1,10,1,1,2,0\n1.5,10,2,3,4,0\n1,12,3,5,6,0\n1.5,12,,7,8,0\n");
  grid.arrays[0].values.pop_back();
  EXPECT_THAT(message_of<InvalidInput>([&] { write_table(folder_ / "grid.csv", grid); }),
              StartsWith("write_table: array 'value' must have 4 values"));
}

TEST_F(TableFile, is_the_same_for_a_pipe_as_for_a_file) {
  const std::string text = "x,y\n1,2\n3,4\n";
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]);
  const Table table = read_table("/dev/fd/" + std::to_string(ends[0]), {});
  ::close(ends[0]);
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1, 3), ElementsAre(2, 4)));
}

}  // namespace
}  // namespace batten
