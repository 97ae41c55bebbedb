// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/fem/operator.h>

#include <array>

namespace batten {
namespace {

/// What Gaussian curvature needs of an end: B_ij = [N_i' N_j] over the interval, in cells of the finest level, in the
/// band of the inner products. Zero where a condition fixes the value or the derivative.
BandedRows end_products(const SplineBasis& basis, BandedRows band, bool transpose) {
  band.scale = 1;
  std::fill(band.weights.begin(), band.weights.end(), 0.);
  const int d = basis.degree(), n = basis.size();
  band.begin = band.end = n / 2;
  if (basis.is_periodic()) return band;  // both ends cancel
  for (const bool upper : {false, true}) {
    const double t = upper ? basis.interval().finest_cells() : 0, sign = upper ? 1 : -1;
    const auto slope = basis.at(t, 1), value = basis.at(t);
    for (int a = upper ? d - 1 : 0; a <= (upper ? d : 1); ++a) {
      const int b = upper ? d : 0;
      const int i = slope.first + (transpose ? b : a), j = slope.first + (transpose ? a : b);
      band.weights[static_cast<std::size_t>(i * band.width + j - band.first[static_cast<std::size_t>(i)])] +=
          sign * slope.values[static_cast<std::size_t>(a)] * value.values[static_cast<std::size_t>(b)];
    }
  }
  return band;
}

/// a + factor b, both with the same band.
BandedRows plus(BandedRows a, double factor, const BandedRows& b) {
  for (std::size_t k = 0; k < a.weights.size(); ++k)
    a.weights[k] = a.scale * a.weights[k] + factor * b.scale * b.weights[k];
  a.scale = 1;
  find_repeating_rows(a);
  return a;
}

constexpr int most_orders = 4;          // derivatives of order 0 to 3
using Grams = std::vector<BandedRows>;  // by the order
using Factors = std::array<double, most_orders>;

Grams inner_products(const SplineBasis& basis, int orders) {
  Grams grams;
  for (int r = 0; r < orders; ++r) grams.push_back(basis.inner_products(std::min(r, basis.degree())));
  return grams;
}

/// Σ_r factor[r] gram_r with the scales multiplied in; a single term keeps its integers.
BandedRows mixture(const Grams& gram, const Factors& factor, double& outer) {
  std::size_t used = 0, last = 0;
  for (std::size_t r = 0; r < gram.size(); ++r)
    if (factor[r] != 0) {
      ++used;
      last = r;
    }
  outer = 1;
  if (used == 1) {
    outer = factor[last];
    return gram[last];
  }
  BandedRows sum = gram[0];
  sum.scale = 1;
  for (const auto& g : gram) {
    sum.begin = std::max(sum.begin, g.begin);
    sum.end = std::min(sum.end, g.end);
  }
  for (std::size_t k = 0; k < sum.weights.size(); ++k) {
    sum.weights[k] = 0;
    for (std::size_t r = 0; r < gram.size(); ++r) sum.weights[k] += factor[r] * gram[r].scale * gram[r].weights[k];
  }
  return sum;
}

/// One Kronecker term for each order of the derivative in y; the orders in x that go with it are mixed into one band.
TensorSum build_products(const Energy& energy, const SplineSpace& space) {
  int orders = 3;
  for (const auto& t : energy.terms()) orders = std::max({orders, t.x_order + 1, t.y_order + 1});
  const Grams gram_x = inner_products(space.x, orders), gram_y = inner_products(space.y, orders);
  std::vector<TensorSum::Term> terms;
  for (int b = 0; b < orders; ++b) {
    Factors factor{};
    bool used = false;
    for (const auto& t : energy.terms()) {
      if (t.y_order != b) continue;
      factor[static_cast<std::size_t>(t.x_order)] += t.weight * space.cell_factor(t.x_order, b);
      used = true;
    }
    if (!used) continue;
    TensorSum::Term term;
    term.x = mixture(gram_x, factor, term.factor);
    term.y = gram_y[static_cast<std::size_t>(b)];
    if (b == 1 && energy.curvature() != 0)
      for (const bool transpose : {false, true})
        term.x = plus(std::move(term.x), -energy.curvature() * space.cell_factor(1, 1) / term.factor,
                      end_products(space.x, gram_x[1], transpose));
    terms.push_back(std::move(term));
  }
  return TensorSum(std::move(terms));
}

/// With A_ij = ∫ N_i'' N_j = B - K, K_ij = ∫ N_i' N_j', twice the Gaussian curvature p_xx p_yy - p_xy² is
///
///   A_x ⊗ A_y^T + A_x^T ⊗ A_y - 2 K_x ⊗ K_y = B_x ⊗ B_y^T + B_x^T ⊗ B_y - K_x ⊗ (B_y + B_y^T) - (B_x + B_x^T) ⊗ K_y
///
/// The last product is part of build_products; the others act on the two first and last rows.
TensorSum build_end_rows(double curvature, const SplineSpace& space) {
  const BandedRows kx = space.x.inner_products(1), ky = space.y.inner_products(1);
  const BandedRows bx = end_products(space.x, kx, false), bxt = end_products(space.x, kx, true);
  const BandedRows by = end_products(space.y, ky, false), byt = end_products(space.y, ky, true);
  const double factor = curvature * space.cell_factor(1, 1);
  return TensorSum({{-factor, plus(by, 1, byt), kx}, {factor, byt, bx}, {factor, by, bxt}});
}

/// out += row j of the products times c.
void add_row(const TensorSum& products, int j, std::span<const double> c, double* out) {
  std::vector<double> more(static_cast<std::size_t>(products.output_columns()));
  products.row(j, c.data(), more.data());
  for (std::size_t i = 0; i < more.size(); ++i) out[i] += more[i];
}

bool has_free_end(const SplineBasis& basis) {
  return basis.ends().lower == EndCondition::Free || basis.ends().upper == EndCondition::Free;
}

}  // namespace

Operator::Operator(const Energy& energy, const SplineSpace& space)
    : order_(energy.order()),
      images_x_(space.x.images()),
      images_y_(space.y.images()),
      products_(build_products(energy, space)),
      inside_(EvenStencil::inside(*products_)) {
  if (energy.order() > 2) by_differences_.emplace(energy, space);
  if (energy.curvature() != 0 && has_free_end(space.y)) end_rows_ = build_end_rows(energy.curvature(), space);
}

/// Row j of the integrals, image by image.
void Operator::part(int j, std::span<const double> c, double* out, bool precise) const {
  if (precise && by_differences_) return by_differences_->row(j, c.data(), out);
  if (!products_) {
    std::fill_n(out, columns(), 0.);
    return precise ? stencil_.add_precise_row(j, 1, c, out) : stencil_.add_row(j, 1, c, out);
  }
  products_->row(j, c.data(), out);
  if (end_rows_ && std::min(j, rows() - 1 - j) <= 1) add_row(*end_rows_, j, c, out);
}

void Operator::folded_row(int j, std::span<const double> c, double* out, bool precise) const {
  const int first_image = rows() - images_y_;
  if (j >= first_image) {
    std::fill_n(out, columns(), 0.);
    return;
  }
  part(j, c, out, precise);
  if (j < images_y_) {
    std::vector<double> image(static_cast<std::size_t>(columns()));
    part(first_image + j, c, image.data(), precise);
    for (std::size_t i = 0; i < image.size(); ++i) out[i] += image[i];
  }
  double* image = out + columns() - images_x_;
  for (int i = 0; i < images_x_; ++i) out[i] += image[i];
  std::fill_n(image, images_x_, 0.);
}

void Operator::row(int j, const double* const* c, ColumnRange columns, double* out) const {
  products_->row(j, c, columns, out);
  if (!end_rows_ || std::min(j, rows() - 1 - j) > 1) return;
  std::vector<double> more(static_cast<std::size_t>(columns.end - columns.begin));
  end_rows_->row(j, c, columns, more.data());
  for (std::size_t i = 0; i < more.size(); ++i) out[i] += more[i];
}

void Operator::rough_row(int j, const double* const* c, ColumnRange columns, double* out) const {
  if (inside_ && j >= inside_->rows().begin && j < inside_->rows().end) return inside_->row(c, columns, out);
  row(j, c, columns, out);
}

void Operator::apply(std::span<const double> c, std::span<double> out) const {
  for_blocks(RowBlocks(rows(), columns()), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) precise_row(j, c, out.data() + static_cast<std::ptrdiff_t>(j) * columns());
  });
}

