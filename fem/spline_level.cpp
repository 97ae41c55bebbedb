// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/spline_level.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace batten {
namespace {

constexpr int orders = 4;  // derivatives of order 0 to 3

using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::SparseMatrix<double> assembled(int rows, int columns, const Triplets& entries) {
  Eigen::SparseMatrix<double> result(rows, columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::vector<Energy::Term> terms_that_count(const VariationalDomain& domain) {
  if (domain.energy.curvature() != 0)
    throw InvalidInput("SplineLevel: expected an energy without Gaussian curvature, found the weight " +
                       std::to_string(domain.energy.curvature()));
  std::vector<Energy::Term> terms;
  std::array<bool, 2> pure = {false, !domain.y};
  for (const auto& t : domain.energy.terms()) {
    if (!domain.y && t.y_order > 0) continue;
    if (std::max(t.x_order, t.y_order) > domain.degree)
      throw InvalidInput("SplineLevel: expected a degree of at least the order of every derivative, found degree " +
                         std::to_string(domain.degree) + " and a derivative of order " +
                         std::to_string(std::max(t.x_order, t.y_order)));
    pure[0] = pure[0] || t.y_order == 0;
    pure[1] = pure[1] || t.x_order == 0;
    terms.push_back(t);
  }
  if (!pure[0] || !pure[1])
    throw InvalidInput(std::string("SplineLevel: expected an energy with a pure derivative in each direction, found "
                                   "none in ") +
                       (pure[0] ? "y" : "x"));
  return terms;
}

std::vector<SplineLevel::Monomial> annihilated(const std::vector<Energy::Term>& terms, bool interval) {
  std::vector<SplineLevel::Monomial> result;
  for (int b = 0; b < (interval ? 1 : 3); ++b)
    for (int a = 0; a < 3; ++a)
      if (std::all_of(terms.begin(), terms.end(), [&](const auto& t) { return a < t.x_order || b < t.y_order; }))
        result.push_back({a, b});
  return result;
}

void check_cells(const VariationalDomain& domain) {
  const auto cells = static_cast<std::size_t>(domain.x.cells()) * static_cast<std::size_t>(domain.rows());
  const auto expect_count = [&](const std::string& what, std::size_t found) {
    if (found != 0 && found != cells)
      throw InvalidInput("SplineLevel: expected one " + what + " for each of " + std::to_string(cells) +
                         " cells, found " + std::to_string(found));
  };
  expect_count("coefficient", domain.coefficient.size());
  expect_count("mark of the mask", domain.inside.size());
  for (std::size_t c = 0; c < domain.coefficient.size(); ++c)
    if (!std::isfinite(domain.coefficient[c]) || domain.coefficient[c] <= 0)
      throw InvalidInput("SplineLevel: expected finite positive coefficients, found " +
                         std::to_string(domain.coefficient[c]) + " in cell " + std::to_string(c));
}

/// The number of cells that hang together through sides with the first cell inside.
std::size_t connected_cells(const std::vector<char>& inside, int nx) {
  std::vector<char> open = inside;
  std::vector<std::size_t> front;
  const auto width = static_cast<std::size_t>(nx);
  const auto visit = [&](std::size_t c) {
    if (open[c]) front.push_back(c);
    open[c] = 0;
  };
  visit(static_cast<std::size_t>(std::find(inside.begin(), inside.end(), 1) - inside.begin()));
  std::size_t count = 0;
  for (; !front.empty(); ++count) {
    const std::size_t c = front.back();
    front.pop_back();
    if (c % width > 0) visit(c - 1);
    if (c % width + 1 < width) visit(c + 1);
    if (c >= width) visit(c - width);
    if (c + width < inside.size()) visit(c + width);
  }
  return count;
}

void check_mask(const std::vector<char>& inside, int nx) {
  if (inside.empty()) return;
  const auto count = static_cast<std::size_t>(std::count_if(inside.begin(), inside.end(), [](char c) { return c; }));
  if (count == 0) throw InvalidInput("SplineLevel: expected at least one cell inside, found none");
  const std::size_t connected = connected_cells(inside, nx);
  if (connected < count)
    throw InvalidInput("SplineLevel: expected cells that are connected through sides, found " + std::to_string(count) +
                       " cells of which " + std::to_string(connected) + " are connected");
}

void check_triangles(const VariationalDomain& domain) {
  const auto even = [](const Breakpoints& b) { return b.is_uniform() && b.cells() % 2 == 0; };
  const auto& terms = domain.energy.terms();
  const bool first = std::all_of(terms.begin(), terms.end(), [](auto& t) { return t.x_order + t.y_order == 1; });
  if (domain.degree != 1 || !first || !domain.y || !even(domain.x) || !even(*domain.y) || !domain.inside.empty() ||
      !domain.coefficient.empty())
    throw InvalidInput(
        "SplineLevel: expected degree 1, first derivatives and a rectangle of an even number of equal cells without "
        "coefficient and mask for triangles, found degree " +
        std::to_string(domain.degree) + " on " + std::to_string(domain.x.cells()) + " x " +
        std::to_string(domain.rows()) + " cells");
}

/// Of two directions, the refinement of hats on triangles: as of products, but the middle of a coarse cell has the mean
/// of the two corners (0, 0) and (1, 1) alone, on the side that cuts the cell.
void cut_along_diagonal(Triplets& entries, int fine_columns, int coarse_columns) {
  std::erase_if(entries, [&](const auto& e) {
    const int i = e.row() % fine_columns, j = e.row() / fine_columns;
    const int a = i - 2 * (e.col() % coarse_columns), b = j - 2 * (e.col() / coarse_columns);
    return a * b == -1;
  });
  for (auto& e : entries)
    if (e.value() == 0.25) e = {e.row(), e.col(), 0.5};
}

/// The coefficients of the degree + 1 functions of a coarse cell for those of a fine one.
KnotSplines::LocalMatrix local_refinement(const Eigen::SparseMatrix<double>& r, int fine, int coarse, int degree) {
  KnotSplines::LocalMatrix result(degree + 1, degree + 1);
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; b <= degree; ++b) result(a, b) = r.coeff(fine + a, coarse + b);
  return result;
}

/// Y ⊗ X, x fastest.
SplineLevel::Element kronecker(const KnotSplines::LocalMatrix& y, const KnotSplines::LocalMatrix& x) {
  SplineLevel::Element result(y.rows() * x.rows(), y.cols() * x.cols());
  for (Eigen::Index i = 0; i < y.rows(); ++i)
    for (Eigen::Index j = 0; j < y.cols(); ++j)
      result.block(i * x.rows(), j * x.cols(), x.rows(), x.cols()) = y(i, j) * x;
  return result;
}

std::vector<KnotSplines::LocalMatrix> tabulate_products(const KnotSplines& basis) {
  std::vector<KnotSplines::LocalMatrix> result;
  const double unit = basis.breakpoints().unit();
  for (int c = 0; c < basis.cells(); ++c)
    for (int r = 0; r < orders; ++r) result.push_back(std::pow(unit, 1 - 2 * r) * basis.cell_products(c, r));
  return result;
}

}  // namespace

SplineLevel::SplineLevel(const VariationalDomain& domain)
    : x_(domain.x, domain.degree, domain.ends),
      y_(domain.y ? KnotSplines(*domain.y, domain.degree, domain.ends) : KnotSplines(Breakpoints::uniform(0, 1, 1), 0)),
      interval_(!domain.y) {
  if (domain.degree < 1)
    throw InvalidInput("SplineLevel: expected a degree from 1 to 3, found " + std::to_string(domain.degree));
  terms_ = terms_that_count(domain);
  monomials_ = annihilated(terms_, interval_);
  check_cells(domain);
  coefficient_ = domain.coefficient;
  for (char c : domain.inside) inside_.push_back(c != 0);
  check_mask(inside_, x_.cells());
  if (domain.triangles) check_triangles(domain);
  triangles_ = domain.triangles;
  number_functions();
  tabulate();
}

bool SplineLevel::can_coarsen() const {
  return x_.breakpoints().can_coarsen() && (interval_ || y_.breakpoints().can_coarsen());
}

SplineLevel SplineLevel::coarser() const {
  if (!can_coarsen())
    throw InvalidInput("SplineLevel::coarser: expected at least 2 cells in each direction, found " +
                       std::to_string(x_.cells()) + " x " + std::to_string(y_.cells()));
  SplineLevel result(x_.coarser(), interval_ ? y_ : y_.coarser());
  result.interval_ = interval_;
  result.triangles_ = triangles_;
  result.terms_ = terms_;
  result.monomials_ = monomials_;
  result.take_elements(*this);
  result.number_functions();
  result.tabulate();
  return result;
}

void SplineLevel::number_functions() {
  const int nx = x_.size(), ny = y_.size();
  number_.assign(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), inside_.empty() ? 0 : -1);
  if (!inside_.empty())
    for (int cy = 0; cy < y_.cells(); ++cy)
      for (int cx = 0; cx < x_.cells(); ++cx)
        for (int a = 0; is_inside(cx, cy) && a < local_size(); ++a)
          number_[static_cast<std::size_t>(cx + a % (x_.degree() + 1) + (cy + a / (x_.degree() + 1)) * nx)] = 0;
  for (std::size_t g = 0; g < number_.size(); ++g) {
    if (number_[g] < 0) continue;
    number_[g] = size();
    grid_.push_back(static_cast<int>(g));
  }
}

