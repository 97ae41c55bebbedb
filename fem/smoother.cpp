// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/wavefront.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/chebyshev_step.h>
#include <batten/fem/smoother.h>

#include <algorithm>
#include <numeric>

namespace batten {
namespace {

/// Functions that a condition takes away have the diagonal entry 0 and stay at 0.
double inverse_or_zero(double diagonal) { return diagonal > 0 ? 1 / diagonal : 0; }

/// r = b, z = x = gain D^-1 b
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void start_row(double gain, const double* inverse, const double* b, double* r, double* __restrict z,
               double* __restrict x, std::ptrdiff_t n) {
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    r[i] = b[i];  // b may be r
    z[i] = x[i] = gain * inverse[i] * r[i];
  }
}

struct RowUpdate {
  double lambda, keep, gain, old;
};

// r -= λ Ez; next = keep z + gain D^-1 r; x += old z + next. Ez comes in `next`.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void update_row(const RowUpdate& u, const double* __restrict inverse, const double* __restrict z,
                double* __restrict next, double* __restrict r, double* __restrict x, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double residual = r[i] - u.lambda * next[i];
    const double value = u.keep * z[i] + u.gain * (inverse[i] * residual);
    r[i] = residual;
    next[i] = value;
    x[i] += u.old * z[i] + value;
  }
}

Eigen::SparseMatrix<double> from_columns(int size, std::vector<int>& starts, std::vector<int>& rows,
                                         std::vector<double>& values) {
  return Eigen::Map<const Eigen::SparseMatrix<double>>(size, size, static_cast<int>(values.size()), starts.data(),
                                                       rows.data(), values.data());
}

}  // namespace

Smoother::Smoother(const Hierarchy::Level& level, const GridPoints& points, bool stored)
    : level_(&level),
      data_(level.space, points, stored),
      energy_diagonal_(level.energy.diagonal_rows()),
      row_sums_(static_cast<std::size_t>(level.space.y.size())) {}

void Smoother::set(double lambda, const PairWeights& weights, Kind kind) {
  lambda_ = lambda;
  data_.set_weights(weights);
  set_diagonal(kind);
  if (kind != Kind::DataAware) return;
  if (data_.is_stored()) return factor_grid();
  level_->space.is_periodic() ? factor_points_around() : factor_points();
  point_values_.resize(data_.size());
}

void Smoother::set_from_finer(const Smoother& finer) {
  lambda_ = finer.lambda_;
  data_.set_from_finer(finer.data_, *finer.level_->restriction);
  set_diagonal(Kind::Plain);
}

/// visit(i, D_i) for all coefficients.
template <typename Visit>
void Smoother::for_energy_diagonal(Visit&& visit) const {
  const int n = level_->energy.columns();
  for (int j = 0; j < level_->energy.rows(); ++j) {
    const double* diagonal = energy_diagonal_.row(j);
    for (int i = 0; i < n; ++i)
      visit(static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i), lambda_ * level_->bound * diagonal[i]);
  }
}

/// D, plus the lumped data where they are not to be inverted exactly.
void Smoother::set_diagonal(Kind kind) {
  points_factor_.reset();
  grid_factor_.reset();
  if (kind == Kind::Plain && data_.size() == 0 && !level_->energy.stencil() && !level_->space.is_periodic())
    return;  // StreamedSmoother has its own
  inverse_diagonal_ = kind == Kind::Plain ? data_.lumped() : std::vector<double>(size());
  fold_images(level_->space, inverse_diagonal_);
  for_energy_diagonal(
      [this](std::size_t i, double d) { inverse_diagonal_[i] = inverse_or_zero(inverse_diagonal_[i] + d); });
}

std::vector<double> Smoother::compliance() const {
  if (data_.size() == 0) return {};
  std::vector<double> inverse(size());
  for_energy_diagonal([&](std::size_t i, double d) { inverse[i] = inverse_or_zero(d); });
  fill_images(level_->space, inverse);
  return data_.compliance(inverse);
}

double Smoother::data_share() const {
  double share = 0;
  for_energy_diagonal([&](std::size_t i, double d) {
    if (inverse_diagonal_[i] > 0) share = std::max(share, 1 - d * inverse_diagonal_[i]);
  });
  return share;
}

double Smoother::stiffness() const {
  const auto& entries = energy_diagonal_.values();
  return lambda_ * *std::max_element(entries.begin(), entries.end()) * static_cast<double>(size());
}

