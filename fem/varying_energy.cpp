// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/cell_quadrature.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/varying_energy.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

namespace batten {
namespace {

constexpr int most_functions = SplineBasis::max_degree + 1;

using Orders = VaryingTerm::Orders;

/// A value that a coefficient may not have, and where.
struct BadValue {
  std::size_t term = 0;
  double value = 0, x = 0, y = 0;
};

/// Assembles one row of cells after the other.
class Assembly {
public:
  Assembly(const std::vector<VaryingTerm>& terms, const SplineBasis& x, const SplineBasis& y, SymmetricStencil& result)
      : terms_(terms),
        x_(x, x.degree() + 1),
        y_(y, y.degree() + 1),
        n_(x.degree() + 1),
        result_(result),
        row_sums_(static_cast<std::size_t>(x.size()) * static_cast<std::size_t>(y.size())) {}

  /// Adds the cells of one row. A coefficient's value that is out of range is noted.
  void add_row(int cy) {
    const auto points = static_cast<std::size_t>(x_.cells() * x_.points());
    std::vector<double> coefficient(terms_.size() * points);
    std::vector<double> local(static_cast<std::size_t>(x_.cells() * n_ * n_ * n_ * n_));
    for (int qy = 0; qy < y_.points(); ++qy) {
      evaluate(cy, qy, coefficient);
      for (std::size_t t = 0; t < terms_.size(); ++t)
        for (int cx = 0; cx < x_.cells(); ++cx) {
          const double* here = coefficient.data() + t * points + static_cast<std::size_t>(cx * x_.points());
          add_cell(terms_[t], cx, cy, qy, here, local.data() + static_cast<std::size_t>(cx * n_ * n_ * n_ * n_));
          if (terms_[t].right.x == 0 && terms_[t].right.y == 0) add_row_sums(terms_[t], cx, cy, qy, here);
        }
    }
    for (int cx = 0; cx < x_.cells(); ++cx)
      scatter(cx, cy, local.data() + static_cast<std::size_t>(cx * n_ * n_ * n_ * n_));
  }

  const std::optional<BadValue>& bad_value() const { return bad_; }
  /// Row sums of the matrix, Σ_k a(N_i, N_k) = a(N_i, 1).
  std::vector<double> row_sums() && { return std::move(row_sums_); }

private:
  /// Coefficients times the weights of the points.
  void evaluate(int cy, int qy, std::vector<double>& coefficient) {
    const double y = y_.place(cy, qy), wy = y_.weight(cy, qy);
    std::size_t k = 0;
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      const bool same = t > 0 && terms_[t].name == terms_[t - 1].name;
      for (int cx = 0; cx < x_.cells(); ++cx)
        for (int qx = 0; qx < x_.points(); ++qx, ++k) {
          if (same) {
            coefficient[k] = coefficient[k - static_cast<std::size_t>(x_.cells() * x_.points())];
            continue;
          }
          const double x = x_.place(cx, qx), value = terms_[t].coefficient(x, y);
          if (!std::isfinite(value) || value < 0 || (value == 0 && !terms_[t].may_vanish)) note({t, value, x, y});
          coefficient[k] = value * wy * x_.weight(cx, qx);
        }
    }
  }

  void note(const BadValue& bad) {
    const std::lock_guard lock(mutex_);
    if (!bad_ || std::pair(bad.y, bad.x) < std::pair(bad_->y, bad_->x)) bad_ = bad;
  }

  /// local[b][f][a][e] += factor κ N_a^(left) N_b^(left) N_e^(right) N_f^(right) for the Gauss points of one line.
  void add_cell(const VaryingTerm& term, int cx, int cy, int qy, const double* coefficient, double* local) const {
    double across[most_functions * most_functions] = {};
    for (int qx = 0; qx < x_.points(); ++qx) {
      const double* left = x_.values(cx, qx, term.left.x);
      const double* right = x_.values(cx, qx, term.right.x);
      for (int a = 0; a < n_; ++a) {
        const double v = term.factor * coefficient[qx] * left[a];
        for (int e = 0; e < n_; ++e) across[a * n_ + e] += v * right[e];
      }
    }
    const double* left = y_.values(cy, qy, term.left.y);
    const double* right = y_.values(cy, qy, term.right.y);
    for (int b = 0; b < n_; ++b)
      for (int f = b; f < n_; ++f) {
        const double v = left[b] * right[f];
        double* out = local + (b * n_ + f) * n_ * n_;
        for (int k = 0; k < n_ * n_; ++k) out[k] += v * across[k];
      }
  }

