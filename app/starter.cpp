// SPDX-License-Identifier: MIT
// The command `batten` as it is called: sets what the runtime libraries read only when they are loaded, and becomes the
// program that does the work. It loads next to nothing itself, so that it costs a millisecond.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <system_error>

namespace {

// Threads that spin while they wait make a fit ten times slower where other programs need the processors as well.
void let_threads_sleep() {
  if (!std::getenv("GOMP_SPINCOUNT")) ::setenv("OMP_WAIT_POLICY", "passive", 0);
}

// Large pages, and memory that is freed is kept: the first touch of pages takes a fifth of the time at a million
// points.
void keep_memory() {
  ::setenv("GLIBC_TUNABLES",
           "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:glibc.malloc.trim_threshold=4294967296", 0);
}

}  // namespace

int main(int, char** argv) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path program = (self.parent_path() / BATTEN_PROGRAM).lexically_normal();
  let_threads_sleep();
  keep_memory();
  ::execv(program.c_str(), argv);
  std::cerr << "batten: expected the program " << program.string() << ", found: " << std::strerror(errno) << '\n';
  return 127;
}
