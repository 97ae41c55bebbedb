// SPDX-License-Identifier: MIT
#ifndef BATTEN_WITH_VTK
#include <batten/domains/errors.h>
#include <batten/io/chart.h>
#include <batten/io/curve_file.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>
#include <batten/io/png.h>
#include <batten/io/point_file.h>
#include <batten/io/quad_file.h>
#include <batten/tests/support/message_of.h>

#include <gtest/gtest.h>

namespace batten {
namespace {

TEST(BuildWithoutVtk, says_what_it_cannot_do) {
  EXPECT_EQ(message_of<IoError>([] { write_image("a.vti", {}, {}); }),
            "a.vti: this build of Batten has no VTK and cannot write .vti files; write .csv");
  EXPECT_EQ(message_of<IoError>([] { read_record("a.vti"); }),
            "a.vti: this build of Batten has no VTK and cannot read .vti files");
  EXPECT_EQ(message_of<IoError>([] { write_quads("a.vtu", {}, {}); }),
            "a.vtu: this build of Batten has no VTK and cannot write .vtu files; write .csv");
  EXPECT_EQ(message_of<IoError>([] { write_points("a.vtp", {}); }),
            "a.vtp: this build of Batten has no VTK and cannot write .vtp files; write .csv");
  EXPECT_EQ(message_of<IoError>([] { write_picture("a.png", {}, {}, {}); }),
            "a.png: this build of Batten has no VTK and cannot draw pictures");
  EXPECT_THROW(draw_picture({}, {}, {}), IoError);
  EXPECT_THROW(draw_chart({}, {}), IoError);
  EXPECT_THROW(encode_png(1, 1, {}), IoError);
  EXPECT_THROW(write_curves("a.vtp", {}), IoError);
}

}  // namespace
}  // namespace batten
#endif