double Operator::diagonal_entry(int i, int j) const {
  const int x_period = columns() - images_x_, y_period = rows() - images_y_;
  if (i >= x_period || j >= y_period) return 0;
  double sum = 0;
  for (int q = j; q < rows(); q += y_period)
    for (int p = i; p < columns(); p += x_period) sum += entry(p, q, p, q);
  return sum;
}

RepeatedRows Operator::diagonal_rows() const {
  RowRange repeat;
  if (products_) {
    repeat = {2, rows() - 2};  // without the rows that Gaussian curvature adds to
    for (const auto& term : products_->terms())
      repeat = {std::max(repeat.begin, term.y.begin), std::min(repeat.end, term.y.end)};
  }
  RepeatedRows result(rows(), columns(), repeat);
  for_blocks(RowBlocks(rows(), columns()), [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int i = 0; i < columns() && !result.is_repeated(j); ++i) result.row(j)[i] = diagonal_entry(i, j);
  });
  return result;
}

std::vector<double> Operator::diagonal() const {
  const RepeatedRows distinct = diagonal_rows();
  std::vector<double> result;
  result.reserve(size());
  for (int j = 0; j < rows(); ++j) result.insert(result.end(), distinct.row(j), distinct.row(j) + columns());
  return result;
}

double Operator::entry(int i, int j, int k, int l) const {
  if (!products_) return l >= j ? stencil_.entry(i, j, k - i, l - j) : stencil_.entry(k, l, i - k, j - l);
  double sum = 0;
  for (const auto* products : {&products_, &end_rows_})
    if (*products)
      for (const auto& term : (*products)->terms()) sum += term.factor * (term.y(j, l) * term.x(i, k));
  return sum;
}

