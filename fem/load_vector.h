// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>

#include <vector>

namespace batten {

/// b_i = ∫∫ q N_i + Σ P N_i(x_P) + ∫∫ m · ∇N_i + ... for all splines of the problem's degree on its cells, coefficients
/// x fastest: the loads of the problem and, for Conduction, the fluxes k normal through its sides. A constant area load
/// is integrated exactly, expressions and couples by degree + 2 Gauss points in each cell and direction; lines and
/// patches are cut at the borders of cells. Throws InvalidInput where a load is not finite, naming it, and for couples
/// at points of Conduction.
std::vector<double> load_vector(const BoundaryProblem& problem);

}  // namespace batten
