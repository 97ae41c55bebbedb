// SPDX-License-Identifier: MIT
#include <batten/io/colour_map.h>
#include <batten/io/plot_overlay.h>

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double ink = 0.1;  // grey level of texts

void add_actor(vtkRenderer* renderer, vtkPolyData* shape, const PenStyle& style) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  auto colour = style.colour;
  actor->GetProperty()->SetColor(colour.data());
  actor->GetProperty()->SetLineWidth(static_cast<float>(style.width));
  actor->GetProperty()->SetPointSize(static_cast<float>(style.width));
  renderer->AddActor2D(actor);
}

// VTK's numbers for left, centred and right, and likewise for bottom, centred and top, seen by a reader of the text:
// the top of a text that runs upwards is to the left.
struct VtkAnchors {
  int along, across;
};

VtkAnchors vtk_anchors(const TextStyle& style) {
  const int horizontal = static_cast<int>(style.horizontal), vertical = static_cast<int>(style.vertical);
  constexpr int last = static_cast<int>(TextStyle::Anchor::High);
  return style.upwards ? VtkAnchors{vertical, last - horizontal} : VtkAnchors{horizontal, vertical};
}

void apply(const TextStyle& style, double font_size, vtkTextProperty* property) {
  property->SetFontFamilyToArial();
  property->SetFontSize(static_cast<int>(std::lround(style.size * font_size)));
  property->SetBold(style.bold ? 1 : 0);
  property->SetColor(ink, ink, ink);
  property->SetJustification(vtk_anchors(style).along);
  property->SetVerticalJustification(vtk_anchors(style).across);
  property->SetOrientation(style.upwards ? 90 : 0);
}

}  // namespace

PlotOverlay::PlotOverlay(vtkRenderer* renderer, double font_size) : renderer_(renderer), font_size_(font_size) {}

std::array<double, 2> PlotOverlay::text_size(const std::string& text, const TextStyle& style) const {
  if (text.empty()) return {0, 0};
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  apply(style, font_size_, actor->GetTextProperty());
  std::array<double, 2> size = {0, 0};
  actor->GetSize(renderer_, size.data());
  return size;
}

TextStyle PlotOverlay::fitted(const std::string& text, TextStyle style, double length) const {
  const double found = text_size(text, style)[style.upwards ? 1 : 0];
  if (found > length) style.size *= length / found;
  return style;
}

void PlotOverlay::add_text(const std::string& text, const Pixel& place, const TextStyle& style) {
  if (text.empty()) return;
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  apply(style, font_size_, actor->GetTextProperty());
  actor->SetPosition(std::round(place[0]), std::round(place[1]));
  renderer_->AddActor2D(actor);
}

void PlotOverlay::add_line(std::span<const Pixel> places, const PenStyle& style) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(places.size()));
  for (const Pixel& place : places) lines->InsertCellPoint(points->InsertNextPoint(place[0], place[1], 0));
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetLines(lines);
  add_actor(renderer_, shape, style);
}

void PlotOverlay::add_dots(std::span<const Pixel> places, const PenStyle& style) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> dots;
  for (const Pixel& place : places) {
    const vtkIdType at = points->InsertNextPoint(place[0], place[1], 0);
    dots->InsertNextCell(1, &at);
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetVerts(dots);
  add_actor(renderer_, shape, style);
}

void PlotOverlay::add_colour_bar(const Pixel& low, const Pixel& high) {
  constexpr int bands = 256;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (int k = 0; k <= bands; ++k) {
    const double y = low[1] + (high[1] - low[1]) * k / bands;
    points->InsertNextPoint(low[0], y, 0);
    points->InsertNextPoint(high[0], y, 0);
  }
  for (vtkIdType k = 0; k < bands; ++k) {
    quads->InsertNextCell({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
    const auto colour = viridis(static_cast<double>(k) / (bands - 1));
    colours->InsertNextTypedTuple(colour.data());
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(quads);
  shape->GetCellData()->SetScalars(colours);
  add_actor(renderer_, shape, {});
}

}  // namespace batten
