// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/block_vectors.h>
#include <batten/flows/flow_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace batten {
namespace {

constexpr double outside = std::numeric_limits<double>::quiet_NaN();

const Solution& first_of(const std::optional<Solution>& stream, const std::optional<Solution>& potential) {
  if (!stream && !potential) throw InvalidInput("FlowField: expected a stream function or a potential, found none");
  return stream ? *stream : *potential;
}

bool alike(const Solution& a, const Solution& b) {
  const auto same = [](const Interval& p, const Interval& q) {
    return p.lower() == q.lower() && p.upper() == q.upper() && p.cells() == q.cells();
  };
  return a.degree() == b.degree() && same(a.region().x, b.region().x) && same(a.region().y, b.region().y);
}

/// The functions of the cell that holds a point, with `orders` derivatives in the units of the region.
class Patch {
public:
  Patch(const SplineBasis& bx, const SplineBasis& by, double x, double y, int orders)
      : columns_(bx.size()), degree_(bx.degree()) {
    const auto &ix = bx.interval(), &iy = by.interval();
    for (int r = 0; r <= orders; ++r) {
      x_[static_cast<std::size_t>(r)] = scaled(bx.at(ix.to_cells(x), r), std::pow(ix.finest_cell_length(), -r));
      y_[static_cast<std::size_t>(r)] = scaled(by.at(iy.to_cells(y), r), std::pow(iy.finest_cell_length(), -r));
    }
  }

  /// ∂_x^a ∂_y^b p. Derivatives do not see a constant: one coefficient is taken off first, so that they are as accurate
  /// as the differences of coefficients, however large p is.
  double derivative(const Solution& p, int a, int b) const {
    const auto &nx = x_[static_cast<std::size_t>(a)], &ny = y_[static_cast<std::size_t>(b)];
    const double* c = p.coefficients().data() + static_cast<std::ptrdiff_t>(ny.first) * columns_ + nx.first;
    const double middle = a + b == 0 ? 0 : c[degree_ / 2 * columns_ + degree_ / 2];
    double sum = 0;
    for (int j = 0; j <= degree_; ++j) {
      double line = 0;
      for (int i = 0; i <= degree_; ++i)
        line += nx.values[static_cast<std::size_t>(i)] * (c[j * columns_ + i] - middle);
      sum += ny.values[static_cast<std::size_t>(j)] * line;
    }
    return sum;
  }
  double derivative(const std::optional<Solution>& p, int a, int b) const { return p ? derivative(*p, a, b) : 0; }

private:
  static SplineBasis::Local scaled(SplineBasis::Local local, double factor) {
    for (double& v : local.values) v *= factor;
    return local;
  }

  std::ptrdiff_t columns_;
  int degree_;
  std::array<SplineBasis::Local, 3> x_, y_;
};

}  // namespace

FlowField::FlowField(std::optional<Solution> stream, std::optional<Solution> potential, const FlowGeometry& geometry)
    : stream_(std::move(stream)),
      potential_(std::move(potential)),
      geometry_(geometry),
      x_(first_of(stream_, potential_).region().x, any().degree()),
      y_(any().region().y, any().degree()) {
  if (stream_ && potential_ && !alike(*stream_, *potential_))
    throw InvalidInput("FlowField: expected a stream function and a potential on the same cells and of one degree");
  if (degree() < 2) throw InvalidInput("FlowField: expected a degree of at least 2, found " + std::to_string(degree()));
  try {
    geometry_.expect_inside(region());
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string("FlowField: ") + error.what());
  }
}

// East and north below stand for 1 over the length of one unit of x and of y, in a plane 1.

FlowField::Velocity FlowField::velocity(double x, double y) const {
  if (!region().contains(x, y)) return {outside, outside};
  const Patch at(x_, y_, x, y, 1);
  const double east = 1 / geometry_.length_x(y), north = 1 / geometry_.length_y();
  return {north * at.derivative(stream_, 0, 1) + east * at.derivative(potential_, 1, 0),
          -east * at.derivative(stream_, 1, 0) + north * at.derivative(potential_, 0, 1)};
}

FlowField::Gradient FlowField::gradient(double x, double y) const {
  if (!region().contains(x, y)) return {outside, outside, outside, outside};
  const Patch at(x_, y_, x, y, 2);
  const double east = 1 / geometry_.length_x(y), north = 1 / geometry_.length_y(), bend = geometry_.bend(y);
  const double psi_xy = east * north * at.derivative(stream_, 1, 1);
  const double phi_xy = east * north * at.derivative(potential_, 1, 1);
  // ∂_y of 1 / cos y makes the terms with bend.
  return {psi_xy + east * east * at.derivative(potential_, 2, 0),
          north * north * at.derivative(stream_, 0, 2) + phi_xy + bend * east * at.derivative(potential_, 1, 0),
          -east * east * at.derivative(stream_, 2, 0) + phi_xy,
          -psi_xy - bend * east * at.derivative(stream_, 1, 0) + north * north * at.derivative(potential_, 0, 2)};
}

