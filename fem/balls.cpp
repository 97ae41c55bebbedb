// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/fem/balls.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

using Vector = std::array<double, Balls::most>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

double length(const Vector& a) { return std::sqrt(a[1] * a[1] + a[2] * a[2] + a[3] * a[3]); }

/// a·J a with J = diag(1, -1, -1, -1), without cancellation.
double square(const Vector& a) { return (a[0] - length(a)) * (a[0] + length(a)); }

Vector flipped(const Vector& a) { return {a[0], -a[1], -a[2], -a[3]}; }

/// a + factor b
Vector sum(const Vector& a, double factor, const Vector& b) {
  Vector result;
  for (std::size_t k = 0; k < a.size(); ++k) result[k] = a[k] + factor * b[k];
  return result;
}

/// The product a ∘ b = (a·b; a_0 b + b_0 a) of the cone's algebra.
Vector product(const Vector& a, const Vector& b) {
  Vector result = {dot(a, b), 0, 0, 0};
  for (std::size_t k = 1; k < a.size(); ++k) result[k] = a[0] * b[k] + b[0] * a[k];
  return result;
}

/// x with a ∘ x = b.
Vector quotient(const Vector& a, const Vector& b) {
  const double along = a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  Vector result = {(a[0] * b[0] - along) / square(a), 0, 0, 0};
  for (std::size_t k = 1; k < a.size(); ++k) result[k] = (b[k] - result[0] * a[k]) / a[0];
  return result;
}

/// The longest step for which a + step d stays in the cone.
double longest(const Vector& a, const Vector& d) {
  const double c = square(a), half = a[0] * d[0] - (a[1] * d[1] + a[2] * d[2] + a[3] * d[3]), e = square(d);
  const double discriminant = half * half - e * c;
  double step = std::numeric_limits<double>::infinity();
  if (d[0] < 0) step = -a[0] / d[0];
  if (discriminant < 0) return step;
  const double root = half < 0 ? -half + std::sqrt(discriminant) : -half - std::sqrt(discriminant);
  for (const double t : {c / root, root / e})  // of e t² + 2 half t + c = 0
    if (t > 0) step = std::min(step, t);
  return step;
}

}  // namespace

Balls::Balls(std::vector<double> centre, std::vector<double> radius, const Options& options)
    : centre_(std::move(centre)),
      radius_(std::move(radius)),
      dimension_(static_cast<std::size_t>(options.dimension)),
      rows_(dimension_ + (options.is_elastic ? 1 : 0)),
      is_elastic_(options.is_elastic),
      margin_(1 - margin),
      cones_(radius_.size()) {}

Balls::Vector Balls::point_of(std::size_t block, std::span<const double> v) const {
  Vector result = {margin_ * radius_[block]};
  std::size_t row = block * rows_;
  if (is_elastic_) result[0] += margin_ * v[row++];
  for (std::size_t k = 0; k < dimension_; ++k) result[k + 1] = v[row + k] - centre_[block * dimension_ + k];
  return result;
}

void Balls::put(std::size_t block, const Vector& value, std::span<double> rows) const {
  std::size_t row = block * rows_;
  if (is_elastic_) rows[row++] = margin_ * value[0];
  for (std::size_t k = 0; k < dimension_; ++k) rows[row + k] = value[k + 1];
}

void Balls::start(std::span<const double> v, double room) {
  constexpr double least_slack = 0.3;  // of the radius
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    Cone& cone = cones_[i];
    cone = {};
    cone.slack = point_of(i, v);
    const double reach = (1 - least_slack) * cone.slack[0], found = length(cone.slack);
    if (found > reach)
      for (std::size_t k = 1; k < most; ++k) cone.slack[k] *= reach / found;
    // s ∘ y = room e
    cone.multiplier = sum({}, room / square(cone.slack), flipped(cone.slack));
    scale(cone);
  }
}

double Balls::violation(std::span<const double> v) const {
  double worst = 0;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Vector at = point_of(i, v);
    worst = std::max(worst, (length(at) - at[0] / margin_) / radius_[i]);
  }
  return worst;
}

std::size_t Balls::active() const {
  double largest = 0;
  for (std::size_t i = 0; i < cones_.size(); ++i)
    largest = std::max(largest, length(cones_[i].multiplier) * radius_[i]);
  std::size_t count = 0;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& c = cones_[i];
    count += length(c.multiplier) * radius_[i] / largest > 1 - length(c.slack) / c.slack[0];
  }
  return count;
}

std::vector<double> Balls::force() const {
  std::vector<double> force(cones_.size() * rows_);
  for (std::size_t i = 0; i < cones_.size(); ++i) put(i, cones_[i].multiplier, force);
  return force;
}

