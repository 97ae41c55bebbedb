// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/bases/invariant_polytope.h>
#include <batten/bases/leading_products.h>
#include <batten/bases/least_absolute_sum.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double inside = 1 - 1e-7;     // gauge below which an image counts as inside: leaves room for rounding
constexpr double inflation = 1 + 1e-6;  // new vertices are a little larger than the image they stand for
const double grain = std::ldexp(1., 48);

double rounded(double x) { return std::round(x * grain) / grain; }

/// x as a multiple of 2^-48, exactly.
Rational exact(double x) { return Rational(rounded(x)); }

struct Image {
  Eigen::VectorXd point;
  double gauge;
  std::size_t place;  // in the list of images
};

template <int D>
class Growth {
public:
  using Combination = typename InvariantPolytope<D>::Combination;

  Growth(const std::vector<RationalMatrix>& matrices, const PolytopeSearch& search)
      : search_(search), unit_(static_cast<double>(search.unit)), dimension_(matrices.front().rows()) {
    const double radius = static_cast<double>(search.radius);
    for (const RationalMatrix& a : matrices) {
      plain_.push_back(to_double(a));
      scaled_.push_back(plain_.back() / radius);
    }
    vertices_ = unit_ * Eigen::MatrixXd::Identity(dimension_, dimension_);
    for (const Eigen::VectorXd& v : leading_eigenvectors())
      if (gauge_of(v) > 1.1) add_vertex(v);  // those of a cluster of eigenvalues are nearly the same
  }

  bool closes() {
    Eigen::Index from = 0;
    while (from < vertices_.cols()) {
      std::vector<Image> outside = images_outside(from);
      from = vertices_.cols();
      std::sort(outside.begin(), outside.end(), [](const Image& a, const Image& b) { return a.gauge > b.gauge; });
      for (const Image& image : outside)
        if (!settle(image)) add_image(image);
      if (vertices_.cols() > search_.most_vertices) return false;
    }
    return true;
  }

  InvariantPolytope<D> result() const {
    InvariantPolytope<D> polytope;
    polytope.radius = search_.radius;
    polytope.unit = search_.unit;
    for (Eigen::Index v = dimension_; v < vertices_.cols(); ++v) {
      std::vector<Rational> vertex;
      for (Eigen::Index i = 0; i < dimension_; ++i) vertex.push_back(exact(vertices_(i, v)));
      polytope.vertices.push_back(std::move(vertex));
    }
    polytope.images = combinations_;
    return polytope;
  }

private:
  BasicSolution combination_for(const Eigen::VectorXd& point) const {
    return least_absolute_sum(vertices_, point, Eigen::VectorXd::Ones(vertices_.cols()));
  }
  double gauge_of(const Eigen::VectorXd& point) const { return combination_for(point).cost; }

  void add_vertex(const Eigen::VectorXd& v) {
    vertices_.conservativeResize(Eigen::NoChange, vertices_.cols() + 1);
    vertices_.rightCols(1) = v.unaryExpr(&rounded);
  }

  /// Real and imaginary parts, of size 1, of the eigenvectors of one product that belong to its largest eigenvalues.
  void append_eigenvectors(const Eigen::MatrixXd& product, std::vector<Eigen::VectorXd>& found) const {
    const Eigensystem system = eigensystem(product);
    const Eigen::VectorXd moduli = system.values.cwiseAbs();
    for (Eigen::Index k = 0; k < moduli.size(); ++k) {
      if (moduli[k] < 0.99 * moduli.maxCoeff()) continue;
      for (const Eigen::VectorXd& part :
           {Eigen::VectorXd(system.vectors.col(k).real()), Eigen::VectorXd(system.vectors.col(k).imag())})
        if (part.cwiseAbs().maxCoeff() > 1e-3) found.push_back(part / part.cwiseAbs().maxCoeff());
    }
  }

  std::vector<Eigen::VectorXd> leading_eigenvectors() const {
    std::vector<Eigen::VectorXd> found;
    const auto products = leading_products(plain_, 300);
    for (const MatrixProduct& leading : products) {
      if (leading.rate < 0.97 * products.front().rate || leading.rate == 0) continue;
      if (leading.factors.size() > products.front().factors.size()) continue;
      Eigen::MatrixXd product = Eigen::MatrixXd::Identity(dimension_, dimension_);
      for (int e : leading.factors) product = plain_[static_cast<std::size_t>(e)] * product;
      append_eigenvectors(product, found);
    }
    return found;
  }

  /// The images of the vertices from `from` on that are not yet combinations of the vertices.
  std::vector<Image> images_outside(Eigen::Index from) {
    std::vector<Image> outside;
    const std::size_t digits = scaled_.size();
    combinations_.resize(static_cast<std::size_t>(vertices_.cols()) * digits);
    for (Eigen::Index v = from; v < vertices_.cols(); ++v)
      for (std::size_t e = 0; e < digits; ++e) {
        Image image{scaled_[e] * vertices_.col(v), 0, e + digits * static_cast<std::size_t>(v)};
        if (!settle(image)) outside.push_back(image);
      }
    return outside;
  }

  /// Whether the image lies inside; then its combination is kept.
  bool settle(Image& image) {
    const BasicSolution solution = combination_for(image.point);
    image.gauge = solution.cost;
    if (image.gauge > inside) return false;
    Combination& kept = combinations_[image.place];
    for (std::size_t k = 0; k < solution.basis.size(); ++k) {
      const Rational c = exact(solution.values[static_cast<Eigen::Index>(k)]);
      if (c == 0) continue;
      kept.indices.push_back(solution.basis[k]);
      kept.coefficients.push_back(c);
    }
    return true;
  }
  bool settle(const Image& image) {
    Image copy = image;
    return settle(copy);
  }

  void add_image(const Image& image) {
    combinations_[image.place] = {{static_cast<int>(vertices_.cols())}, {exact(1 / inflation)}};
    add_vertex(inflation * image.point);
  }

  PolytopeSearch search_;
  double unit_;
  int dimension_;
  std::vector<Eigen::MatrixXd> plain_, scaled_;
  Eigen::MatrixXd vertices_;  // one in each column, the unit vectors first
  std::vector<Combination> combinations_;
};

}  // namespace

template <int D>
std::optional<InvariantPolytope<D>> invariant_polytope(const std::vector<RationalMatrix>& matrices,
                                                       const PolytopeSearch& search) {
  Growth<D> growth(matrices, search);
  if (!growth.closes()) return std::nullopt;
  return growth.result();
}

template std::optional<InvariantPolytope<1>> invariant_polytope<1>(const std::vector<RationalMatrix>&,
                                                                   const PolytopeSearch&);
template std::optional<InvariantPolytope<2>> invariant_polytope<2>(const std::vector<RationalMatrix>&,
                                                                   const PolytopeSearch&);

}  // namespace batten
