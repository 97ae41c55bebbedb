// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/collection_file.h>
#include <batten/tests/io/temporary_folder.h>

#include <gtest/gtest.h>

#include <array>

namespace batten {
namespace {

TEST(CollectionFile, lists_files_and_times) {
  const TemporaryFolder folder;
  const std::array entries = {CollectionEntry{0, "a_0000.vti"}, CollectionEntry{0.1, "a_0001.vti"}};
  write_collection(folder / "a.pvd", entries);
  EXPECT_EQ(bytes_of(folder / "a.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
            "    <DataSet timestep=\"0\" file=\"a_0000.vti\"/>\n    <DataSet timestep=\"0.1\" file=\"a_0001.vti\"/>\n"
            "  </Collection>\n</VTKFile>\n");
}

TEST(CollectionFile, keeps_unusual_names_and_exact_times) {
  const TemporaryFolder folder;
  const std::array entries = {CollectionEntry{1. / 3, "a & \"b\" < c.vti"}};
  write_collection(folder / "a.pvd", entries);
  const std::string text = bytes_of(folder / "a.pvd");
  EXPECT_NE(text.find("timestep=\"0.3333333333333333\" file=\"a &amp; &quot;b&quot; &lt; c.vti\""), std::string::npos);
}

TEST(CollectionFile, throws_where_it_cannot_be_written) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_collection(folder / "no" / "a.pvd", {}), IoError);
}

}  // namespace
}  // namespace batten
