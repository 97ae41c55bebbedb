// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/curve_file.h>
#include <batten/io/vtk_output.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace batten {
namespace {

void check(std::span<const CurveSamples> curves) {
  for (const CurveSamples& curve : curves) {
    const std::size_t count = curve.x.size();
    if (count == 0 || curve.y.size() != count || curve.z.size() != count)
      throw InvalidInput("write_curves: x, y and z of '" + curve.name + "' must have equal lengths, found " +
                         std::to_string(count) + ", " + std::to_string(curve.y.size()) + " and " +
                         std::to_string(curve.z.size()));
    const auto& first = curves.front().arrays;
    bool match = curve.arrays.size() == first.size();
    for (std::size_t a = 0; match && a < first.size(); ++a) {
      const PointArray& array = curve.arrays[a];
      match = array.name == first[a].name && array.components == first[a].components &&
              array.values.size() == count * static_cast<std::size_t>(array.components);
    }
    if (!match)
      throw InvalidInput("write_curves: '" + curve.name + "' must have the arrays of '" + curves.front().name +
                         "', with a value for each of its points");
  }
}

/// One array over the points of all curves.
std::vector<double> joined(std::span<const CurveSamples> curves, std::size_t array) {
  std::vector<double> all;
  for (const CurveSamples& curve : curves) {
    const auto& values = curve.arrays[array].values;
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

}  // namespace

void write_curves(const std::filesystem::path& path, std::span<const CurveSamples> curves) {
  check(curves);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  std::vector<double> numbers;
  for (const CurveSamples& curve : curves) {
    const vtkIdType first = points->GetNumberOfPoints(), count = static_cast<vtkIdType>(curve.x.size());
    for (std::size_t i = 0; i < curve.x.size(); ++i) points->InsertNextPoint(curve.x[i], curve.y[i], curve.z[i]);
    lines->InsertNextCell(static_cast<int>(count + (curve.closed ? 1 : 0)));
    for (vtkIdType i = 0; i < count; ++i) lines->InsertCellPoint(first + i);
    if (curve.closed) lines->InsertCellPoint(first);
    numbers.push_back(static_cast<double>(numbers.size()));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  add_array(data->GetCellData(), "curve", numbers, 1);
  std::vector<std::vector<double>> values;  // VTK refers to them until the file is written
  if (!curves.empty())
    for (std::size_t a = 0; a < curves.front().arrays.size(); ++a) {
      values.push_back(joined(curves, a));
      const PointArray& array = curves.front().arrays[a];
      add_array(data->GetPointData(), array.name, values.back(), array.components);
    }
  write_vtk(path, data);
}

}  // namespace batten
