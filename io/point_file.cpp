// SPDX-License-Identifier: MIT
#include <batten/io/point_file.h>
#include <batten/io/sample_checks.h>
#include <batten/io/vtk_output.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace batten {

void write_points(const std::filesystem::path& path, const ScatteredSamples& samples) {
  check_arrays(samples, "write_points");
  const auto count = static_cast<vtkIdType>(samples.x.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    points->SetPoint(i, samples.x[k], samples.y[k], samples.z[k]);
    vertices->InsertNextCell(1, &i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  for (const PointArray& array : samples.arrays)
    add_array(data->GetPointData(), array.name, array.values, array.components);
  const auto scalar = std::find_if(samples.arrays.begin(), samples.arrays.end(),
                                   [](const PointArray& array) { return array.components == 1; });
  if (scalar != samples.arrays.end()) data->GetPointData()->SetActiveScalars(scalar->name.c_str());

  const auto vector = std::find_if(samples.arrays.begin(), samples.arrays.end(),
                                   [](const PointArray& array) { return array.components == 3; });
  if (vector != samples.arrays.end()) data->GetPointData()->SetActiveVectors(vector->name.c_str());

  write_vtk(path, data);
}

}  // namespace batten
