// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/fitted_curve.h>
#include <batten/fem/phase_time.h>

#include <string>
#include <vector>

namespace batten {

/// What is said about a subdivided curve beside its files.
struct CurveReport {
  const SubdivideArguments* arguments;
  const CurveInput* input;
  const FittedCurve* fitted = nullptr;  ///< of natural cubics
  std::size_t points_out = 0;
  std::vector<std::string> notes;
  std::vector<PhaseTime> seconds;  ///< of all phases, in order, and the total
};

/// Writes it as JSON to --report, with the keys that docs/subdivide.md lists. Throws IoError.
void write_report(const CurveReport& report);

}  // namespace batten