// K_ij = (W^-1)_ij + Σ_c b_i[c] b_j[c] / D_c over the coefficients that points i and j share.
void Smoother::factor_points() {
  const int d = level_->space.x.degree(), n = level_->space.x.size(), rows = level_->space.y.interval().cells();
  const std::size_t count = data_.size();
  const PairWeights give = data_.weights().inverse();
  std::vector<int> starts = {0}, indices;
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const auto a = data_.row(i);
    for (int r = a.first_y; r <= std::min(a.first_y + d, rows - 1); ++r) {
      std::size_t low = std::max(i, data_.first_point(r));
      const std::size_t high = data_.first_point(r + 1);
      for (std::size_t step = high - std::min(low, high); step > 0;
           step /= 2)  // first point of the row that can meet i
        while (low + step <= high && low + step > i && data_.row(low + step - 1).first_x < a.first_x - d) low += step;
      for (std::size_t j = low; j < high; ++j) {
        const auto b = data_.row(j);
        if (b.first_x > a.first_x + d) break;
        double sum = give.entry(i, j);
        for (int q = std::max(a.first_y, b.first_y); q <= std::min(a.first_y, b.first_y) + d; ++q)
          for (int p = std::max(a.first_x, b.first_x); p <= std::min(a.first_x, b.first_x) + d; ++p) {
            const auto ap = static_cast<std::size_t>(p - a.first_x), aq = static_cast<std::size_t>(q - a.first_y);
            const auto bp = static_cast<std::size_t>(p - b.first_x), bq = static_cast<std::size_t>(q - b.first_y);
            sum += a.x[ap] * a.y[aq] * b.x[bp] * b.y[bq] * inverse_diagonal_[static_cast<std::size_t>(q) * n + p];
          }
        indices.push_back(static_cast<int>(j));
        values.push_back(sum);
      }
    }
    starts.push_back(static_cast<int>(indices.size()));
  }
  points_factor_.emplace(from_columns(static_cast<int>(count), starts, indices, values));
}

/// The same where neighbours may be found beyond the seam.
void Smoother::factor_points_around() {
  const Eigen::SparseMatrix<double> b = data_.columns();
  const Eigen::Map<const Eigen::VectorXd> inverse(inverse_diagonal_.data(), b.rows());
  Eigen::SparseMatrix<double> k = b.transpose() * (inverse.asDiagonal() * b);
  add_lower_triangle(data_.weights().inverse(), k);
  points_factor_.emplace(Eigen::SparseMatrix<double>(k.triangularView<Eigen::Lower>()));
}

// M = D + B^T W B from the stencil; where a diagonal entry is 0, of functions that are taken away, 1.
void Smoother::factor_grid() {
  const auto& space = level_->space;
  const int d = space.x.degree(), nx = space.x.size(), ny = space.y.size();
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double inverse = inverse_diagonal_[static_cast<std::size_t>(j) * nx + i];
      entries.emplace_back(j * nx + i, j * nx + i, inverse > 0 ? 1 / inverse : 1);
      for (int dy = 0; dy <= std::min(d, ny - 1 - j); ++dy)
        for (int dx = dy == 0 ? 0 : std::max(-d, -i); dx <= std::min(d, nx - 1 - i); ++dx) {
          const auto [column, row] = std::minmax({space.original(i, j), space.original(i + dx, j + dy)});
          const double value = data_.stencil().entry(i, j, dx, dy);
          if (value != 0) entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
        }
    }
  Eigen::SparseMatrix<double> lower(nx * ny, nx * ny);
  lower.setFromTriplets(entries.begin(), entries.end());
  grid_factor_.emplace(lower);
}

double Smoother::apply(std::span<const double> c, std::span<double> out) const {
  const auto& energy = level_->energy;
  if (level_->space.is_periodic()) {
    energy.apply(c, out);
    for (double& v : out) v *= lambda_;
    data_.add_normal(1, c, out);
    return dot(c, out);
  }
  const std::ptrdiff_t n = energy.columns();
  Wavefront(energy.rows(), 2, level_->space.y.degree()).run([&](int stage, int j, RowRange range) {
    const double* in = c.data() + j * n;
    double* row = out.data() + j * n;
    if (stage == 0) {
      energy.precise_row(j, c, row);
      for (std::ptrdiff_t i = 0; i < n; ++i) row[i] *= lambda_;
      return;
    }
    data_.add_normal_row(j, range, 1, c, out);
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::ptrdiff_t i = 0; i < n; ++i) sum += in[i] * row[i];
    row_sums_[static_cast<std::size_t>(j)] = sum;
  });
  return std::accumulate(row_sums_.begin(), row_sums_.end(), 0.);
}

void Smoother::precondition(std::span<const double> r, std::span<double> out) const {
  const auto n = static_cast<std::ptrdiff_t>(r.size());
  if (grid_factor_) {
    std::copy(r.begin(), r.end(), out.begin());
    grid_factor_->solve(out);
    return fill_images(level_->space, out);
  }
  const double* inverse = inverse_diagonal_.data();
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) out[static_cast<std::size_t>(i)] = inverse[i] * r[static_cast<std::size_t>(i)];
  fill_images(level_->space, out);
  if (!points_factor_) return;
  data_.values(out, point_values_);
  points_factor_->solve(point_values_);
  for (double& v : point_values_) v = -v;
  std::copy(r.begin(), r.end(), out.begin());
  data_.add_adjoint(point_values_, out);
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) out[static_cast<std::size_t>(i)] *= inverse[i];
  fill_images(level_->space, out);
}

