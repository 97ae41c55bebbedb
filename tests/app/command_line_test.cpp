// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

const std::string topo = "examples/data/topo.csv";

void expect_usage_error(const std::string& line, const std::string& message) {
  const Folder folder;
  const Outcome run = run_batten(folder, words(line));
  EXPECT_EQ(run.status, 2) << line;
  EXPECT_THAT(lines(run.err), SizeIs(1)) << run.err;
  EXPECT_THAT(run.err, HasSubstr(message));
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(folder.names(), IsEmpty());
}

// The examples that the help of a command ends with.
std::vector<std::string> examples_of(const Outcome& help) {
  std::vector<std::string> examples;
  for (const std::string& line : lines(help.out)) {
    if (line.starts_with("  batten ")) examples.push_back(line);
  }
  return examples;
}

TEST(CommandLine, alone_shows_the_help) {
  const Outcome run = run_batten(Folder(), {});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("Usage: batten"));
  EXPECT_THAT(run.out, HasSubstr("evaluate"));
}

TEST(CommandLine, version_is_one_line) {
  const Outcome run = run_batten(Folder(), {"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(lines(run.out), testing::ElementsAre(testing::MatchesRegex("batten [0-9]+\\.[0-9]+\\.[0-9]+")));
}

TEST(CommandLine, threads_sleep_while_they_wait_unless_the_user_says_otherwise) {
  if (!has_starter) GTEST_SKIP() << "this command is called without its starter";
  const Folder folder;
  const std::string show = "OMP_DISPLAY_ENV=true batten --version";
  EXPECT_THAT(run_shell(folder, "unset OMP_WAIT_POLICY; " + show).err, HasSubstr("OMP_WAIT_POLICY = 'PASSIVE'"));
  EXPECT_THAT(run_shell(folder, "OMP_WAIT_POLICY=active " + show).err, HasSubstr("OMP_WAIT_POLICY = 'ACTIVE'"));
}

TEST(CommandLine, without_the_program_it_says_what_is_missing) {
  if (!has_starter) GTEST_SKIP() << "this command is called without its starter";
  const Folder folder;
  expect_refusal(run_shell(folder, "mkdir bin; cp \"$(command -v batten)\" bin; bin/batten --version"), 127,
                 "batten: expected the program " +
                     (std::filesystem::canonical(folder.path()) / "libexec/batten/batten").string() +
                     ", found: No such file or directory");
}

TEST(CommandLine, an_unknown_command_is_named_with_those_there_are) {
  expect_usage_error("fitt", "batten: there is no command 'fitt'; the commands are fit, evaluate");
}

TEST(CommandLine, an_unknown_option_is_named) {
  expect_usage_error("fit " + topo + " --x x --y y --value z -o o.csv --smooth 1", "batten fit: ");
  expect_usage_error("fit " + topo + " --x x --y y --value z -o o.csv --smooth 1", "--smooth");
}

TEST(CommandLine, what_is_required_is_named) {
  expect_usage_error("fit", "batten fit: POINTS is required");
  expect_usage_error("fit " + topo + " --x x --y y -o o.csv", "batten fit: --value is required");
  expect_usage_error("fit " + topo + " --x x --y y --value z", "batten fit: --output is required");
  expect_usage_error("evaluate a.vti -o o.csv", "batten evaluate: --at is required");
}

TEST(CommandLine, help_of_fit_states_the_functional_and_the_normalisation) {
  const Outcome help = run_batten(Folder(), {"fit", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, HasSubstr("sum_i w_i (p(x_i,y_i) - z_i)^2 / sum_i w_i  +  LAMBDA E(p)"));
  EXPECT_THAT(help.out, HasSubstr("p_xx^2 + 2 p_xy^2 + p_yy^2"));
  EXPECT_THAT(help.out, HasSubstr("the longer side of the region"));
  EXPECT_THAT(help.out, HasSubstr("LAMBDA is a pure number"));
}

TEST(CommandLine, examples_of_the_help_run_as_typed) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  for (const char* const command : {"fit", "evaluate", "flow", "solve"}) {
    const std::vector<std::string> examples = examples_of(run_batten(folder, {command, "--help"}));
    EXPECT_FALSE(examples.empty());
    for (const std::string& example : examples) {
      const Outcome run = run_shell(folder, example);
      EXPECT_EQ(run.status, 0) << example << '\n' << run.err;
    }
  }
  EXPECT_TRUE(folder.has("topo.vti"));
  EXPECT_TRUE(folder.has("rain.png"));
  EXPECT_TRUE(folder.has("there.csv"));
  EXPECT_TRUE(folder.has("lines.vtp"));
  EXPECT_TRUE(folder.has("plate.json"));
}

}  // namespace
}  // namespace batten::test
