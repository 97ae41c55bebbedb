// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/solve_account.h>
#include <batten/domains/grid_samples.h>

#include <map>
#include <string>

namespace batten {

/// "out.vti" and "_mode1" give "out_mode1.vti".
std::string with_suffix(const std::string& file, const std::string& suffix);
/// The suffix of mode k of `count`, from 1: "_mode1", with so many digits that the names sort.
std::string mode_suffix(int k, int count);
/// The suffix of state k of `count`, from 0: "_0000".
std::string frame_suffix(int k, int count);
/// How many states a motion has at most, that of time 0 included.
int frame_count(const Motion& motion);
/// "out.vti" gives "out.pvd", the collection of a series.
std::string collection_name(const std::string& file);

/// Throws UsageError for unknown endings and for a file that is the input.
void check_solve_outputs(const SolveArguments& arguments);
/// Throws IoError if a series of modes or states cannot be written beside the name asked for.
void check_series_outputs(const SolveArguments& arguments, const ProblemFile& file);

/// At the corners of the cells; of plates also moments, shear forces and edge reactions (plate_forces.h).
GridSamples samples_of(const Solution& solution, const BoundaryProblem& problem);

/// Of the values that are numbers.
Extremes extremes_of(const GridSamples& grid, const PointArray& array);

/// A solution to write, and what its record says beside the coefficients.
struct SolutionFile {
  std::string path;
  const Solution* solution;
  const ProblemFile* problem;
  std::map<std::string, double> numbers;
};
void write_solution(const SolutionFile& file, const GridSamples& grid);

/// A shaded surface of the array "value".
void draw_surface_picture(const std::string& path, const GridSamples& grid, const std::string& name,
                          const std::string& title);
/// A map of a mode with its nodal lines in bold: Chladni's figure.
void draw_mode_picture(const std::string& path, const GridSamples& grid, const std::string& name,
                       const std::string& title);

}  // namespace batten
