// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/problem_file.h>
#include <batten/app/solve_arguments.h>
#include <batten/fem/boundary_solver.h>
#include <batten/fem/hierarchy.h>
#include <batten/fem/side_data.h>
#include <batten/flows/stokes.h>
#include <batten/flows/stream_extremes.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace batten {

/// The least and the largest value of an array at the corners of the cells, and where they are.
struct Extremes {
  struct Place {
    double value = 0, x = 0, y = 0;
  };
  std::string array;
  Place least, largest;
};

/// What was written of a mode of vibration.
struct ModeAccount {
  std::string file;
  double eigenvalue = 0, residual = 0;
};

/// What was written of a state of the motion.
struct FrameAccount {
  std::string file;
  double time = 0;
  Extremes extremes;
};

/// What was found of a flow.
struct FlowSolution {
  StokesResult result;
  StreamExtremes stream;
  std::size_t streamlines = 0;  ///< in the picture
};

/// What is said about a solution beside its files.
struct SolveAccount {
  const SolveArguments* arguments;
  const ProblemFile* file;
  std::optional<BoundaryResult> result;          ///< of a problem at rest
  std::optional<FlowSolution> flow;              ///< of a flow
  std::optional<std::array<double, 4>> corners;  ///< corner forces of a plate at rest
  std::vector<Extremes> extremes;                ///< of a problem at rest and a flow
  std::vector<ModeAccount> modes;
  std::vector<FrameAccount> frames;
  std::vector<std::string> notes;  ///< what the user should know, one line each
  int cycles = 0;                  ///< V-cycles of modes and motion
  std::vector<std::string> files;  ///< all that were written
  std::vector<PhaseTime> seconds;  ///< of all phases, in order, and the total

  const BoundaryProblem& problem() const { return file->problem; }
  std::size_t unknowns() const {
    return finest_space(problem().region, problem().degree, {}, side_conditions(problem())).kept();
  }
  bool is_plate() const { return file->problem.is_plate(); }
};

/// Angular frequency and frequency of an eigenvalue; 0 for those that rounding has made negative.
double angular_frequency(double eigenvalue);
double frequency(double eigenvalue);

/// Writes the numbers as JSON, with the keys that docs/solve.md lists. Throws IoError.
void write_report(const SolveAccount& account);

/// A few lines for standard output; of modes a table.
std::string summary_of(const SolveAccount& account);

}  // namespace batten
