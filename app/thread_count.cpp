// SPDX-License-Identifier: MIT
#include <batten/app/thread_count.h>

#include <omp.h>
#include <unistd.h>

#include <cstdlib>

namespace batten {

void set_thread_count(int threads) {
  if (threads > 0) omp_set_num_threads(threads);
}

void let_threads_sleep(char** arguments) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  ::setenv("OMP_WAIT_POLICY", "passive", 1);
  // Large pages, and memory that is freed is kept: the first touch of pages takes a fifth of the time at a million
  // points.
  ::setenv("GLIBC_TUNABLES",
           "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:glibc.malloc.trim_threshold=4294967296", 0);
  ::execv("/proc/self/exe", arguments);  // returns only if it fails: then the threads spin
}

}  // namespace batten
