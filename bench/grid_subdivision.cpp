// SPDX-License-Identifier: MIT
// Subdividing a grid with large masks: the direct kernel against the Fourier transform, to find the size of mask from
// which the transform would win. One step from 1025 x 1025 to 2049 x 2049 values with reflection at the sides, where
// the transform is the cosine transform of type I: coarse values to their spectrum, times the symbol, back as fine
// values. FFTW with plans that it has measured; its plans are not counted.
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/bases/subdivide.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>

#include <fftw3.h>
#include <malloc.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace batten {
namespace {

constexpr int coarse_points = 1025, fine_points = 2 * coarse_points - 1;

/// One step by cosine transforms.
class TransformStep {
public:
  explicit TransformStep(const Mask2<double>& mask) : coarse_(coarse_points, coarse_points), symbol_(symbol_of(mask)) {
    fine_.resize(fine_points, fine_points);
    fftw_plan_with_nthreads(omp_get_max_threads());
    const auto plan = [](Eigen::MatrixXd& values) {
      const auto n = static_cast<int>(values.rows());
      return fftw_plan_r2r_2d(n, n, values.data(), values.data(), FFTW_REDFT00, FFTW_REDFT00, FFTW_MEASURE);
    };
    forth_ = plan(coarse_);
    back_ = plan(fine_);
  }
  ~TransformStep() {
    fftw_destroy_plan(forth_);
    fftw_destroy_plan(back_);
  }
  TransformStep(const TransformStep&) = delete;
  TransformStep& operator=(const TransformStep&) = delete;

  const Eigen::MatrixXd& operator()(const Eigen::MatrixXd& values) {
    coarse_ = values;
    fftw_execute(forth_);
#pragma omp parallel for
    for (int l = 0; l < fine_points; ++l)
      for (int k = 0; k < fine_points; ++k) fine_(k, l) = symbol_(k, l) * coarse_(turned(k), turned(l));
    fftw_execute(back_);
    return fine_;
  }

private:
  /// The spectrum of the values with zeros between them is that of the values, mirrored.
  static int turned(int k) { return std::min(k, fine_points - 1 - k); }

  /// The mask at the frequencies of the fine grid over the gain of both transforms. Their lines at the ends count once,
  /// the others twice, on both grids alike.
  static Eigen::MatrixXd symbol_of(const Mask2<double>& mask) {
    const int half = mask.last()[0];
    Eigen::MatrixXd cosines(fine_points, half + 1), coefficients(half + 1, half + 1);
    for (int k = 0; k < fine_points; ++k)
      for (int i = 0; i <= half; ++i)
        cosines(k, i) = (i == 0 ? 1 : 2) * std::cos(std::numbers::pi * i * k / (fine_points - 1));
    for (int j = 0; j <= half; ++j)
      for (int i = 0; i <= half; ++i) coefficients(i, j) = mask[{i, j}];
    const double gain = 4. * (fine_points - 1) * (fine_points - 1);
    return cosines * coefficients * cosines.transpose() / gain;
  }

  Eigen::MatrixXd coarse_, fine_, symbol_;
  fftw_plan forth_, back_;
};

void measure(Report& report) {
  // Memory that is freed is kept: the first touch of new pages, which both ways cost alike, is not of interest.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  fftw_init_threads();
  Eigen::MatrixXd values(coarse_points, coarse_points);
  for (int j = 0; j < coarse_points; ++j)
    for (int i = 0; i < coarse_points; ++i) values(i, j) = std::sin(0.01 * i) * std::cos(0.02 * j) + 0.001 * (i % 7);
  const double unknowns = double{fine_points} * fine_points;
  report.table("one step to 2049^2 values, all threads",
               {"size of the mask", "direct, ns / value", "FFT, ns / value", "FFT / direct", "largest difference"});
  double crossover = 0;
  for (int size : {5, 9, 17, 33, 65, 97, 129}) {
    const Scheme2 scheme("polyharmonic", with_unit_cosets(truncated_laurent_mask(1, size)));
    const GridSubdivisionOptions options{.levels = 1, .x = Ends::Reflect, .y = Ends::Reflect};
    ControlGrid fine;
    const double direct = least_seconds(5, [&] { fine = subdivided(scheme, {.components = {values}}, options); });
    TransformStep step(scheme.mask());
    const double transform = least_seconds(5, [&] { step(values); });
    const double difference = (step(values) - fine.components[0]).cwiseAbs().maxCoeff();
    report.row({size, 1e9 * direct / unknowns, 1e9 * transform / unknowns, transform / direct, difference});
    if (transform < direct && crossover == 0) crossover = size;
  }
  report.note("first size at which the transform wins (0: none)", crossover);
  fftw_cleanup_threads();
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "grid_subdivision", batten::measure); }
