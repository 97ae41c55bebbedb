// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace batten::test {

const bool has_vtk = BATTEN_COMMAND_HAS_VTK, has_starter = BATTEN_COMMAND_HAS_STARTER;

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// While it lives, this process and those it starts can write no file longer than that.
class FileSizeLimit {
public:
  explicit FileSizeLimit(std::optional<std::size_t> bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    if (bytes) limit.rlim_cur = *bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  rlimit before_ = {};
};

// A terminal: the command writes to one end, the test reads from the other.
struct Terminal {
  int reader = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  std::string name;

  Terminal() {
    if (reader < 0 || ::grantpt(reader) != 0 || ::unlockpt(reader) != 0) throw std::runtime_error("no terminal");
    name = ::ptsname(reader);
  }
  ~Terminal() { ::close(reader); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // All that is written until the other end is closed.
  std::string drain() const {
    std::string text;
    std::array<char, 4096> part;
    for (ssize_t count = 0; (count = ::read(reader, part.data(), part.size())) > 0;) {
      text.append(part.data(), static_cast<std::size_t>(count));
    }
    return text;
  }
};

struct Streams {
  fs::path in, out, err;
};

pid_t start(const fs::path& folder, const std::vector<std::string>& arguments, const Streams& streams) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, streams.in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, streams.out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, streams.err.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot run " + arguments[0]);
  return child;
}

int status_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

Outcome run(const fs::path& folder, const std::vector<std::string>& arguments, const RunOptions& options) {
  const fs::path aside = folder.string() + ".streams";
  fs::create_directory(aside);
  Streams streams{aside / "in", aside / "out", aside / "err"};
  std::ofstream(streams.in, std::ios::binary) << options.input;
  Outcome result;
  if (options.on_terminal) {
    const Terminal terminal;
    const int kept_open = ::open(terminal.name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    streams.err = terminal.name;
    const pid_t child = start(folder, arguments, streams);
    ::close(kept_open);
    result.err = terminal.drain();
    result.status = status_of(child);
  } else {
    const FileSizeLimit limit(options.file_size_limit);
    result.status = status_of(start(folder, arguments, streams));
    result.err = text_of(streams.err);
  }
  result.out = text_of(streams.out);
  fs::remove_all(aside);
  return result;
}

}  // namespace

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "batten-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make a folder");
  path_ = name;
  fs::create_directory(path_ / "examples");
  fs::create_directory_symlink(BATTEN_DATA, path_ / "examples" / "data");
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void Folder::write(const std::string& name, std::string_view text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

std::string Folder::read(const std::string& name) const { return text_of(path_ / name); }

bool Folder::has(const std::string& name) const { return fs::exists(path_ / name); }

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename());
  std::erase(names, "examples");
  std::sort(names.begin(), names.end());
  return names;
}

Outcome run_batten(const Folder& folder, const std::vector<std::string>& arguments, const RunOptions& options) {
  std::vector<std::string> all = {BATTEN_COMMAND};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run(folder.path(), all, options);
}

Outcome run_shell(const Folder& folder, const std::string& line) {
  const std::string path = fs::path(BATTEN_COMMAND).parent_path();
  return run(folder.path(), {"sh", "-c", "PATH='" + path + "':$PATH; " + line}, {});
}

Outcome expect_success(const Folder& folder, const std::string& line, const RunOptions& options) {
  Outcome run = run_batten(folder, words(line), options);
  EXPECT_EQ(run.status, 0) << line << '\n' << run.err;
  return run;
}

void expect_refusal(const Outcome& outcome, int status, const std::string& message) {
  EXPECT_EQ(outcome.status, status) << outcome.out;
  EXPECT_THAT(outcome.err, testing::HasSubstr(message));
  EXPECT_THAT(lines(outcome.err), testing::SizeIs(1)) << outcome.err;
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::vector<double> column(const Folder& folder, const std::string& file, const std::string& name) {
  const std::vector<std::string> rows = lines(folder.read(file));
  const auto fields = [](const std::string& row) {
    std::vector<std::string> result;
    for (std::size_t begin = 0; begin <= row.size();) {
      const std::size_t end = std::min(row.find(',', begin), row.size());
      result.push_back(row.substr(begin, end - begin));
      begin = end + 1;
    }
    return result;
  };
  if (rows.empty()) throw std::runtime_error(file + " is empty");
  const std::vector<std::string> header = fields(rows[0]);
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) throw std::runtime_error(file + " has no column " + name);
  const auto k = static_cast<std::size_t>(found - header.begin());
  std::vector<double> values;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string text = fields(rows[i]).at(k);
    values.push_back(text.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(text));
  }
  return values;
}

}  // namespace batten::test