double FlowField::speed(double x, double y) const {
  const auto [u, v] = velocity(x, y);
  return std::hypot(u, v);
}

double FlowField::divergence(double x, double y) const { return laplacian(potential_, x, y); }

double FlowField::vorticity(double x, double y) const { return -laplacian(stream_, x, y); }

/// div grad p, that of Laplace and Beltrami on a sphere.
double FlowField::laplacian(const std::optional<Solution>& p, double x, double y) const {
  if (!region().contains(x, y)) return outside;
  const Patch at(x_, y_, x, y, 2);
  const double east = 1 / geometry_.length_x(y), north = 1 / geometry_.length_y();
  return east * east * at.derivative(p, 2, 0) + north * north * at.derivative(p, 0, 2) -
         geometry_.bend(y) * north * at.derivative(p, 0, 1);
}

double FlowField::stream_function(double x, double y) const {
  if (!region().contains(x, y)) return outside;
  return stream_ ? sign_of_stream() * stream_->value(x, y) : 0;
}

namespace {

/// ∂_x^a ∂_y^b p at the corners of the cells, in the units of the region.
std::vector<double> sampled(const std::optional<Solution>& p, const SplineBasis& x, const SplineBasis& y, int a,
                            int b) {
  const double factor =
      std::pow(x.interval().finest_cell_length(), -a) * std::pow(y.interval().finest_cell_length(), -b);
  const TensorSum sampling({{factor, y.samples(b), x.samples(a)}});
  std::vector<double> values(sampling.output_size());
  if (p) sampling.apply(p->coefficients(), values);
  return values;
}

std::vector<double> scaled(double factor, std::vector<double> a) {
  for (double& v : a) v *= factor;
  return a;
}

/// a + b
std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

/// One factor for each row of the grid.
std::vector<double> rows_scaled(const std::vector<double>& factors, std::vector<double> a) {
  const std::size_t columns = a.size() / factors.size();
  for (std::size_t i = 0; i < a.size(); ++i) a[i] *= factors[i / columns];
  return a;
}

}  // namespace

GridSamples FlowField::samples() const {
  const auto &ix = region().x, &iy = region().y;
  GridSamples result{{ix.cells() + 1, iy.cells() + 1},
                     {ix.lower(), iy.lower()},
                     {ix.finest_cell_length(), iy.finest_cell_length()},
                     {}};
  const auto of = [this](const std::optional<Solution>& p, int a, int b) { return sampled(p, x_, y_, a, b); };
  const double north = 1 / geometry_.length_y();
  std::vector<double> east, east_square, bend;
  for (int j = 0; j <= iy.cells(); ++j) {
    east.push_back(1 / geometry_.length_x(iy.coordinate(j)));
    east_square.push_back(east.back() * east.back());
    bend.push_back(-geometry_.bend(iy.coordinate(j)) * north);
  }
  const auto laplacian = [&](const std::optional<Solution>& p) {
    auto values = sum(rows_scaled(east_square, of(p, 2, 0)), scaled(north * north, of(p, 0, 2)));
    return geometry_.is_sphere() ? sum(std::move(values), rows_scaled(bend, of(p, 0, 1))) : values;
  };
  const auto u = sum(scaled(north, of(stream_, 0, 1)), rows_scaled(east, of(potential_, 1, 0)));
  const auto v = sum(scaled(north, of(potential_, 0, 1)), scaled(-1, rows_scaled(east, of(stream_, 1, 0))));
  PointArray velocity{"velocity", 3, std::vector<double>(3 * u.size())}, speed{"speed", 1, u};
  for (std::size_t i = 0; i < u.size(); ++i) {
    velocity.values[3 * i] = u[i];
    velocity.values[3 * i + 1] = v[i];
    speed.values[i] = std::hypot(u[i], v[i]);
  }
  result.arrays.push_back(std::move(velocity));
  result.arrays.push_back({"divergence", 1, laplacian(potential_)});
  result.arrays.push_back({"vorticity", 1, scaled(-1, laplacian(stream_))});
  result.arrays.push_back(std::move(speed));
  if (stream_) result.arrays.push_back({"stream_function", 1, scaled(sign_of_stream(), of(stream_, 0, 0))});
  if (potential_) result.arrays.push_back({"potential", 1, of(potential_, 0, 0)});
  return result;
}

