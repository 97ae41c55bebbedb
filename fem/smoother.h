// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/repeated_rows.h>
#include <batten/fem/data_term.h>
#include <batten/fem/hierarchy.h>
#include <batten/fem/sparse_cholesky.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace batten {

/// Chebyshev smoothing of A = λ E + Σ_i w_i b_i b_i^T on one level.
///
/// The polynomials are those of the fourth kind, which need an upper bound of the spectrum only [Lottes 2022]; the
/// matrix M behind them satisfies M >= A, so that bound is 1. Two choices of M:
///
///   plain       M = D + diag(B^T w), D = λ bound diag(E); the data part is lumped (of slopes: DataTerm::lumped), which
///   suffices while it is not much stiffer. data-aware  M = D + B^T W B, inverted exactly by M^-1 = D^-1 - D^-1 B^T
///   K^-1 B D^-1 with the sparse matrix
///               K = W^-1 + B D^-1 B^T of the points; its polynomial has a zero at 1, so that what the data see is
///               removed at once and the rest is smoothed among functions that vanish at the points. Robust for λ -> 0.
///               Where points outnumber coefficients M itself is factored.
class Smoother {
public:
  enum class Kind { Plain, DataAware };

  /// `stored` asks for the stencil form of the data term. On a periodic space right-hand sides hold nothing at images,
  /// solutions their originals' values.
  Smoother(const Hierarchy::Level& level, const GridPoints& points, bool stored = false);

  /// Sets λ and the weights of the points. Throws SolverError if K cannot be factored.
  void set(double lambda, const PairWeights& weights, Kind kind);
  /// The same λ and weights as the finer level, plain; the stencil of the data comes from the finer one.
  void set_from_finer(const Smoother& finer);

  const Hierarchy::Level& level() const { return *level_; }
  const DataTerm& data() const { return data_; }
  double lambda() const { return lambda_; }
  std::size_t size() const { return level_->space.size(); }

  /// How much the points give way when D alone resists (DataTerm::compliance of D^-1), in the order of the points.
  std::vector<double> compliance() const;

  /// The largest diagonal entry of λ E times the number of coefficients: the energy against the data.
  double stiffness() const;

  /// The largest part of the diagonal of a plain M that is the data's, lumped.
  double data_share() const;

  /// out = A c. Returns c · A c.
  double apply(std::span<const double> c, std::span<double> out) const;

  /// Buffers of one level, each of size(). Each step of the smoothing reads one z and writes the other.
  struct Work {
    std::vector<double> x, r;
    std::array<std::vector<double>, 2> z;
    explicit Work(std::size_t size) : x(size), r(size), z{std::vector<double>(size), std::vector<double>(size)} {}
  };
  /// x = p(A) r and work.r = r - A x: smoothing from zero. `degree` applications of A. r may be work.r.
  void smooth_first(int degree, std::span<const double> r, Work& work) const;
  /// Adds the correction of the coarser level to x, then smooths. `degree` applications of A; r is left unfinished.
  void smooth_last(int degree, std::span<const double> coarse, Work& work) const;

private:
  /// r -= A z; z <- keep z + gain M^-1 r; x += old z + new z
  struct Step {
    double keep = 0, gain = 0, old = 0;
  };
  bool is_data_aware() const { return points_factor_ || grid_factor_; }
  std::vector<Step> chebyshev_steps(int degree) const;
  template <typename First>
  void run(std::span<const Step> steps, First&& first, Work& work) const;
  template <typename First>
  void run_around(std::span<const Step> steps, First&& first, Work& work) const;
  void advance_row(const Step& step, const std::vector<double>& z, std::vector<double>& next, int j, RowRange range,
                   Work& work) const;
  void add_exact(double gain, std::vector<double>& z, std::vector<double>& buffer, Work& work) const;
  void precondition(std::span<const double> r, std::span<double> out) const;
  void set_diagonal(Kind kind);
  template <typename Visit>
  void for_energy_diagonal(Visit&& visit) const;
  void factor_points();
  void factor_points_around();
  void factor_grid();

  const Hierarchy::Level* level_;
  DataTerm data_;
  double lambda_ = 1;
  RepeatedRows energy_diagonal_;                 // diag(E)
  std::vector<double> inverse_diagonal_;         // of D, or of D + diag(B^T w)
  std::optional<SparseCholesky> points_factor_;  // of K
  std::optional<SparseCholesky> grid_factor_;    // of M, where points outnumber coefficients
  mutable std::vector<double> point_values_;     // buffer of `precondition`
  mutable std::vector<double> row_sums_;         // buffer of `apply`
};

}  // namespace batten
