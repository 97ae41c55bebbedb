// SPDX-License-Identifier: MIT
#include <batten/app/flow_samples.h>
#include <batten/bases/stream_function.h>

#include <string>

namespace batten {
namespace {

/// At the vertices of nx x ny cells the mean of the cells around.
Eigen::MatrixXd vertex_means(const Eigen::MatrixXd& cells) {
  const Eigen::Index nx = cells.rows(), ny = cells.cols();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(nx + 1, ny + 1), counts = sums;
  for (Eigen::Index b : {0, 1})
    for (Eigen::Index a : {0, 1}) {
      sums.block(a, b, nx, ny) += cells;
      counts.block(a, b, nx, ny).array() += 1;
    }
  return sums.cwiseQuotient(counts);
}

PointArray array_of(const std::string& name, const Eigen::MatrixXd& values) {
  return {name, 1, {values.data(), values.data() + values.size()}};
}

}  // namespace

GridSamples samples_of_velocity(const ControlGrid& velocity) {
  const Eigen::MatrixXd &u = velocity.components[0], &v = velocity.components[1];
  PointArray vectors{"velocity", 3, {}};
  for (Eigen::Index k = 0; k < u.size(); ++k)
    for (double component : {u.data()[k], v.data()[k], 0.}) vectors.values.push_back(component);
  const Eigen::MatrixXd speed = (u.array().square() + v.array().square()).sqrt();
  return {.points = {static_cast<int>(u.rows()), static_cast<int>(u.cols())},
          .origin = velocity.start,
          .spacing = velocity.spacing,
          .arrays = {std::move(vectors), array_of("speed", speed)}};
}

GridSamples samples_of(const StaggeredField& field) {
  const StaggeredField shown = cropped(field, 1);
  const Eigen::MatrixXd cells = divergence(shown).components[0];
  GridSamples samples = samples_of_velocity(vertex_averages(field));
  samples.arrays.insert(samples.arrays.end(), {array_of("divergence", vertex_means(cells)),
                                               array_of("rotation", rotation(field).components[0]),
                                               array_of("stream_function", stream_function(shown).components[0])});
  samples.cell_arrays = {array_of("cell_divergence", cells)};
  return samples;
}

}  // namespace batten
