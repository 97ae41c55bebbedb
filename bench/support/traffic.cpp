// SPDX-License-Identifier: MIT
#include <batten/bench/support/traffic.h>

namespace batten {
namespace {

constexpr double number = sizeof(double);

double unknowns(const Multigrid& system, int level) {
  return static_cast<double>(system.hierarchy()[level].space.size());
}

/// The data part of one product with A (fem/data_term.cpp): the points, each with its row of the basis and its weight,
/// or, where they outnumber the unknowns and on the coarsest level, the stored half of the symmetric stencil. The
/// vectors are those of the energy part and counted there.
double data_traffic(const Multigrid& system, int level) {
  const auto& hierarchy = system.hierarchy();
  const double n = unknowns(system, level), points = static_cast<double>(system.data().size());
  const int d = hierarchy.degree();
  const bool stored = level + 1 == hierarchy.size() || points > n;
  const int entries = d + 1 + d * (2 * d + 1);
  return stored ? number * entries * n : (sizeof(PointRow) + number) * points;
}

}  // namespace

// fem/multigrid.cpp smooths with polynomials of the spline's degree + 1 before and after. In fem/smoother.cpp, for each
// level:
//   first step          z = gain r / D, x = z                                   reads r, D; writes z, x           4
//   every other step    r -= A z, z = keep z + gain r / D, x += z               reads z, r, x, D; writes z, r, x  7
//   before restriction  r -= A z                                                reads z, r; writes r              3
// Steps that share a pass (bases/wavefront.h) move less than that: the count stays what it was, one pass for each step.
//   transfers           read r here, write it below; read x below, write z here
// The coarsest level is solved directly; its vectors and factor are small and not counted.
double cycle_traffic(const Multigrid& system) {
  const auto& hierarchy = system.hierarchy();
  const int degree = hierarchy.degree() + 1;
  double sum = 0;
  for (int k = 0; k + 1 < hierarchy.size(); ++k) {
    const double n = unknowns(system, k), coarse = unknowns(system, k + 1);
    sum += number * n * (4 + 7 * (2 * degree - 1) + 3);
    sum += number * 2 * (n + coarse);
    sum += 2 * degree * data_traffic(system, k);
  }
  return sum;
}

// fem/conjugate_gradients.cpp, besides the V-cycle:
//   q = A p, p·q                        reads p; writes q                                                         2
//   c += s p, r -= s q, r for the cycle reads c, p, r, q; writes c, r and the copy of r that the cycle destroys   7
//   r·z                                 reads r; z comes from the cycle's last step                               1
//   p = z + s p                         reads z, p; writes p                                                      3
double iteration_traffic(const Multigrid& system) {
  return cycle_traffic(system) + data_traffic(system, 0) + number * unknowns(system, 0) * 13;
}

// r = b - A c reads b and c and writes r; at the start r is copied from b.
double solve_traffic(const Multigrid& system, int iterations) {
  const double ends = 2 * cycle_traffic(system) + data_traffic(system, 0) + number * unknowns(system, 0) * 5;
  return iterations * iteration_traffic(system) + ends;
}

}  // namespace batten
