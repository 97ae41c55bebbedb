// SPDX-License-Identifier: MIT
#include <batten/app/solve_outputs.h>
#include <batten/app/solve_series.h>
#include <batten/domains/number_text.h>
#include <batten/fem/time_stepping.h>
#include <batten/fem/vibration.h>
#include <batten/io/collection_file.h>

#include <filesystem>

namespace batten {
namespace {

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

void solve_modes(SolveWork& work) {
  const SolveArguments& arguments = work.arguments;
  const int count = work.file.modes->count;
  const auto [modes, unknowns, iterations, cycles, seconds] =
      vibration(work.file.problem, count, work.file.modes->density, work.options());
  work.account.cycles = cycles;
  work.end_phase("modes");
  std::vector<CollectionEntry> series;
  std::vector<std::string> pictures;
  for (const Mode& mode : modes) {
    const int k = static_cast<int>(series.size()) + 1;
    const std::string path = with_suffix(arguments.output, mode_suffix(k, count));
    work.progress.show("write " + path);
    const GridSamples grid = samples_of(mode.shape, work.file.problem);
    write_solution({path, &mode.shape, &work.file, {{"mode", k}, {"eigenvalue", mode.eigenvalue}}}, grid);
    series.push_back({static_cast<double>(k), file_name(path)});
    work.account.files.push_back(path);
    work.account.modes.push_back({path, mode.eigenvalue, mode.residual});
    if (arguments.picture.empty()) continue;
    pictures.push_back(with_suffix(arguments.picture, mode_suffix(k, count)));
    work.progress.show("draw " + pictures.back());
    draw_mode_picture(pictures.back(), grid, work.file.unknown(),
                      "mode " + std::to_string(k) + ", frequency " + number_text(frequency(mode.eigenvalue), 6));
  }
  write_collection(collection_name(arguments.output), series);
  work.account.files.push_back(collection_name(arguments.output));
  work.account.files.insert(work.account.files.end(), pictures.begin(), pictures.end());
  work.end_phase("write");
}

void solve_motion(SolveWork& work) {
  const SolveArguments& arguments = work.arguments;
  const Motion& motion = *work.file.motion;
  const int count = frame_count(motion);
  std::vector<CollectionEntry> series;
  GridSamples last;
  const auto write_frame = [&](double time, const Solution& state) {
    const std::string path = with_suffix(arguments.output, frame_suffix(static_cast<int>(series.size()), count));
    last = samples_of(state, work.file.problem);
    write_solution({path, &state, &work.file, {{"time", time}}}, last);
    series.push_back({time, file_name(path)});
    work.account.files.push_back(path);
    work.account.frames.push_back({path, time, extremes_of(last, last.arrays.front())});
    work.progress.show("time " + number_text(time), time / motion.end);
  };
  const MarchResult result = march(work.file.problem, motion, write_frame, work.options());
  work.account.cycles = result.cycles;
  work.account.notes = result.notes;
  work.end_phase("march and write");
  write_collection(collection_name(arguments.output), series);
  work.account.files.push_back(collection_name(arguments.output));
  if (arguments.picture.empty()) return;
  work.progress.show("draw " + arguments.picture);
  draw_surface_picture(arguments.picture, last, work.file.unknown(), "time " + number_text(series.back().time, 6));
  work.account.files.push_back(arguments.picture);
  work.end_phase("draw");
}

}  // namespace batten
