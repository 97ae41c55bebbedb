// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <unistd.h>

namespace batten::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string topo = "fit examples/data/topo.csv --x x --y y --value z ";

void expect_failure(const Folder& folder, const std::string& line, int status, const std::string& message,
                    const RunOptions& options = {}) {
  const Outcome run = run_batten(folder, words(line), options);
  EXPECT_EQ(run.status, status) << line;
  EXPECT_THAT(run.err, HasSubstr(message));
  EXPECT_THAT(lines(run.err), SizeIs(1)) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
}

TEST(BadOutput, unknown_extensions_are_answered_with_the_known_ones) {
  const Folder folder;
  expect_failure(folder, topo + "-o out.tif", 2, "-o: the name must end with .vti or .csv, found 'out.tif'");
  expect_failure(folder, topo + "-o out", 2, "-o: the name must end with .vti or .csv, found 'out'");
  expect_failure(folder, topo + "-o out.csv --picture p.jpg", 2, "--picture: the name must end with .png");
  expect_failure(folder, topo + "-o out.csv --points-out p.csv", 2, "--points-out: the name must end with .vtp");
  expect_failure(folder, topo + "-o out.csv --report r.txt", 2, "--report: the name must end with .json");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(BadOutput, a_folder_that_does_not_exist) {
  const Folder folder;
  expect_failure(folder, topo + "-o no/out.csv", 1, "no/out.csv: the output folder no does not exist");
  expect_failure(folder, topo + "-o out.csv --report no/r.json", 1, "no/r.json: the output folder no does not exist");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(BadOutput, a_folder_that_cannot_be_written) {
  const Folder folder;  // nobody, root neither, makes files in /proc
  expect_failure(folder, topo + "-o /proc/out.csv", 1, "/proc/out.csv: the output folder /proc cannot be written");
}

TEST(BadOutput, a_folder_without_permission_to_write) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const Folder folder;
  std::filesystem::create_directory(folder / "locked");
  std::filesystem::permissions(folder / "locked", std::filesystem::perms::owner_read);
  expect_failure(folder, topo + "-o locked/out.csv", 1, "locked/out.csv: ");
}

TEST(BadOutput, an_output_that_is_a_device_or_a_folder_is_refused_and_stays) {
  const Folder folder;
  std::filesystem::create_symlink("/dev/null", folder / "null.csv");
  std::filesystem::create_directory(folder / "folder.csv");
  expect_failure(folder, topo + "-o null.csv", 1, "null.csv: exists and is not a regular file");
  expect_failure(folder, topo + "-o folder.csv", 1, "folder.csv: exists and is not a regular file");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "null.csv"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THAT(folder.names(), ElementsAre("folder.csv", "null.csv"));
}

TEST(BadOutput, the_input_is_not_overwritten) {
  const Folder folder;
  const std::string text = "x,y,z\n0,0,1\n1,0,2\n0,1,3\n";
  folder.write("in.csv", text);
  expect_failure(folder, "fit in.csv --x x --y y --value z -o ./in.csv", 2, "is an input and would be overwritten");
  EXPECT_EQ(folder.read("in.csv"), text);
}

// A limit on the size of files acts as a full disk does. Whatever fails to fit leaves nothing under its name.
void expect_full_disk(const std::string& outputs, std::size_t room, const std::string& too_long) {
  const Folder folder;
  RunOptions options;
  options.file_size_limit = room;
  expect_failure(folder, topo + "--cells 4 4 " + outputs, 1, too_long + ": cannot be written", options);
  EXPECT_FALSE(folder.has(too_long));
  for (const std::string& name : folder.names()) EXPECT_FALSE(name.starts_with('.')) << name;
}

TEST(BadOutput, a_full_disk_leaves_no_table) { expect_full_disk("-o out.csv", 512, "out.csv"); }

TEST(BadOutput, a_full_disk_leaves_no_report) {
  const Folder folder;
  RunOptions options;
  options.file_size_limit = 600;  // room for a surface of 3 x 3 corners
  expect_failure(folder, topo + "--cells 2 2 -o out.csv --report r.json", 1, "r.json: cannot be written", options);
  EXPECT_THAT(folder.names(), ElementsAre("out.csv"));
}

TEST(BadOutput, a_full_disk_leaves_no_image_points_or_picture) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  expect_full_disk("-o out.vti", 2048, "out.vti");
  expect_full_disk("-o out.csv --points-out p.vtp", 2048, "p.vtp");
  expect_full_disk("-o out.csv --picture p.png", 4096, "p.png");
}

TEST(BadOutput, an_output_that_fails_keeps_the_file_that_was_there) {
  const Folder folder;
  folder.write("out.csv", "old");
  RunOptions options;
  options.file_size_limit = 512;
  expect_failure(folder, topo + "--cells 8 8 -o out.csv", 1, "out.csv: cannot be written", options);
  EXPECT_EQ(folder.read("out.csv"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("out.csv"));
}

}  // namespace
}  // namespace batten::test
