// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/text_source.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace batten {
namespace {

// Owns an open file; standard input is left open.
class Descriptor {
public:
  explicit Descriptor(const std::filesystem::path& path)
      : owned_(path != "-"), value_(owned_ ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : STDIN_FILENO) {}
  ~Descriptor() {
    if (owned_ && value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }

private:
  bool owned_;
  int value_;
};

}  // namespace

TextSource::TextSource(const std::filesystem::path& path) : name_(path == "-" ? "standard input" : path.string()) {
  const Descriptor file(path);
  if (file.get() < 0) fail(errno);
  if (path == "-" || !map(file.get())) copy(file.get());
}

TextSource::~TextSource() {
  if (mapped_) ::munmap(mapped_, size_);
}

std::string_view TextSource::utf8_text() const {
  std::string_view all = text();
  if (all.starts_with("\xFF\xFE") || all.starts_with("\xFE\xFF"))
    throw InvalidInput(name_ + ": is encoded in UTF-16; save it as UTF-8");
  if (all.starts_with("\xEF\xBB\xBF")) all.remove_prefix(3);
  return all;
}

// False if the file is empty, no regular file, or cannot be mapped.
bool TextSource::map(int descriptor) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0) return false;
  size_ = static_cast<std::size_t>(status.st_size);
  void* const address = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor, 0);
  if (address == MAP_FAILED) return false;
  mapped_ = static_cast<char*>(address);
  return true;
}

void TextSource::copy(int descriptor) {
  constexpr std::size_t first_size = std::size_t{1} << 16;
  std::size_t filled = 0;
  while (true) {
    if (filled == copied_.size()) copied_.resize(std::max(first_size, 2 * copied_.size()));
    const ssize_t count = ::read(descriptor, copied_.data() + filled, copied_.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  copied_.resize(filled);
}

void TextSource::fail(int error) const {
  if (error == ENOENT) throw IoError(name_ + ": there is no such file");
  if (error == EISDIR) throw IoError(name_ + ": is a folder, a file is expected");
  throw IoError(name_ + ": cannot be read: " + std::generic_category().message(error));
}

}  // namespace batten
