// SPDX-License-Identifier: MIT
#include <batten/bases/staggered_field.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

std::string size_text(const Eigen::MatrixXd& m) { return std::to_string(m.rows()) + " x " + std::to_string(m.cols()); }

void require_inner_vertices(const char* function, const StaggeredField& field) {
  require_field(function, field);
  if (field.cells_x() < 2 || field.cells_y() < 2)
    throw InvalidInput(std::string(function) + ": the field must have 2 x 2 cells or more, found " +
                       std::to_string(field.cells_x()) + " x " + std::to_string(field.cells_y()));
}

/// A grid whose first value is so many cells from the start of the field.
ControlGrid grid_at(const StaggeredField& field, double offset, std::vector<Eigen::MatrixXd> components) {
  return {.components = std::move(components),
          .start = {field.start[0] + offset * field.spacing, field.start[1] + offset * field.spacing},
          .spacing = {field.spacing, field.spacing}};
}

Eigen::MatrixXd extended(const Eigen::MatrixXd& m, int cells, FieldSides sides) {
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(m.rows() + 2 * cells, m.cols() + 2 * cells);
  if (sides == FieldSides::Zero) {
    wide.block(cells, cells, m.rows(), m.cols()) = m;
    return wide;
  }
  for (Eigen::Index j = 0; j < wide.cols(); ++j)
    for (Eigen::Index i = 0; i < wide.rows(); ++i)
      wide(i, j) =
          m(std::clamp<Eigen::Index>(i - cells, 0, m.rows() - 1), std::clamp<Eigen::Index>(j - cells, 0, m.cols() - 1));
  return wide;
}

StaggeredField moved(const StaggeredField& field, int cells, Eigen::MatrixXd u, Eigen::MatrixXd v) {
  const double by = cells * field.spacing;
  return {std::move(u), std::move(v), {field.start[0] + by, field.start[1] + by}, field.spacing};
}

}  // namespace

void require_field(const char* function, const StaggeredField& field) {
  const std::string name = std::string(function) + ": ";
  if (field.u.rows() != field.v.rows() + 1 || field.u.cols() + 1 != field.v.cols() || field.v.size() == 0 ||
      field.u.size() == 0)
    throw InvalidInput(name + "u must have (nx+1) x ny values and v nx x (ny+1), found " + size_text(field.u) +
                       " and " + size_text(field.v));
  if (!field.u.allFinite() || !field.v.allFinite()) throw InvalidInput(name + "velocities must be finite");
  if (!(field.spacing > 0) || !std::isfinite(field.spacing))
    throw InvalidInput(name + "the spacing must be positive, found " + number_text(field.spacing, 6));
}

StaggeredField from_vertices(const ControlGrid& vertices) {
  if (vertices.components.size() != 2)
    throw InvalidInput("from_vertices: two components are needed, found " + std::to_string(vertices.components.size()));
  const Eigen::MatrixXd &u = vertices.components[0], &v = vertices.components[1];
  if (u.rows() != v.rows() || u.cols() != v.cols() || u.rows() < 2 || u.cols() < 2)
    throw InvalidInput("from_vertices: u and v must have the same 2 x 2 vertices or more, found " + size_text(u) +
                       " and " + size_text(v));
  const auto [hx, hy] = vertices.spacing;
  if (!(std::abs(hx - hy) <= 1e-6 * std::abs(hx)))
    throw InvalidInput("from_vertices: cells must be square, found the spacing " + number_text(hx, 6) + " in x and " +
                       number_text(hy, 6) + " in y");
  StaggeredField field{(u.leftCols(u.cols() - 1) + u.rightCols(u.cols() - 1)) / 2,
                       (v.topRows(v.rows() - 1) + v.bottomRows(v.rows() - 1)) / 2, vertices.start, hx};
  require_field("from_vertices", field);
  return field;
}

ControlGrid vertex_averages(const StaggeredField& field) {
  require_inner_vertices("vertex_averages", field);
  const auto nx = field.cells_x() - 1, ny = field.cells_y() - 1;
  return grid_at(field, 1,
                 {(field.u.block(1, 0, nx, ny) + field.u.block(1, 1, nx, ny)) / 2,
                  (field.v.block(0, 1, nx, ny) + field.v.block(1, 1, nx, ny)) / 2});
}

ControlGrid divergence(const StaggeredField& field) {
  require_field("divergence", field);
  const auto nx = field.cells_x(), ny = field.cells_y();
  return grid_at(
      field, 0.5,
      {(field.u.bottomRows(nx) - field.u.topRows(nx) + field.v.rightCols(ny) - field.v.leftCols(ny)) / field.spacing});
}

ControlGrid rotation(const StaggeredField& field) {
  require_inner_vertices("rotation", field);
  const auto nx = field.cells_x() - 1, ny = field.cells_y() - 1;
  return grid_at(field, 1,
                 {(field.u.block(1, 1, nx, ny) - field.u.block(1, 0, nx, ny) - field.v.block(1, 1, nx, ny) +
                   field.v.block(0, 1, nx, ny)) /
                  field.spacing});
}

StaggeredField padded(const StaggeredField& field, int cells, FieldSides sides) {
  require_field("padded", field);
  if (sides == FieldSides::Open || cells <= 0) return field;
  return moved(field, -cells, extended(field.u, cells, sides), extended(field.v, cells, sides));
}

StaggeredField cropped(const StaggeredField& field, int cells) {
  require_field("cropped", field);
  const auto nx = field.cells_x() - 2 * cells, ny = field.cells_y() - 2 * cells;
  if (nx < 1 || ny < 1)
    throw InvalidInput("cropped: taking " + std::to_string(cells) + " cells from each side leaves none of " +
                       std::to_string(field.cells_x()) + " x " + std::to_string(field.cells_y()));
  return moved(field, cells, field.u.block(cells, cells, nx + 1, ny), field.v.block(cells, cells, nx, ny + 1));
}

}  // namespace batten
