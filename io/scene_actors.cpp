// SPDX-License-Identifier: MIT
#include <batten/io/colour_map.h>
#include <batten/io/scene_actors.h>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkStripper.h>
#include <vtkTypeInt32Array.h>

namespace batten {
namespace {

vtkNew<vtkLookupTable> colour_table() {
  constexpr int colours = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(colours);
  table->SetTableRange(0, 1);
  for (int k = 0; k < colours; ++k) {
    const auto colour = viridis(static_cast<double>(k) / (colours - 1));
    table->SetTableValue(k, colour[0] / 255., colour[1] / 255., colour[2] / 255.);
  }
  return table;
}

// A VTK array that refers to the mesh's.
vtkNew<vtkFloatArray> referring(std::vector<float>& values, int components) {
  constexpr int keep = 1;
  vtkNew<vtkFloatArray> array;
  array->SetNumberOfComponents(components);
  array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), keep);
  return array;
}

vtkNew<vtkPolyData> poly_data(SceneMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetData(referring(mesh.points, 3));
  vtkNew<vtkTypeInt32Array> corners;
  constexpr int keep = 1;
  corners->SetArray(mesh.triangles.data(), static_cast<vtkIdType>(mesh.triangles.size()), keep);
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(3, corners);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetPointData()->SetScalars(referring(mesh.levels, 1));
  data->GetPointData()->SetNormals(referring(mesh.normals, 3));
  return data;
}

// Adds shapes of one grey.
vtkNew<vtkActor> add_grey(vtkRenderer* renderer, vtkPolyData* shape, const LineStyle& style) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(0, 0, style.lift);
  actor->GetProperty()->SetColor(style.grey, style.grey, style.grey);
  actor->GetProperty()->SetOpacity(style.opacity);
  actor->GetProperty()->SetLineWidth(static_cast<float>(style.width));
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
  return actor;
}

}  // namespace

void add_mesh(vtkRenderer* renderer, SceneMesh& mesh, Shading shading) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(poly_data(mesh));
  mapper->SetLookupTable(colour_table());
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* const property = actor->GetProperty();
  const bool lit = shading == Shading::Lit;
  property->SetLighting(lit);
  property->SetAmbient(lit ? 0.35 : 1);  // flat: the colour itself
  property->SetDiffuse(lit ? 0.7 : 0);
  property->SetSpecular(lit ? 0.08 : 0);
  property->SetSpecularPower(20);
  renderer->AddActor(actor);
}

void add_contours(vtkRenderer* renderer, SceneMesh& mesh, std::span<const double> levels, const LineStyle& style) {
  vtkNew<vtkContourFilter> filter;
  filter->SetInputData(poly_data(mesh));
  for (std::size_t k = 0; k < levels.size(); ++k) filter->SetValue(static_cast<int>(k), levels[k]);
  // Joined, since between segments of opposite directions a pixel may stay empty.
  vtkNew<vtkStripper> joined;
  joined->SetInputConnection(filter->GetOutputPort());
  joined->JoinContiguousSegmentsOn();
  joined->Update();
  add_grey(renderer, joined->GetOutput(), style);
}

void add_lines(vtkRenderer* renderer, std::span<const SceneLine> lines, const LineStyle& style) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [from, to] : lines) {
    cells->InsertNextCell({points->InsertNextPoint(from.data()), points->InsertNextPoint(to.data())});
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetLines(cells);
  add_grey(renderer, shape, style);
}

void add_dots(vtkRenderer* renderer, std::span<const ScenePoint> places, double diameter, double grey) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (const ScenePoint& place : places) vertices->InsertNextCell({points->InsertNextPoint(place.data())});
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetVerts(vertices);
  const vtkNew<vtkActor> actor = add_grey(renderer, shape, {.grey = grey});
  actor->GetProperty()->SetPointSize(static_cast<float>(diameter));
  actor->GetProperty()->RenderPointsAsSpheresOn();
}

}  // namespace batten
