// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/time_stepping.h>
#include <batten/flows/stokes.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace batten {

/// The table [modes]: which free vibrations are asked for.
struct ModeRequest {
  int count = 6;
  Field density = 1;
};

/// What a problem file says (docs/solve.md). At most one of modes, motion and flow is there.
struct ProblemFile {
  BoundaryProblem problem;            ///< of a flow the plate that its stream function is
  std::optional<StokesProblem> flow;  ///< problem = "stokes"
  IterationLimits limits;
  std::optional<ModeRequest> modes;
  std::optional<Motion> motion;

  /// As `problem` in the file.
  const char* kind() const { return flow ? "stokes" : problem.is_plate() ? "plate" : "poisson"; }
  /// "w" of a plate, "u" of a Poisson problem.
  const char* unknown() const { return problem.is_plate() ? "w" : "u"; }
};

/// Reads a problem. Tables are looked for beside the file. Throws IoError, or InvalidInput with one line: where in the
/// file, what was expected, what was found.
ProblemFile read_problem(const std::filesystem::path& file);

/// The same for a text that stands in no file; `name` stands for that of the file in messages, tables are looked for in
/// the current folder.
ProblemFile parse_problem(std::string_view text, const std::string& name);

}  // namespace batten
