// SPDX-License-Identifier: MIT
#include <batten/bench/support/timing.h>
#include <batten/bench/support/triad.h>

#include <unistd.h>

namespace batten {

std::size_t cache_bytes() {
  const long level3 = sysconf(_SC_LEVEL3_CACHE_SIZE);
  return level3 > 0 ? static_cast<std::size_t>(level3) : std::size_t{32} << 20;
}

Triad::Triad() {
  const std::size_t bytes = std::max(std::size_t{256} << 20, 4 * cache_bytes());
  const std::size_t n = std::min(bytes, std::size_t{1} << 30) / sizeof(double);
  a_.assign(n, 0.);
  b_.assign(n, 1.);
  c_.assign(n, 2.);
}

double Triad::bytes_per_second() {
  const auto n = static_cast<std::ptrdiff_t>(a_.size());
  double* const a = a_.data();
  const double* const b = b_.data();
  const double* const c = c_.data();
  const double scale = 0.5;
  const double seconds = least_seconds(6, [=] {
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) a[i] = b[i] + scale * c[i];
  });
  return 3. * static_cast<double>(array_bytes()) / seconds;
}

}  // namespace batten
