// SPDX-License-Identifier: MIT
// Refine a creeping flow, and compare with its formula.
//
// A coarse flow on the walls of 8 x 8 cells: two eddies of opposite sense, from a stream function ψ at vertices,
//
//   u = ψ(x, y + 1) - ψ(x, y),   v = ψ(x, y) - ψ(x + 1, y),
//
// so that no cell has divergence. The slow flow that it drives, Δ(u_y - v_x) = 0 but at vertices, is the sum
//
//   Σ u_ij n_u(x - i, y - j - 1/2) + Σ v_ij n_v(x - i - 1/2, y - j)     [Warren & Weimer 2001, sec. 5.3.5]
//
// of analytic flows, and the limit of a subdivision scheme whose masks are not finite. Finite ones come near:
// 1. find the masks, of the kind that passes the divergence of a cell to its four children;
// 2. subdivide five times, zeros outside;
// 3. compare with the formula where the eddies are, and look at the divergence.
//
// Output: for masks of size 5, 9, 13, 17 the largest error over the largest speed, about 0.18, 0.05, 0.018 and 0.011,
// and the divergence over speed / spacing, rounding each time.
#include <batten/bases/flow_basis.h>
#include <batten/bases/optimal_flow_masks.h>
#include <batten/bases/subdivide_flow.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace {

batten::StaggeredField two_eddies() {
  Eigen::MatrixXd psi = Eigen::MatrixXd::Zero(9, 9);  // zero at the border: nothing leaves
  for (int j = 1; j < 8; ++j)
    for (int i = 1; i < 8; ++i) {
      const double y = j - 4, left = i - 2.5, right = i - 5.5;
      psi(i, j) = std::exp(-left * left - y * y) - std::exp(-right * right - y * y);
    }
  return {psi.rightCols(8) - psi.leftCols(8), psi.topRows(8) - psi.bottomRows(8)};
}

/// The largest difference of u from the formula, on every fourth wall within 2 of the middle.
double error(const batten::StaggeredField& coarse, const batten::StaggeredField& fine) {
  const batten::FlowBasis basis(batten::Flow::Slow);
  double largest = 0;
  for (int j = 0; j < fine.u.cols(); j += 4)
    for (int i = 0; i < fine.u.rows(); i += 4) {
      const double x = fine.start[0] + i * fine.spacing, y = fine.start[1] + (j + 0.5) * fine.spacing;
      if (std::max(std::abs(x - 4), std::abs(y - 4)) > 2) continue;
      largest = std::max(largest, std::abs(fine.u(i, j) - batten::flow_at(basis, coarse, x, y)[0]));
    }
  return largest;
}

}  // namespace

int main() {
  const batten::StaggeredField coarse = two_eddies();
  double last = 1, divergence = 0;
  for (int size : {5, 9, 13, 17}) {
    const auto optimal = batten::optimal_flow_masks(batten::Flow::Slow, batten::FlowKind::Commuting, size);
    const batten::StaggeredField fine =
        batten::subdivided(batten::to_double(optimal.masks), coarse, {.levels = 5, .sides = batten::FieldSides::Zero});
    const double speed = fine.u.cwiseAbs().maxCoeff();
    last = error(coarse, fine) / speed;
    divergence = batten::divergence(fine).components[0].cwiseAbs().maxCoeff() * fine.spacing / speed;
    std::cout << "size " << size << ": error " << last << ", divergence " << divergence << '\n';
  }
  return last < 0.02 && divergence < 1e-12 ? 0 : 1;
}
