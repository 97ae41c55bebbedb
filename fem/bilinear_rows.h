// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace batten {

// The parts of rows that BilinearSmoother works on. Whole cache lines are read. Rows in rings begin with a line and
// have one more on both sides.

/// Three rows of nine weights that are even in the columns: of the column itself and of its two neighbours.
struct BilinearWeights {
  double near[3], far[3];
};
struct BilinearInputs {
  const double* c[3];
  double gain;
  const double* b;
  double keep;
  const double* before;   // null for 0
  const double* soon[2];  // what is read or written next, to be asked for
};
/// out_i = gain b_i - keep before_i + Σ_q (near_q c_q,i + far_q (c_q,i-1 + c_q,i+1)), c in rings.
void bilinear_row(const BilinearWeights& weights, const BilinearInputs& in, double* out, std::ptrdiff_t n);

/// Up to four rows and their weights in a sum.
struct RowSum {
  int count = 0;
  double weights[4];
  const double* rows[4];
};
/// Values at and between coarse ones c, which may be read from column `first` to before `end`:
/// out_2i = even c_i, out_2i+1 = near (c_i + c_i+1) + far (c_i-1 + c_i+2), for 2 n values of the result, in a ring;
/// plus `add` if that is not null, of which whole lines are read too.
struct BetweenWeights {
  double even, near, far;
};
void refine_row(const BetweenWeights& weights, const double* add, const RowSum& c, std::ptrdiff_t first,
                std::ptrdiff_t end, double* out, std::ptrdiff_t n);
/// out_i = even r_2i + near (r_2i-1 + r_2i+1) for n values of the result; r in rings, out not.
void restrict_row(double even, double near, const RowSum& r, double* out, std::ptrdiff_t n);

/// out = a, from or to a ring.
void copy_row(const double* a, double* out, std::ptrdiff_t n);
/// out += a
void add_row(const double* a, double* out, std::ptrdiff_t n);
/// out = factor a b, elementwise.
void multiply_rows(double factor, const double* a, const double* b, double* out, std::ptrdiff_t n);
/// Σ (x - s) (scale (first - s) + r); s may be null for 0.
double sum_of_changes(const double* s, const double* x, double scale, const double* first, const double* r,
                      std::ptrdiff_t n);
/// Σ a b
double product_of_rows(const double* a, const double* b, std::ptrdiff_t n);

}  // namespace batten
