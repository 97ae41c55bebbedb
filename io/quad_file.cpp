// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/grid_data.h>
#include <batten/io/quad_file.h>
#include <batten/io/sample_checks.h>
#include <batten/io/vtk_output.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace batten {
namespace {

vtkNew<vtkPoints> points_of(const GridSamples& grid) {
  const vtkIdType nx = grid.points[0], ny = grid.points[1];
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(nx * ny);
  for (int j = 0; j < grid.points[1]; ++j)
    for (int i = 0; i < grid.points[0]; ++i)
      points->SetPoint(i + j * nx, grid.origin[0] + i * grid.spacing[0], grid.origin[1] + j * grid.spacing[1], 0);
  return points;
}

vtkNew<vtkCellArray> quads_of(const GridSamples& grid) {
  const vtkIdType nx = grid.points[0], ny = grid.points[1];
  vtkNew<vtkCellArray> quads;
  quads->AllocateExact((nx - 1) * (ny - 1), 4 * (nx - 1) * (ny - 1));
  for (vtkIdType j = 0; j + 1 < ny; ++j)
    for (vtkIdType k = nx * j; k + 1 < nx * (j + 1); ++k) quads->InsertNextCell({k, k + 1, k + nx + 1, k + nx});
  return quads;
}

}  // namespace

void write_quads(const std::filesystem::path& path, const GridSamples& grid, const Record& record) {
  check_arrays(grid, "write_quads");
  if (grid.points[0] < 2 || grid.points[1] < 2)
    throw InvalidInput("write_quads: the grid must have 2 x 2 points or more, found " + std::to_string(grid.points[0]) +
                       " x " + std::to_string(grid.points[1]));
  vtkNew<vtkUnstructuredGrid> quads;
  quads->SetPoints(points_of(grid));
  quads->SetCells(VTK_QUAD, quads_of(grid));
  add_grid_data(quads, grid, record);
  write_vtk(path, quads);
}

}  // namespace batten
