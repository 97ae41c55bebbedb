// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/output_file.h>
#include <batten/io/table.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string message(const std::filesystem::path& path) {
  return message_of<IoError>([&] { const OutputFile file(path); });
}

TEST(OutputFile, appears_with_commit_and_not_before) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a.txt");
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(bytes_of(folder / "a.txt"), "one two");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(OutputFile, leaves_nothing_without_commit) {
  const TemporaryFolder folder;
  { OutputFile(folder / "a.txt").write("one"); }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(OutputFile, replaces_a_file_only_with_commit) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.txt", "before");
  { OutputFile(path).write("lost"); }
  EXPECT_EQ(bytes_of(path), "before");
  OutputFile file(path);
  file.write("after");
  file.commit();
  EXPECT_EQ(bytes_of(path), "after");
}

TEST(OutputFile, has_the_permissions_of_a_new_file) {
  const TemporaryFolder folder;
  const mode_t mask = ::umask(022);
  OutputFile file(folder / "a.txt");
  file.commit();
  ::umask(mask);
  struct stat status = {};
  ASSERT_EQ(::stat((folder / "a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST(OutputFile, follows_symbolic_links) {
  const TemporaryFolder folder;
  const auto target = folder.file("target.txt", "before");
  std::filesystem::create_symlink("target.txt", folder / "link.txt");
  std::filesystem::create_symlink("new.txt", folder / "dangling.txt");
  for (const auto* name : {"link.txt", "dangling.txt"}) {
    OutputFile file(folder / name);
    file.write("after");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / name));
  }
  EXPECT_EQ(bytes_of(target), "after");
  EXPECT_EQ(bytes_of(folder / "new.txt"), "after");
}

TEST(OutputFile, needs_a_folder) {
  const TemporaryFolder folder;
  const std::string missing = (folder / "no" / "a.txt").string(), within = (folder.file("f", "") / "a.txt").string();
  EXPECT_EQ(message(missing), missing + ": the output folder " + (folder / "no").string() + " does not exist");
  EXPECT_EQ(message(within), within + ": " + (folder / "f").string() + " is not a folder");
  EXPECT_EQ(message(""), "output '': is not the name of a file");
  EXPECT_EQ(message(folder.path() / ""), "output '" + folder.path().string() + "/': is not the name of a file");
}

// Root may write everywhere, so a child gives that up.
TEST(OutputFile, needs_a_folder_that_can_be_written) {
  const TemporaryFolder folder;
  ::chmod(folder.path().c_str(), 0555);
  const auto print_message = [&] {
    constexpr uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setuid(nobody) != 0) std::_Exit(1);
    std::fputs(message(folder / "a.txt").c_str(), stderr);
    std::_Exit(0);
  };
  EXPECT_EXIT(print_message(), ::testing::ExitedWithCode(0),
              "the output folder .* cannot be written: Permission denied$");
  ::chmod(folder.path().c_str(), 0755);
}

TEST(OutputFile, spares_what_is_no_regular_file_and_what_is_read_only) {
  const TemporaryFolder folder;
  EXPECT_EQ(message("/dev/null"), "/dev/null: exists and is not a regular file");
  EXPECT_EQ(message(folder.path()), folder.path().string() + ": exists and is not a regular file");
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(message(pipe), pipe + ": exists and is not a regular file");
  const auto locked = folder.file("locked.txt", "before");
  ::chmod(folder.path().c_str(), 0777);
  ::chmod(locked.c_str(), 0444);
  const auto print_message = [&] {
    constexpr uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setuid(nobody) != 0) std::_Exit(1);
    std::fputs(message(locked).c_str(), stderr);
    std::_Exit(0);
  };
  EXPECT_EXIT(print_message(), ::testing::ExitedWithCode(0), "exists and may not be written: Permission denied$");
}

TEST(OutputFile, can_be_checked_before_there_is_anything_to_write) {
  const TemporaryFolder folder;
  check_output(folder / "a.txt");
  EXPECT_THAT(folder.names(), IsEmpty());
  EXPECT_EQ(message_of<IoError>([] { check_output("/dev/null"); }), "/dev/null: exists and is not a regular file");
}

// A file size limit acts like a full disk.
TEST(OutputFile, reports_a_full_disk_and_leaves_nothing) {
  const TemporaryFolder folder;
  const auto write_too_much = [&] {
    const rlimit limit = {100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::vector<std::string> names = {"x"};
    const std::vector<std::vector<double>> columns = {std::vector<double>(200000, 0.5)};
    std::fputs(message_of<IoError>([&] { write_table(folder / "a.csv", names, columns); }).c_str(), stderr);
    std::_Exit(0);
  };
  EXPECT_EXIT(write_too_much(), ::testing::ExitedWithCode(0), "a.csv: cannot be written: File too large$");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(OutputFile, does_not_change_how_the_process_takes_signals) {
  const TemporaryFolder folder;
  const auto write_then_raise = [&] {
    const rlimit limit = {1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string text(5000, 'a');
    const bool refused = message_of<IoError>([&] {
                           OutputFile file(folder / "a.txt");
                           file.write(text);
                           file.commit();
                         }).find("File too large") != std::string::npos;
    if (!refused) std::_Exit(1);
    std::raise(SIGXFSZ);
    std::_Exit(0);
  };
  EXPECT_EXIT(write_then_raise(), ::testing::KilledBySignal(SIGXFSZ), "");
}

}  // namespace
}  // namespace batten