void SplineLevel::tabulate() {
  x_products_ = tabulate_products(x_);
  y_products_ = tabulate_products(y_);
}

/// e_C = Σ_c L_c^T e_c L_c.
void SplineLevel::take_elements(const SplineLevel& finer) {
  if (finer.coefficient_.empty() && finer.inside_.empty() && finer.element_.empty()) return;
  const auto rx = x_.refinement(finer.x_);
  const auto ry = interval_ ? Eigen::SparseMatrix<double>() : y_.refinement(finer.y_);
  const auto n = static_cast<std::size_t>(local_size());
  const std::size_t cells = static_cast<std::size_t>(x_.cells()) * static_cast<std::size_t>(y_.cells());
  element_.assign(cells * n * n, 0);
  if (!finer.inside_.empty()) inside_.assign(cells, 0);
  std::vector<KnotSplines::LocalMatrix> lx, ly;
  const auto px = [&](int c) { return finer.x_.breakpoints().parent(c); };
  const auto py = [&](int c) { return interval_ ? c : finer.y_.breakpoints().parent(c); };
  for (int c = 0; c < finer.x_.cells(); ++c) lx.push_back(local_refinement(rx, c, px(c), x_.degree()));
  for (int c = 0; c < finer.y_.cells(); ++c)
    ly.push_back(interval_ ? KnotSplines::LocalMatrix::Ones(1, 1) : local_refinement(ry, c, py(c), y_.degree()));
  for (int cy = 0; cy < finer.y_.cells(); ++cy)
    for (int cx = 0; cx < finer.x_.cells(); ++cx) {
      if (!finer.is_inside(cx, cy)) continue;
      const std::size_t C = cell(px(cx), py(cy));
      if (!inside_.empty()) inside_[C] = 1;
      const Element L = kronecker(ly[static_cast<std::size_t>(cy)], lx[static_cast<std::size_t>(cx)]);
      Eigen::Map<Eigen::MatrixXd>(element_.data() + C * n * n, local_size(), local_size()) +=
          L.transpose() * finer.element(cx, cy) * L;
    }
}

