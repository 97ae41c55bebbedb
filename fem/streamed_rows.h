// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace batten {

// The parts of rows that StreamedSmoother works on. ae holds E z or E x, inverse D^-1; n numbers each.

/// r = b - λ ae, z = gain D^-1 r
void first_step(double lambda, double gain, const double* inverse, const double* b, const double* ae, double* r,
                double* z, std::ptrdiff_t n);
/// The same for ae = 0.
void first_step_from_zero(double gain, const double* inverse, const double* b, double* r, double* z, std::ptrdiff_t n);
/// r -= λ ae, next = keep z + gain D^-1 r
struct StepFactors {
  double lambda, keep, gain;
};
void next_step(const StepFactors& f, const double* inverse, const double* ae, const double* z, double* r, double* next,
               std::ptrdiff_t n);
/// The same, and sum = before + z + next; before may be sum, or null for 0.
void next_step_with_sum(const StepFactors& f, const double* inverse, const double* ae, const double* z, double* r,
                        double* next, const double* before, double* sum, std::ptrdiff_t n);
/// out = a + b; out may be a or b.
void add_rows(const double* a, const double* b, double* out, std::ptrdiff_t n);
/// r -= λ ae
void last_residual(double lambda, const double* ae, double* r, std::ptrdiff_t n);
/// x · (a + b)
double sum_of_products(const double* x, const double* a, const double* b, std::ptrdiff_t n);

}  // namespace batten
