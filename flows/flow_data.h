// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/fem/null_space.h>
#include <batten/flows/flow_fit.h>

namespace batten {

/// The observations of a flow in the scale that the solver works with. Each vector gives two rows: of ψ the slope
/// ψ_y = u and ψ_x = -v, of φ the slope φ_x = u and φ_y = v. `value` is less the null element and divided by `scale`.
struct FlowData {
  FitData rows;
  QuadraticFunction null_element;    ///< of ψ or φ over the length of the longer side; 0 unless all sides are free
  QuadraticFunction null_potential;  ///< of General: a multiple of s² + t² in φ, likewise
  std::size_t outside = 0, merged = 0;
};

/// The energy of a model's ψ or φ.
Energy energy_of(FlowModel model);

/// Checks the observations, leaves out those outside the region and those of weight 0, scales the rest. With
/// `merge_coincident` observations at the same place become one, of their mean and summed weight. Throws InvalidInput
/// as fit_flow does.
FlowData prepare_flow(const VectorObservations& observations, const Rectangle& region, const FlowOptions& options,
                      bool merge_coincident);

}  // namespace batten
