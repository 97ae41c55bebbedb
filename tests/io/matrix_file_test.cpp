// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/matrix_file.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MatrixFile : public ::testing::Test {
protected:
  NumberMatrix read(std::string_view text) const { return read_matrix(folder_.file("grid.csv", text)); }
  std::string problem(std::string_view text) const {
    return message_of<InvalidInput>([&] { read(text); });
  }

  TemporaryFolder folder_;
};

TEST_F(MatrixFile, is_read_row_by_row) {
  const NumberMatrix matrix = read("1,2,3\n4,5.5,-6e3\n");
  EXPECT_EQ(matrix.rows, 2);
  EXPECT_EQ(matrix.columns, 3);
  EXPECT_THAT(matrix.values, ElementsAre(1, 2, 3, 4, 5.5, -6000));
}

TEST_F(MatrixFile, may_have_any_delimiter_blank_lines_and_a_byte_order_mark) {
  for (const char* text : {"\xEF\xBB\xBF"
                           "1;2\n3;4\n",
                           "1\t2\n\n3\t4", "  1   2\r\n 3 4  \r\n", "\"1\",\"2\"\n3,4\n"})
    EXPECT_THAT(read(text).values, ElementsAre(1, 2, 3, 4)) << text;
  EXPECT_THAT(read("1,25;2\n3;4,5\n").values, ElementsAre(1.25, 2, 3, 4.5));
}

TEST_F(MatrixFile, problems_are_told_with_line_and_column) {
  EXPECT_THAT(problem("1,2\n3\n"), HasSubstr("grid.csv: line 2: the first row has 2 numbers, this one has 1"));
  EXPECT_THAT(problem("x,y\n3,4\n"), HasSubstr("line 1, column 1: 'x' is not a number"));
  EXPECT_THAT(problem("1,2\n3,nan\n"), HasSubstr("line 2, column 2: "));
  EXPECT_THAT(problem("1,\"2\n3,4\n"), HasSubstr("line 1: a quotation mark is not closed"));
  EXPECT_THAT(problem("\n \n"), HasSubstr("a matrix of numbers is expected, the file is empty"));
  EXPECT_THAT(problem("1,234;5\n6;7\n"), HasSubstr("may have a decimal comma or a separator of thousands"));
}

}  // namespace
}  // namespace batten