// Of an elastic block: max over r >= |v - centre| of -f_0 (r - radius) - f·v, finite where f_0 >= |f|.
double Balls::gain(std::span<const double> force) const {
  double sum = 0;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const double* f = force.data() + i * rows_;
    const double first = is_elastic_ ? *f++ : 0;
    double square = 0;
    for (std::size_t k = 0; k < dimension_; ++k) {
      sum -= f[k] * centre_[i * dimension_ + k];
      square += f[k] * f[k];
    }
    sum += radius_[i] * (is_elastic_ ? first : std::sqrt(square));
  }
  return sum;
}

/// W maps the multiplier to the same λ as W^-1 the slack.
void Balls::scale(Cone& c) const {
  const double s = std::sqrt(square(c.slack)), y = std::sqrt(square(c.multiplier));
  const Vector unit_s = sum({}, 1 / s, c.slack), unit_y = sum({}, 1 / y, c.multiplier);
  const double gamma = std::sqrt((1 + dot(unit_s, unit_y)) / 2);
  Vector w = sum({}, 1 / (2 * gamma), sum(unit_s, 1, flipped(unit_y)));
  const double factor = 1 / std::sqrt(2 * (w[0] + 1));
  w[0] += 1;
  c.axis = sum({}, factor, w);
  c.beta = std::sqrt(s / y);
}

Balls::Vector Balls::scaled(const Cone& c, const Vector& x) {
  return sum({}, c.beta, sum(sum({}, 2 * dot(c.axis, x), c.axis), -1, flipped(x)));
}

Balls::Vector Balls::unscaled(const Cone& c, const Vector& x) {
  const Vector axis = flipped(c.axis);
  return sum({}, 1 / c.beta, sum(sum({}, 2 * dot(axis, x), axis), -1, flipped(x)));
}

RowWeights Balls::weights() const {
  const auto per_block = rows_ * (rows_ - 1) / 2;
  RowWeights result{static_cast<int>(rows_), std::vector<double>(cones_.size() * rows_),
                    std::vector<double>(cones_.size() * per_block)};
  const std::size_t first = is_elastic_ ? 0 : 1;  // component of row 0
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    std::size_t pair = i * per_block;
    for (std::size_t a = 0; a < rows_; ++a) {
      Vector unit{};
      unit[first + a] = first + a == 0 ? margin_ : 1;
      const Vector column = unscaled(cones_[i], unscaled(cones_[i], unit));
      result.diagonal[i * rows_ + a] = dot(unit, column);
      for (std::size_t b = a + 1; b < rows_; ++b) result.beside[pair++] = column[first + b];
    }
  }
  return result;
}

std::vector<double> Balls::aim(std::span<const double> v, double target, bool corrects) {
  std::vector<double> force(cones_.size() * rows_);
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    Cone& c = cones_[i];
    c.miss = sum(point_of(i, v), -1, c.slack);
    Vector right = {target, 0, 0, 0};
    if (corrects) right = sum(right, -1, product(unscaled(c, c.slack_change), scaled(c, c.multiplier_change)));
    c.wanted = unscaled(c, quotient(scaled(c, c.multiplier), right));
    put(i, sum(c.wanted, -1, unscaled(c, unscaled(c, c.miss))), force);
  }
  return force;
}

double Balls::respond(std::span<const double> dv) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    Cone& c = cones_[i];
    Vector move{};
    std::size_t row = i * rows_;
    if (is_elastic_) move[0] = margin_ * dv[row++];
    for (std::size_t k = 0; k < dimension_; ++k) move[k + 1] = dv[row + k];
    c.slack_change = sum(c.miss, 1, move);
    c.multiplier_change = sum(sum(c.wanted, -1, unscaled(c, unscaled(c, c.slack_change))), -1, c.multiplier);
    step = std::min({step, longest(c.slack, c.slack_change), longest(c.multiplier, c.multiplier_change)});
  }
  return step;
}

double Balls::room_after(double step) const {
  return sum_blocks(RowBlocks(static_cast<int>(cones_.size()), most), [&](int begin, int end) {
    double total = 0;
    for (int i = begin; i < end; ++i) {
      const Cone& c = cones_[static_cast<std::size_t>(i)];
      total += dot(sum(c.slack, step, c.slack_change), sum(c.multiplier, step, c.multiplier_change));
    }
    return total;
  });
}

void Balls::advance(double step) {
  for (Cone& c : cones_) {
    c.slack = sum(c.slack, step, c.slack_change);
    c.multiplier = sum(c.multiplier, step, c.multiplier_change);
    scale(c);
  }
}

}  // namespace batten