bool SplineLevel::is_inside(int cx, int cy) const { return inside_.empty() || inside_[cell(cx, cy)]; }

SplineLevel::Element SplineLevel::element(int cx, int cy) const {
  if (!is_inside(cx, cy)) return Element::Zero(local_size(), local_size());
  if (!element_.empty()) {
    const std::size_t n = static_cast<std::size_t>(local_size());
    return Eigen::Map<const Eigen::MatrixXd>(element_.data() + cell(cx, cy) * n * n, local_size(), local_size());
  }
  if (triangles_) return triangle_element(cx, cy);
  Element result = Element::Zero(local_size(), local_size());
  const double kappa = coefficient_.empty() ? 1 : coefficient_[cell(cx, cy)];
  for (const auto& t : terms_)
    result += kappa * t.weight *
              kronecker(y_products_[static_cast<std::size_t>(cy * orders + t.y_order)],
                        x_products_[static_cast<std::size_t>(cx * orders + t.x_order)]);
  return result;
}

/// On each of the two triangles ∂_x is the slope of its one side along x: half of the cell for each such side.
SplineLevel::Element SplineLevel::triangle_element(int cx, int cy) const {
  const double hx = x_.breakpoints().unit() * x_.breakpoints().width(cx);
  const double hy = y_.breakpoints().unit() * y_.breakpoints().width(cy);
  Element result = Element::Zero(4, 4);
  const auto add_side = [&](int a, int b, double weight) {
    result(a, a) += weight;
    result(b, b) += weight;
    result(a, b) -= weight;
    result(b, a) -= weight;
  };
  for (const auto& t : terms_) {
    const double weight = t.weight * (t.x_order == 1 ? hy / hx : hx / hy) / 2;
    add_side(0, t.x_order == 1 ? 1 : 2, weight);
    add_side(t.x_order == 1 ? 2 : 1, 3, weight);
  }
  return result;
}

