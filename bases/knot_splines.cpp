// SPDX-License-Identifier: MIT
#include <batten/bases/knot_splines.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace batten {
namespace {

// Gauss's rule of four points on [-1, 1], exact to degree 7.
constexpr int gauss_points = 4;
constexpr std::array<double, gauss_points> gauss_place = {-0.86113631159405257522, -0.33998104358485626480,
                                                          0.33998104358485626480, 0.86113631159405257522};
constexpr std::array<double, gauss_points> gauss_weight = {0.34785484513745385737, 0.65214515486254614263,
                                                           0.65214515486254614263, 0.34785484513745385737};

}  // namespace

KnotSplines::KnotSplines(Breakpoints breakpoints, int degree, Ends ends)
    : breakpoints_(std::move(breakpoints)), degree_(degree), ends_(ends) {
  if (degree < 0 || degree > max_degree)
    throw InvalidInput("KnotSplines: expected a degree from 0 to 3, found " + std::to_string(degree));
}

/// Knot `to` minus breakpoint `from`; knots are numbered like breakpoints, those beyond the ends with negative numbers
/// and numbers above cells().
double KnotSplines::distance(int from, int to) const {
  const auto t = breakpoints_.positions();
  const int n = cells();
  const double start = t[static_cast<std::size_t>(from)];
  double beyond = 0;
  if (ends_ == Ends::Extended && to < 0) beyond = to * breakpoints_.width(0);
  if (ends_ == Ends::Extended && to > n) beyond = (to - n) * breakpoints_.width(n - 1);
  return t[static_cast<std::size_t>(std::clamp(to, 0, n))] - start + beyond;
}

/// Weights of the coefficients cell .. cell + q in the blossom value of the cell's piece of degree q = number of
/// arguments; arguments are distances from the left end of the cell.
KnotSplines::Local KnotSplines::blossom(int cell, std::span<const double> arguments) const {
  const int q = static_cast<int>(arguments.size());
  Local n = Local::Zero(q + 1);
  n[0] = 1;
  for (int j = 1; j <= q; ++j) {
    const double u = arguments[static_cast<std::size_t>(j - 1)];
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const double right = distance(cell, cell + 1 + r), left = distance(cell, cell + 1 + r - j);
      const double share = n[r] / (right - left);
      n[r] = saved + (right - u) * share;
      saved = (u - left) * share;
    }
    n[j] = saved;
  }
  return n;
}

/// Of the functions of degree q on the same knots that do not vanish in the cell.
KnotSplines::Local KnotSplines::derivative(int cell, int q, double u, int order) const {
  if (order == 0) {
    const std::array<double, max_degree> arguments = {u, u, u};
    return blossom(cell, std::span(arguments).first(static_cast<std::size_t>(q)));
  }
  Local result = Local::Zero(q + 1);
  if (q == 0) return result;
  const Local lower = derivative(cell, q - 1, u, order - 1);
  for (int k = 0; k < q; ++k) {
    const double slope = q * lower[k] / (distance(cell, cell + k + 1) - distance(cell, cell + k + 1 - q));
    result[k] -= slope;
    result[k + 1] += slope;
  }
  return result;
}

KnotSplines::Local KnotSplines::at(int cell, double u, int order) const { return derivative(cell, degree_, u, order); }

KnotSplines::LocalMatrix KnotSplines::cell_products(int cell, int r) const {
  LocalMatrix result = LocalMatrix::Zero(degree_ + 1, degree_ + 1);
  const double half = breakpoints_.width(cell) / 2;
  for (std::size_t g = 0; g < gauss_points; ++g) {
    const Local n = at(cell, half * (1 + gauss_place[g]), r);
    result += half * gauss_weight[g] * n * n.transpose();
  }
  return result;
}

KnotSplines::Local KnotSplines::cell_moments(int cell, int a) const {
  Local result = Local::Zero(degree_ + 1);
  const auto t = breakpoints_.positions();
  const double half = breakpoints_.width(cell) / 2;
  for (std::size_t g = 0; g < gauss_points; ++g) {
    const double u = half * (1 + gauss_place[g]);
    const double s = 2 * (t[static_cast<std::size_t>(cell)] + u) / t.back() - 1;
    result += half * gauss_weight[g] * std::pow(s, a) * at(cell, u);
  }
  return result;
}

std::vector<double> KnotSplines::greville() const {
  std::vector<double> result(static_cast<std::size_t>(size()));
  for (int i = 0; i < size(); ++i) {
    double sum = 0;
    for (int k = 1; k <= degree_; ++k) sum += distance(0, i - degree_ + k);
    const double middle = (distance(0, i) + distance(0, i + 1)) / 2;
    result[static_cast<std::size_t>(i)] = degree_ == 0 ? middle : sum / degree_;
  }
  return result;
}

/// The blossom of s^a at the knots of a function: the mean of all products of a of them.
Eigen::VectorXd KnotSplines::monomial(int a) const {
  Eigen::VectorXd result(size());
  const double length = breakpoints_.positions().back();
  for (int i = 0; i < size(); ++i) {
    std::array<double, max_degree + 1> symmetric = {1, 0, 0, 0};
    for (int k = 1; k <= degree_; ++k) {
      const double s = 2 * distance(0, i - degree_ + k) / length - 1;
      for (std::size_t e = static_cast<std::size_t>(k); e > 0; --e) symmetric[e] += s * symmetric[e - 1];
    }
    double count = 1;
    for (int k = 0; k < a; ++k) count *= static_cast<double>(degree_ - k) / (k + 1);
    result[i] = symmetric[static_cast<std::size_t>(a)] / count;
  }
  return result;
}

Eigen::SparseMatrix<double> KnotSplines::refinement(const KnotSplines& finer) const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto& fine = finer.breakpoints_;
  for (int i = 0; i < finer.size(); ++i) {
    const int cell = std::clamp(i - degree_ / 2, std::max(0, i - degree_), std::min(i, finer.cells() - 1));
    const int coarse = fine.parent(cell);
    std::array<double, max_degree> arguments{};
    for (int k = 1; k <= degree_; ++k)
      arguments[static_cast<std::size_t>(k - 1)] = finer.distance(fine.first_child(coarse), i - degree_ + k);
    const Local row = blossom(coarse, std::span(arguments).first(static_cast<std::size_t>(degree_)));
    for (int a = 0; a <= degree_; ++a)
      if (row[a] != 0) entries.emplace_back(i, coarse + a, row[a]);
  }
  Eigen::SparseMatrix<double> result(finer.size(), size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

int KnotSplines::cell_of(double t) const {
  const auto all = breakpoints_.positions();
  const auto above = std::upper_bound(all.begin(), all.end(), t);
  return std::clamp(static_cast<int>(above - all.begin()) - 1, 0, cells() - 1);
}

}  // namespace batten
