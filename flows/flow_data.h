// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/fem/null_space.h>
#include <batten/flows/flow_fit.h>

#include <Eigen/Core>

namespace batten {

/// The observations of a flow in the scale that the solver works with. Each vector gives two rows: of ψ the slope
/// ψ_y = u and ψ_x = -v, of φ the slope φ_x = u and φ_y = v. `value` is less the null element and divided by `scale`.
///
/// On a sphere, whose parallel at latitude y is shorter than that in the middle by the factor c = cos y / cos y_mid,
/// slopes in normalised x are c times a velocity: such rows have values times c and weights over c².
struct FlowData {
  FitData rows;
  std::vector<double> stretch;       ///< c of each row; 1 in a plane
  QuadraticFunction null_element;    ///< of ψ or φ over the length of the longer side; 0 unless all sides are free
  QuadraticFunction null_potential;  ///< of General: a multiple of s² + t² in φ, likewise
  std::size_t outside = 0, merged = 0;
};

/// The energy of a model's ψ or φ.
Energy energy_of(FlowModel model);

/// That of the options: a sphere of the Earth's mean radius, or a plane.
FlowGeometry geometry_of(const FlowOptions& options);

/// Checks the observations, leaves out those outside the region and those of weight 0, scales the rest. With
/// `merge_coincident` observations at the same place become one, of their mean and summed weight. Throws InvalidInput
/// as fit_flow does.
FlowData prepare_flow(const VectorObservations& observations, const Rectangle& region, const FlowOptions& options,
                      bool merge_coincident);

/// What the functions without energy that a null element is made of measure, a column for each: rows as those of the
/// data.
Eigen::MatrixXd null_measurements(const FlowData& data, const Rectangle& region, const FlowOptions& options);

/// Adds so much of each of them, in the scale of the data, to the null element.
void add_to_null_element(const Eigen::VectorXd& amounts, const Rectangle& region, const FlowOptions& options,
                         FlowData& data);

}  // namespace batten