/// Steps of the Chebyshev polynomial of the fourth kind on (0, 1]; one of them is given to the zero at 1 if the data
/// are exact.
std::vector<Smoother::Step> Smoother::chebyshev_steps(int degree) const {
  std::vector<Step> steps;
  for (int i = 0; i < (is_data_aware() ? degree - 1 : degree); ++i) {
    const auto [keep, gain] = chebyshev_step(i);
    steps.push_back({keep, gain});
  }
  if (is_data_aware()) steps.push_back({0., 1.});
  return steps;
}

void Smoother::advance_row(const Step& step, const std::vector<double>& z, std::vector<double>& next, int j,
                           RowRange range, Work& work) const {
  const std::ptrdiff_t n = level_->energy.columns(), at = j * n;
  if (!level_->space.is_periodic()) data_.add_normal_row(j, range, -1, z, work.r);
  level_->energy.row(j, z, next.data() + at);
  const RowUpdate update{lambda_, step.keep, is_data_aware() ? 0 : step.gain, step.old};
  update_row(update, inverse_diagonal_.data() + at, z.data() + at, next.data() + at, work.r.data() + at,
             work.x.data() + at, n);
}

/// Adds gain M^-1 r to z and x.
void Smoother::add_exact(double gain, std::vector<double>& z, std::vector<double>& buffer, Work& work) const {
  precondition(work.r, buffer);
  const auto size = static_cast<std::ptrdiff_t>(z.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double more = gain * buffer[k];
    z[k] += more;
    work.x[k] += more;
  }
}

/// The steps after first(j, z), which makes row j of r, x and z as the first of the steps asks. They share one pass
/// over memory, unless each ends with an exact solution for all rows.
template <typename First>
void Smoother::run(std::span<const Step> steps, First&& first, Work& work) const {
  const int rows = level_->space.y.size(), reach = level_->space.y.degree(), count = static_cast<int>(steps.size());
  const auto row = [&](int step, int j, RowRange range) {
    auto& next = work.z[static_cast<std::size_t>(step % 2)];
    if (step == 0) return first(j, next);
    advance_row(steps[static_cast<std::size_t>(step)], work.z[static_cast<std::size_t>((step + 1) % 2)], next, j, range,
                work);
  };
  if (level_->space.is_periodic()) return run_around(steps, first, work);
  if (!is_data_aware()) return Wavefront(rows, count, reach).run(row);
  for (int step = 0; step < count; ++step) {
    Wavefront(rows, 1, reach).run([&](int, int j, RowRange range) { row(step, j, range); });
    const double gain = steps[static_cast<std::size_t>(step)].gain;
    if (gain != 0)
      add_exact(gain, work.z[static_cast<std::size_t>(step % 2)], work.z[static_cast<std::size_t>((step + 1) % 2)],
                work);
  }
}

/// The same on a periodic space, where the first rows of a step need the last ones of the step before.
template <typename First>
void Smoother::run_around(std::span<const Step> steps, First&& first, Work& work) const {
  for (std::size_t step = 0; step < steps.size(); ++step) {
    const auto& z = work.z[(step + 1) % 2];
    auto& next = work.z[step % 2];
    if (step > 0 && data_.size() > 0) data_.add_normal(-1, z, work.r);
    for_blocks(RowBlocks(level_->energy.rows(), level_->energy.columns()), [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        if (step == 0)
          first(j, next);
        else
          advance_row(steps[step], z, next, j, {begin, end}, work);
      }
    });
    fill_images(level_->space, next);
    if (is_data_aware() && steps[step].gain != 0) add_exact(steps[step].gain, next, work.z[(step + 1) % 2], work);
  }
  fill_images(level_->space, work.x);
}

void Smoother::smooth_first(int degree, std::span<const double> r, Work& work) const {
  auto steps = chebyshev_steps(degree);
  steps.push_back({});  // the residual
  const std::ptrdiff_t n = level_->space.x.size();
  const double gain = is_data_aware() ? 0 : steps.front().gain;
  run(
      steps,
      [&](int j, std::vector<double>& z) {
        const std::ptrdiff_t at = j * n;
        start_row(gain, inverse_diagonal_.data() + at, r.data() + at, work.r.data() + at, z.data() + at,
                  work.x.data() + at, n);
      },
      work);
}

void Smoother::smooth_last(int degree, std::span<const double> coarse, Work& work) const {
  auto steps = chebyshev_steps(degree);
  if (is_data_aware()) std::rotate(steps.begin(), steps.end() - 1, steps.end());
  steps.front().old = 1;                // the correction
  steps.insert(steps.begin(), Step{});  // which is refined first
  const std::ptrdiff_t n = level_->space.x.size();
  run(
      steps, [&](int j, std::vector<double>& z) { level_->refinement->row(j, coarse.data(), z.data() + j * n); }, work);
}

}  // namespace batten
