// SPDX-License-Identifier: MIT
#include <batten/fem/streamed_rows.h>

namespace batten {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void first_step(double lambda, double gain, const double* inverse, const double* b, const double* ae,
                double* __restrict r, double* __restrict z, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double residual = b[i] - lambda * ae[i];
    r[i] = residual;
    z[i] = gain * (inverse[i] * residual);
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void first_step_from_zero(double gain, const double* inverse, const double* b, double* __restrict r,
                          double* __restrict z, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    r[i] = b[i];
    z[i] = gain * (inverse[i] * b[i]);
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void next_step(const StepFactors& f, const double* inverse, const double* ae, const double* z, double* __restrict r,
               double* __restrict next, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double residual = r[i] - f.lambda * ae[i];
    r[i] = residual;
    next[i] = f.keep * z[i] + f.gain * (inverse[i] * residual);
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void next_step_with_sum(const StepFactors& f, const double* inverse, const double* ae, const double* z,
                        double* __restrict r, double* __restrict next, const double* before, double* sum,
                        std::ptrdiff_t n) {
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double residual = r[i] - f.lambda * ae[i];
    const double value = f.keep * z[i] + f.gain * (inverse[i] * residual);
    r[i] = residual;
    next[i] = value;
    sum[i] = (before ? before[i] : 0) + (z[i] + value);
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_rows(const double* a, const double* b, double* out, std::ptrdiff_t n) {
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = a[i] + b[i];
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void last_residual(double lambda, const double* ae, double* __restrict r, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) r[i] -= lambda * ae[i];
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
double
sum_of_products(const double* x, const double* a, const double* b, std::ptrdiff_t n) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::ptrdiff_t i = 0; i < n; ++i) sum += x[i] * (a[i] + b[i]);
  return sum;
}

}  // namespace batten
