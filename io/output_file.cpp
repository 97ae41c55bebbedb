// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/file_size_signal.h>
#include <batten/io/output_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace batten {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = std::size_t{1} << 18;

std::string text_of(int error) { return std::generic_category().message(error); }

// The file that a write to `path` reaches, following symbolic links even where the last one leads nowhere yet.
fs::path followed(fs::path path) {
  constexpr int most_links = 40;  // as the kernel
  std::error_code error;
  for (int k = 0; k < most_links && fs::is_symlink(path, error); ++k) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void check_target(const fs::path& asked, const fs::path& target) {
  const std::string name = asked.string();
  std::error_code error;
  if (!target.has_filename()) throw IoError("output '" + name + "': is not the name of a file");
  const fs::path folder = folder_of(target);
  if (!fs::exists(folder, error)) throw IoError(name + ": the output folder " + folder.string() + " does not exist");
  if (!fs::is_directory(folder, error)) throw IoError(name + ": " + folder.string() + " is not a folder");
  const fs::file_status status = fs::status(target, error);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) throw IoError(name + ": exists and is not a regular file");
  if (::access(target.c_str(), W_OK) != 0) throw IoError(name + ": exists and may not be written: " + text_of(errno));
}

// Writes all of `bytes`; the error number, 0 if there was none.
int write_all(int descriptor, std::string_view bytes) {
  const FileSizeSignalBlock block;
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

// File systems without fsync answer EINVAL.
int synchronise(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno; }

}  // namespace

OutputFile::OutputFile(const fs::path& target) : asked_(target), target_(followed(target)) {
  check_target(asked_, target_);
  const fs::path folder = folder_of(target_);
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = folder / (".batten-" + std::to_string(::getpid()) + '-' + std::to_string(attempt) + ".tmp");
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) {
      throw IoError(asked_.string() + ": the output folder " + folder.string() +
                    " cannot be written: " + text_of(errno));
    }
  }
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= buffer_size) flush();
}

void OutputFile::flush() {
  const int error = write_all(descriptor_, buffer_);
  buffer_.clear();
  if (error != 0) fail(error);
}

void OutputFile::commit() {
  flush();
  if (const int error = synchronise(descriptor_)) fail(error);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail(errno);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void OutputFile::fail(int error) const { throw IoError(asked_.string() + ": cannot be written: " + text_of(error)); }

void check_output(const fs::path& target) { const OutputFile probe(target); }

}  // namespace batten
