// SPDX-License-Identifier: MIT
// Speed of subdividing 10^6 control points six levels (four of arity 3), as a share of the speed at which memory could
// hold the result: its bytes at the triad's bandwidth, measured in the same run. Once on all threads and once on one.
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/interpolatory_schemes.h>
#include <batten/bases/subdivide.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>
#include <batten/bench/support/triad.h>

#include <omp.h>

#include <cmath>
#include <string>
#include <vector>

namespace batten {
namespace {

struct Share {
  double nanoseconds, of_triad;  // for each resulting point; of the bound
};

Share share_of(const Scheme& scheme, const std::vector<double>& points, double bandwidth) {
  const SubdivisionOptions options{.levels = scheme.arity() == 3 ? 4 : 6, .ends = Ends::Periodic};
  const auto size = subdivided_range(scheme, static_cast<std::ptrdiff_t>(points.size()), options).size();
  std::vector<double> result(static_cast<std::size_t>(size));
  const double seconds = least_seconds(7, [&] { subdivide_into(scheme, points, options, result); });
  const double bytes = 8. * static_cast<double>(size);
  return {1e9 * seconds / static_cast<double>(size), bytes / bandwidth / seconds};
}

void measure_all(Report& report, const std::string& threads) {
  Triad triad;
  std::vector<double> points(1'000'000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = std::sin(0.001 * static_cast<double>(i));
  report.table("10^6 points, 6 levels (arity 3: 4), " + threads, {"scheme", "ns / point", "of triad bound"});
  for (const auto& scheme :
       {bspline_scheme(4), four_point_scheme(), bspline_scheme(3), six_point_scheme(), ternary_four_point_scheme()}) {
    const double bandwidth = triad.bytes_per_second();
    const auto share = share_of(scheme, points, bandwidth);
    report.row({scheme.name(), share.nanoseconds, share.of_triad});
    report.at_least(scheme.name() + ", share of the triad bound, " + threads, 0.5, share.of_triad);
  }
}

void measure(Report& report) {
  const int threads = omp_get_max_threads();
  measure_all(report, "all threads");
  omp_set_num_threads(1);
  measure_all(report, "one thread");
  omp_set_num_threads(threads);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "subdivision", batten::measure); }