SplineLevel::Local SplineLevel::cell_moments(int cx, int cy, Monomial m) const {
  const auto x = x_.cell_moments(cx, m.a), y = y_.cell_moments(cy, m.b);
  Local result(local_size());
  for (Eigen::Index b = 0; b < y.size(); ++b)
    result.segment(b * x.size(), x.size()) = x_.breakpoints().unit() * y_.breakpoints().unit() * y[b] * x;
  return result;
}

Eigen::SparseMatrix<double> SplineLevel::energy() const {
  Triplets entries;
  const int side = x_.degree() + 1, n = local_size();
  for (int cy = 0; cy < y_.cells(); ++cy)
    for (int cx = 0; cx < x_.cells(); ++cx) {
      if (!is_inside(cx, cy)) continue;
      const Element e = element(cx, cy);
      const auto number = [&](int a) { return function(cx + a % side, cy + a / side); };
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a)
          if (e(a, b) != 0) entries.emplace_back(number(a), number(b), e(a, b));
    }
  return assembled(size(), size(), entries);
}

double SplineLevel::energy_of(const Eigen::VectorXd& c) const {
  const int side = x_.degree() + 1;
  double sum = 0;
  for (int cy = 0; cy < y_.cells(); ++cy)
    for (int cx = 0; cx < x_.cells(); ++cx) {
      if (!is_inside(cx, cy)) continue;
      Local q(local_size());
      for (int a = 0; a < local_size(); ++a) q[a] = c[function(cx + a % side, cy + a / side)];
      sum += q.dot(element(cx, cy) * q);
    }
  return sum;
}

Eigen::SparseMatrix<double> SplineLevel::refinement(const SplineLevel& finer) const {
  const auto rx = x_.refinement(finer.x_);
  Eigen::SparseMatrix<double> ry(1, 1);
  if (interval_)
    ry.insert(0, 0) = 1;
  else
    ry = y_.refinement(finer.y_);
  Triplets entries;
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (int j = 0; j < y_.size(); ++j)
    for (int i = 0; i < x_.size(); ++i) {
      const int column = function(i, j);
      if (column < 0) continue;
      for (Entry b(ry, j); b; ++b)
        for (Entry a(rx, i); a; ++a) {
          const int row = finer.function(static_cast<int>(a.row()), static_cast<int>(b.row()));
          if (row >= 0) entries.emplace_back(row, column, a.value() * b.value());
        }
    }
  if (triangles_) cut_along_diagonal(entries, finer.x_.size(), x_.size());
  return assembled(finer.size(), size(), entries);
}

Eigen::MatrixXd SplineLevel::null_space() const {
  Eigen::MatrixXd result(size(), static_cast<Eigen::Index>(monomials_.size()));
  for (std::size_t m = 0; m < monomials_.size(); ++m) {
    const Eigen::VectorXd x = x_.monomial(monomials_[m].a), y = y_.monomial(monomials_[m].b);
    for (int f = 0; f < size(); ++f)
      result(f, static_cast<Eigen::Index>(m)) = x[grid(f) % x_.size()] * y[grid(f) / x_.size()];
  }
  return result;
}

Eigen::MatrixXd SplineLevel::moments() const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(monomials_.size()), size());
  const int side = x_.degree() + 1;
  for (int cy = 0; cy < y_.cells(); ++cy)
    for (int cx = 0; cx < x_.cells(); ++cx)
      for (std::size_t m = 0; is_inside(cx, cy) && m < monomials_.size(); ++m) {
        const Local w = cell_moments(cx, cy, monomials_[m]);
        for (int a = 0; a < local_size(); ++a)
          result(static_cast<Eigen::Index>(m), function(cx + a % side, cy + a / side)) += w[a];
      }
  return result;
}

}  // namespace batten
