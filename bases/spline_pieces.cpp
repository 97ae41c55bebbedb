// SPDX-License-Identifier: MIT
#include <batten/bases/spline_pieces.h>

#include <algorithm>

namespace batten {
namespace {

using Polynomial = std::vector<Rational>;

std::vector<Rational> all_knots(std::span<const int> breakpoints, int degree, EndKnots ends) {
  const std::size_t last = breakpoints.size() - 1;
  const bool continued = ends == EndKnots::Continued;
  const int first_step = continued ? breakpoints[1] - breakpoints[0] : 0;
  const int last_step = continued ? breakpoints[last] - breakpoints[last - 1] : 0;
  std::vector<Rational> knots;
  for (int k = degree; k > 0; --k) knots.emplace_back(breakpoints.front() - k * first_step);
  for (int b : breakpoints) knots.emplace_back(b);
  for (int k = 1; k <= degree; ++k) knots.emplace_back(breakpoints.back() + k * last_step);
  return knots;
}

/// p(u) * (a + b u)
Polynomial times_linear(const Polynomial& p, const Rational& a, const Rational& b) {
  Polynomial product(p.size() + 1);
  for (std::size_t k = 0; k < p.size(); ++k) {
    product[k] += a * p[k];
    product[k + 1] += b * p[k];
  }
  return product;
}

void add_to(Polynomial& sum, const Polynomial& p) {
  if (sum.size() < p.size()) sum.resize(p.size());
  for (std::size_t k = 0; k < p.size(); ++k) sum[k] += p[k];
}

Polynomial derivative(Polynomial p, int order, const Rational& length) {
  for (; order > 0; --order) {
    for (std::size_t k = 1; k < p.size(); ++k) p[k - 1] = p[k] * static_cast<long>(k) / length;
    p.back() = 0;
  }
  return p;
}

/// ∫_0^1 p(u) q(u) du
Rational inner_product(const Polynomial& p, const Polynomial& q) {
  Rational sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j)
      if (p[i] != 0 && q[j] != 0) sum += p[i] * q[j] / static_cast<long>(i + j + 1);
  return sum;
}

SplinePiece piece_of_cell(const std::vector<Rational>& t, std::size_t cell, std::size_t degree) {
  const std::size_t k = cell + degree;  // the cell is [t_k, t_{k+1}]
  const Rational length = t[k + 1] - t[k];
  std::vector<Polynomial> lower = {{Rational(1)}};  // degree p-1: functions k-p+1 .. k
  for (std::size_t p = 1; p <= degree; ++p) {
    std::vector<Polynomial> next(p + 1);
    for (std::size_t a = 0; a < p; ++a) {
      const std::size_t i = k - p + 1 + a;  // N_{i,p-1} feeds N_{i-1,p} and N_{i,p}
      const Rational span = t[i + p] - t[i];
      add_to(next[a], times_linear(lower[a], (t[i + p] - t[k]) / span, -length / span));
      add_to(next[a + 1], times_linear(lower[a], (t[k] - t[i]) / span, length / span));
    }
    lower = std::move(next);
  }
  return {length, std::move(lower), false};
}

/// Are the knots that the piece of a cell depends on, t[cell + 1] .. t[cell + 2 degree], those of the cell before,
/// moved?
bool repeats_the_cell_before(const std::vector<Rational>& t, std::size_t cell, std::size_t degree) {
  if (cell == 0) return false;
  for (std::size_t k = cell + std::min<std::size_t>(degree, 1); k < cell + std::max<std::size_t>(2 * degree, 1); ++k)
    if (t[k + 1] - t[k] != t[k] - t[k - 1]) return false;
  return true;
}

/// [a][b]: ∫ N_a^(r) N_b^(s) dt over the cell of a piece.
std::vector<std::vector<Rational>> products_of_piece(const SplinePiece& piece, int r, int s) {
  std::vector<Polynomial> left, right;
  for (const Polynomial& p : piece.coefficients) {
    left.push_back(derivative(p, r, piece.length));
    right.push_back(derivative(p, s, piece.length));
  }
  std::vector<std::vector<Rational>> products;
  for (const Polynomial& p : left) {
    auto& row = products.emplace_back();
    for (const Polynomial& q : right) row.push_back(piece.length * inner_product(p, q));
  }
  return products;
}

}  // namespace

std::vector<SplinePiece> spline_pieces(std::span<const int> breakpoints, int degree, EndKnots ends) {
  const auto knots = all_knots(breakpoints, degree, ends);
  std::vector<SplinePiece> pieces;
  for (std::size_t cell = 0; cell + 1 < breakpoints.size(); ++cell) {
    const bool repeats = repeats_the_cell_before(knots, cell, static_cast<std::size_t>(degree));
    pieces.push_back(repeats ? pieces.back() : piece_of_cell(knots, cell, static_cast<std::size_t>(degree)));
    pieces.back().repeats = repeats;
  }
  return pieces;
}

std::vector<std::vector<Rational>> exact_inner_products(std::span<const int> breakpoints, int degree, int r, int s,
                                                        EndKnots ends) {
  const auto pieces = spline_pieces(breakpoints, degree, ends);
  const auto d = static_cast<std::size_t>(degree);
  std::vector<std::vector<Rational>> products(pieces.size() + d, std::vector<Rational>(2 * d + 1));
  std::vector<std::vector<Rational>> of_piece;
  for (std::size_t cell = 0; cell < pieces.size(); ++cell) {
    if (!pieces[cell].repeats) of_piece = products_of_piece(pieces[cell], r, s);
    for (std::size_t a = 0; a <= d; ++a)
      for (std::size_t b = 0; b <= d; ++b) products[cell + a][b + d - a] += of_piece[a][b];
  }
  return products;
}

std::vector<RefinementColumn> exact_refinement(std::span<const int> coarse, std::span<const int> fine, int degree) {
  const auto t = all_knots(coarse, degree, EndKnots::Repeated), tau = all_knots(fine, degree, EndKnots::Repeated);
  const std::size_t d = static_cast<std::size_t>(degree);
  const std::size_t coarse_size = coarse.size() - 1 + d, fine_size = fine.size() - 1 + d;
  std::vector<RefinementColumn> columns(coarse_size);
  for (std::size_t i = 0; i < fine_size; ++i) {
    // α_j of the coarse functions k-p .. k that see the fine knot τ_i, raised from degree 0 to d
    const auto above = std::upper_bound(t.begin(), t.end() - degree - 1, tau[i]);
    const std::size_t k = static_cast<std::size_t>(above - t.begin()) - 1;
    std::vector<Rational> alpha = {Rational(1)};
    for (std::size_t p = 1; p <= d; ++p) {
      std::vector<Rational> next(p + 1);
      for (std::size_t a = 0; a < p; ++a) {
        const std::size_t j = k - p + 1 + a;
        const Rational span = t[j + p] - t[j];
        next[a] += (t[j + p] - tau[i + p]) / span * alpha[a];
        next[a + 1] += (tau[i + p] - t[j]) / span * alpha[a];
      }
      alpha = std::move(next);
    }
    for (std::size_t a = 0; a <= d; ++a) {
      if (alpha[a] == 0) continue;
      auto& column = columns[k - d + a];
      if (column.weights.empty()) column.first = static_cast<int>(i);
      column.weights.resize(i - static_cast<std::size_t>(column.first) + 1);
      column.weights.back() = alpha[a];
    }
  }
  return columns;
}

}  // namespace batten