std::vector<double> apply_curvature(double curvature, const SplineSpace& space, std::span<const double> c,
                                    std::vector<double> memory) {
  std::vector<double> result = std::move(memory);
  result.assign(c.size(), 0.);
  if (curvature == 0) return result;
  const BandedRows kx = space.x.inner_products(1), ky = space.y.inner_products(1);
  const auto columns = plus(end_products(space.x, kx, false), 1, end_products(space.x, kx, true));
  const TensorSum at_columns({{-curvature * space.cell_factor(1, 1), ky, columns}}),
      at_rows = build_end_rows(curvature, space);
  const int nx = space.x.size(), ny = space.y.size();
  std::vector<const double*> in(static_cast<std::size_t>(at_columns.band_height()));
  for (int j = 0; j < ny; ++j) {
    double* out = result.data() + static_cast<std::ptrdiff_t>(j) * nx;
    for (std::size_t q = 0; q < in.size(); ++q)
      in[q] = c.data() + (at_columns.first_row(j) + static_cast<std::ptrdiff_t>(q)) * nx;
    for (const ColumnRange end : {ColumnRange{0, 2}, ColumnRange{std::max(2, nx - 2), nx}})
      at_columns.row(j, in.data(), end, out + end.begin);
    if (std::min(j, ny - 1 - j) < 2) add_row(at_rows, j, c, out);
  }
  return result;
}

}  // namespace batten