namespace {

std::vector<double> numbers(const Solution& p) { return {p.coefficients().begin(), p.coefficients().end()}; }

}  // namespace

Record FlowField::to_record() const {
  Record record;
  record.kind = "flow";
  record.degree = degree();
  record.cells = {region().x.cells(), region().y.cells()};
  record.region = {region().x.lower(), region().x.upper(), region().y.lower(), region().y.upper()};
  if (stream_) record.arrays["stream_coefficients"] = numbers(*stream_);
  if (potential_) record.arrays["potential_coefficients"] = numbers(*potential_);
  if (geometry_.is_sphere()) record.numbers["sphere_radius"] = geometry_.radius();
  return record;
}

FlowField FlowField::from_record(const Record& record) {
  if (record.kind != "flow")
    throw InvalidInput("FlowField::from_record: expected a result of kind \"flow\", found \"" + record.kind + "\"");
  const auto& r = record.region;
  const Rectangle region{Interval(r[0], r[1], record.cells[0]), Interval(r[2], r[3], record.cells[1])};
  const auto part = [&](const std::string& name) -> std::optional<Solution> {
    const auto found = record.arrays.find(name);
    if (found == record.arrays.end()) return {};
    return Solution(region, record.degree, found->second);
  };
  auto stream = part("stream_coefficients"), potential = part("potential_coefficients");
  if (!stream && !potential)
    throw InvalidInput(
        "FlowField::from_record: expected an array \"stream_coefficients\" or \"potential_coefficients\", found none");
  const auto radius = record.numbers.find("sphere_radius");
  const auto geometry = radius == record.numbers.end() ? FlowGeometry::plane() : FlowGeometry::sphere(radius->second);
  return FlowField(std::move(stream), std::move(potential), geometry);
}

namespace {

/// ∫∫ ∂_x^a ∂_y^b p ∂_x^e ∂_y^f q, in cells.
double product(const Solution& p, std::array<int, 2> a, const Solution& q, std::array<int, 2> b, const SplineBasis& x,
               const SplineBasis& y) {
  const TensorSum products({{1., y.inner_products(a[1], b[1]), x.inner_products(a[0], b[0])}});
  std::vector<double> image(products.output_size());
  products.apply(q.coefficients(), image);
  return dot(p.coefficients(), image);
}

}  // namespace

double inner_product(const FlowField& a, const FlowField& b) {
  const Solution& one = a.stream() ? *a.stream() : *a.potential();
  const Solution& two = b.stream() ? *b.stream() : *b.potential();
  if (a.geometry().is_sphere() || b.geometry().is_sphere())
    throw InvalidInput("inner_product: expected fields in a plane, found one on a sphere");
  if (!alike(one, two)) throw InvalidInput("inner_product: expected fields on the same cells and of one degree");
  const SplineBasis x(a.region().x, a.degree()), y(a.region().y, a.degree());
  const double hx = x.interval().finest_cell_length(), hy = y.interval().finest_cell_length();
  const auto membrane = [&](const Solution& p, const Solution& q) {  // grad p · grad q = rot p · rot q
    return hy / hx * product(p, {1, 0}, q, {1, 0}, x, y) + hx / hy * product(p, {0, 1}, q, {0, 1}, x, y);
  };
  const auto mixed = [&](const Solution& psi, const Solution& phi) {  // rot ψ · grad φ
    return product(psi, {0, 1}, phi, {1, 0}, x, y) - product(psi, {1, 0}, phi, {0, 1}, x, y);
  };
  double sum = 0;
  if (a.stream() && b.stream()) sum += membrane(*a.stream(), *b.stream());
  if (a.potential() && b.potential()) sum += membrane(*a.potential(), *b.potential());
  if (a.stream() && b.potential()) sum += mixed(*a.stream(), *b.potential());
  if (b.stream() && a.potential()) sum += mixed(*b.stream(), *a.potential());
  return sum;
}

double mean_value(const Solution& p) {
  const auto& [width, height] = p.region();
  const auto x = SplineBasis(width, p.degree()).integrals(), y = SplineBasis(height, p.degree()).integrals();
  double sum = 0;
  const double* c = p.coefficients().data();
  for (double wy : y) {
    double line = 0;
    for (double wx : x) line += wx * *c++;
    sum += wy * line;
  }
  return sum / (static_cast<double>(width.finest_cells()) * height.finest_cells());
}

}  // namespace batten