  /// factor κ N_i^(left) for the Gauss points of one line: derivatives on the right vanish for p = 1.
  void add_row_sums(const VaryingTerm& term, int cx, int cy, int qy, const double* coefficient) {
    const double* left_y = y_.values(cy, qy, term.left.y);
    for (int qx = 0; qx < x_.points(); ++qx) {
      const double* left_x = x_.values(cx, qx, term.left.x);
      for (int b = 0; b < n_; ++b)
        for (int a = 0; a < n_; ++a)
          row_sums_[static_cast<std::size_t>(cy + b) * static_cast<std::size_t>(result_.columns()) +
                    static_cast<std::size_t>(cx + a)] += term.factor * coefficient[qx] * left_x[a] * left_y[b];
    }
  }

  void scatter(int cx, int cy, const double* local) {
    for (int b = 0; b < n_; ++b)
      for (int f = b; f < n_; ++f)
        for (int a = 0; a < n_; ++a)
          for (int e = f == b ? a : 0; e < n_; ++e)
            result_.entries(cy + b, e - a, f - b)[static_cast<std::size_t>(cx + a)] +=
                local[((b * n_ + f) * n_ + a) * n_ + e];
  }

  const std::vector<VaryingTerm>& terms_;
  CellQuadrature x_, y_;
  int n_;
  SymmetricStencil& result_;
  std::vector<double> row_sums_;
  std::mutex mutex_;
  std::optional<BadValue> bad_;
};

/// (∂^left p)(∂^right p) and its mirror image, half each, so that the sum is symmetric.
void add_product(std::vector<VaryingTerm>& terms, VaryingTerm term) {
  terms.push_back(term);
  if (term.left.x == term.right.x && term.left.y == term.right.y) return;
  terms.back().factor /= 2;
  std::swap(term.left, term.right);
  term.factor /= 2;
  terms.push_back(std::move(term));
}

}  // namespace

std::vector<VaryingTerm> energy_terms(const BoundaryProblem& problem) {
  std::vector<VaryingTerm> terms;
  const auto add = [&](const Field& field, const char* name, bool may_vanish, double factor, Orders left,
                       Orders right) {
    if (may_vanish && field.is_zero()) return;
    add_product(terms, {field, factor, left, right, name, may_vanish});
  };
  const Orders none{0, 0}, x{1, 0}, y{0, 1}, xx{2, 0}, xy{1, 1}, yy{0, 2};
  if (const auto* conduction = std::get_if<Conduction>(&problem.material)) {
    add(conduction->k, "k", false, 1, x, x);
    add(conduction->k, "k", false, 1, y, y);
    add(conduction->c, "c", true, 1, none, none);
    return terms;
  }
  const auto& plate = std::get<KirchhoffPlate>(problem.material);
  const double nu = plate.poisson_ratio;
  add(plate.rigidity, "D", false, 1, xx, xx);
  add(plate.rigidity, "D", false, 1, yy, yy);
  add(plate.rigidity, "D", false, 2 * (1 - nu), xy, xy);
  if (nu != 0) add(plate.rigidity, "D", false, 2 * nu, xx, yy);
  add(plate.tension, "tension", true, 1, x, x);
  add(plate.tension, "tension", true, 1, y, y);
  add(plate.foundation, "foundation", true, 1, none, none);
  return terms;
}

SymmetricStencil varying_stencil(const std::vector<VaryingTerm>& terms, const Rectangle& region, int degree) {
  const SplineBasis x(region.x, degree), y(region.y, degree);
  SymmetricStencil result(y.size(), x.size(), degree);
  Assembly assembly(terms, x, y, result);
  for_alternating_blocks(RowBlocks(region.y.cells(), x.size() * 16, std::max(4, degree)), [&](int begin, int end) {
    for (int cy = begin; cy < end; ++cy) assembly.add_row(cy);
  });
  if (const auto& bad = assembly.bad_value())
    throw InvalidInput("varying_stencil: expected " + terms[bad->term].name +
                       (terms[bad->term].may_vanish ? " >= 0" : " > 0") + " everywhere, found " +
                       number_text(bad->value, 6) + " at (" + number_text(bad->x, 6) + ", " + number_text(bad->y, 6) +
                       ")");
  result.set_row_sums(std::move(assembly).row_sums());
  return result;
}

}  // namespace batten
