// SPDX-License-Identifier: MIT
#include <batten/app/flow_picture.h>
#include <batten/app/sample_file.h>
#include <batten/app/solve_flow.h>
#include <batten/app/solve_outputs.h>
#include <batten/flows/streamlines.h>

namespace batten {
namespace {

void write_flow(SolveWork& work, const GridSamples& grid) {
  const std::string& path = work.arguments.output;
  const StokesResult& result = work.account.flow->result;
  work.progress.show("write " + path);
  Record record = result.field.to_record();
  record.numbers = {{"mu", work.file.flow->viscosity},
                    {"dissipation", result.dissipation},
                    {"power", result.power},
                    {"accuracy", result.accuracy},
                    {"largest_divergence", result.largest_divergence}};
  record.texts = {{"model", work.file.kind()},          {"x", "x"}, {"y", "y"}, {"u", "u"}, {"v", "v"},
                  {"program", "batten " BATTEN_VERSION}};
  write_samples(path, grid, record);
  work.account.files.push_back(path);
}

void draw_flow(SolveWork& work, const GridSamples& grid) {
  constexpr int lines = 40;
  const std::string& path = work.arguments.picture;
  const FlowField& field = work.account.flow->result.field;
  work.progress.show("streamlines");
  std::vector<CurveSamples> curves;
  for (const Streamline& line : StreamlineTracer(field).evenly_spaced(lines)) curves.push_back(samples_of(field, line));
  work.account.flow->streamlines = curves.size();
  work.end_phase("streamlines");
  work.progress.show("draw " + path);
  draw_flow_picture({.path = path, .curves = std::move(curves), .heads = PictureOptions::Heads::Along}, grid);
  work.account.files.push_back(path);
}

}  // namespace

void solve_flow(SolveWork& work) {
  StokesResult result = solve_stokes(*work.file.flow, work.options());
  const StreamExtremes stream = stream_extremes(result.field);
  work.account.flow = FlowSolution{std::move(result), stream};
  work.account.notes = work.account.flow->result.notes;
  work.end_solve(work.account.flow->result.accuracy, work.account.flow->result.seconds);
  const GridSamples grid = work.account.flow->result.field.samples();
  for (const PointArray& array : grid.arrays)
    if (array.components == 1) work.account.extremes.push_back(extremes_of(grid, array));
  write_flow(work, grid);
  work.end_phase("write");
  if (work.arguments.picture.empty()) return;
  draw_flow(work, grid);
  work.end_phase("draw");
}

}  // namespace batten
