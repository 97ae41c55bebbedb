// SPDX-License-Identifier: MIT
#include <batten/app/thread_count.h>

#include <omp.h>

namespace batten {

void set_thread_count(int threads) {
  if (threads > 0) omp_set_num_threads(threads);
}

}  // namespace batten
