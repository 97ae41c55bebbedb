// SPDX-License-Identifier: MIT
#include <batten/bases/streaming_copy.h>

#include <algorithm>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace batten {

std::ptrdiff_t place_in_line(const double* address) {
  return static_cast<std::ptrdiff_t>(reinterpret_cast<std::uintptr_t>(address) / sizeof(double) % cache_line);
}

#ifdef __SSE2__

void streaming_copy(const double* in, std::ptrdiff_t n, double* out) {
  constexpr std::ptrdiff_t line = cache_line;
  std::ptrdiff_t i = std::min((line - place_in_line(out)) % line, n);
  std::copy_n(in, i, out);
  for (; i + line <= n; i += line)
    for (std::ptrdiff_t k = 0; k < line; k += 2) _mm_stream_pd(out + i + k, _mm_loadu_pd(in + i + k));
  std::copy_n(in + i, n - i, out + i);
}

void end_streaming() { _mm_sfence(); }

#else

void streaming_copy(const double* in, std::ptrdiff_t n, double* out) { std::copy_n(in, n, out); }

#endif

}  // namespace batten
