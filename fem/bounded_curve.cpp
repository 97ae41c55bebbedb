// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/bounded_curve.h>
#include <batten/fem/boxes.h>
#include <batten/fem/curve_energy.h>
#include <batten/fem/interior_point.h>
#include <batten/fem/line_within.h>
#include <batten/fem/normalised_curve.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

constexpr int rounds_of_knots = 10;
constexpr double least_energy = 1e-8, kept = 1e-12, infinity = std::numeric_limits<double>::infinity();

/// A knot, in normalised numbers.
struct Knot {
  double place;  ///< in mean cells from the first one
  double weight, target;
  double lower, upper;        ///< of the value
  double unit = 1;            ///< of a violation
  double lift = 0, drop = 0;  ///< by which the bounds are narrowed to keep the curve inside nearby
  double value = 0;           ///< of the last curve
  bool is_clamped = false;    ///< a fixed value at a bound: the slope is 0

  bool is_fixed() const { return std::isinf(weight); }
};

class BoundedSearch {
public:
  BoundedSearch(const std::vector<double>& knots, const Eigen::VectorXd& points, const CurveBounds& bounds);
  BoundedCurve run();

private:
  struct Strip {
    CurveEnergy::Strip strip;
    std::vector<double> values, lower, upper, free_lower, free_upper, unit;
    std::vector<std::size_t> left, right;  ///< rows of knot i as the end of the cell before it and after it
  };
  Knot data_knot(std::size_t i) const;
  std::size_t cells() const { return knots_.size() - (bounds_.closed ? 0 : 1); }
  double end_of(std::size_t cell) const { return cell + 1 < knots_.size() ? knots_[cell + 1].place : length_; }
  enum class Kept { Bounds, Nothing };
  Strip strip(Kept what) const;
  void solve(int round);
  void settle(const CurveEnergy& energy, const InteriorPointResult& result, const Strip& s);
  CubicCell cell(std::size_t k) const;
  std::optional<HermiteCurve> straight() const;
  /// Whether the curve is inside; else knots and bounds are changed where it is not.
  bool is_inside(int round);
  double mend(std::size_t k, double sign, int round, std::vector<Knot>& added);
  void narrow(std::size_t cell, double sign, double by);
  HermiteCurve curve() const;

  NormalisedCurve data_;
  CurveBounds bounds_;
  double first_, length_, minimum_, maximum_, least_energy_;
  std::vector<double> points_;
  std::vector<Knot> knots_;
  std::vector<CubicCell> last_;
  CurveAccount account_;
};

void check(const std::vector<double>& knots, const Eigen::VectorXd& points, const CurveBounds& bounds) {
  NaturalCubic::require(knots, points, bounds.closed);
  if (!(bounds.minimum < bounds.maximum))
    throw InvalidInput("bounded_curve: the minimum must be below the maximum, found " + std::to_string(bounds.minimum) +
                       " and " + std::to_string(bounds.maximum));
  if (bounds.lambda && !(*bounds.lambda > 0 && std::isfinite(*bounds.lambda)))
    throw InvalidInput("bounded_curve: lambda must be positive, found " + std::to_string(*bounds.lambda));
  if (!bounds.tolerances.empty() && static_cast<Eigen::Index>(bounds.tolerances.size()) != points.size())
    throw InvalidInput("bounded_curve: one tolerance for each of " + std::to_string(points.size()) +
                       " points is needed, found " + std::to_string(bounds.tolerances.size()));
  for (Eigen::Index i = 0; i < points.size() && !bounds.lambda; ++i) {
    const double tolerance = bounds.tolerances.empty() ? 0 : bounds.tolerances[static_cast<std::size_t>(i)];
    if (!bounds.tolerances.empty() && !(tolerance > 0 && std::isfinite(tolerance)))
      throw InvalidInput("bounded_curve: tolerances must be positive, found " + std::to_string(tolerance) +
                         " at place " + std::to_string(i));
    if (points[i] + tolerance < bounds.minimum || points[i] - tolerance > bounds.maximum)
      throw InvalidInput("bounded_curve: " + std::to_string(points[i]) + " at place " + std::to_string(i) +
                         " cannot be kept within the bounds");
  }
}

BoundedSearch::BoundedSearch(const std::vector<double>& knots, const Eigen::VectorXd& points, const CurveBounds& bounds)
    : data_(knots, points, NormalisedCurve::Less::Mean),
      bounds_(bounds),
      first_(knots.front()),
      length_((knots.back() - knots.front()) / data_.cell),
      minimum_((bounds.minimum - data_.line(0, 0)) / data_.range),
      maximum_((bounds.maximum - data_.line(0, 0)) / data_.range),
      least_energy_(data_.normalised_energy(least_energy)),
      points_(points.begin(), points.end()) {
  if (bounds.lambda)
    least_energy_ = least_energy * static_cast<double>(points.size()) * std::pow(data_.cell, 3) / *bounds.lambda / 2;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    knots_.push_back(data_knot(i));
    knots_.back().place = (knots[i] - first_) / data_.cell;
  }
}

Knot BoundedSearch::data_knot(std::size_t i) const {
  const double point = data_.points[i];
  Knot knot{0, 0, point, minimum_, maximum_};
  if (bounds_.lambda) {
    knot.weight = std::pow(data_.cell, 3) / *bounds_.lambda;
  } else if (bounds_.tolerances.empty()) {
    knot.weight = infinity;
  } else {
    constexpr double least_width = 1e-6;  // of the tolerance: boxes that are less wide are a value
    knot.unit = bounds_.tolerances[i] / data_.range;
    knot.lower = std::max(knot.lower, point - knot.unit);
    knot.upper = std::min(knot.upper, point + knot.unit);
    if (knot.upper - knot.lower < least_width * knot.unit) {
      knot.weight = infinity;
      knot.target = point < knot.lower ? knot.lower : knot.upper;
    }
  }
  const double nearest = std::min(knot.target - minimum_, maximum_ - knot.target);
  const bool is_end = !bounds_.closed && (i == 0 || i + 1 == points_.size());
  knot.is_clamped = knot.is_fixed() && nearest <= kept && !is_end;
  knot.value = std::clamp(point, knot.lower, knot.upper);
  return knot;
}

// A clamped knot is two rows with nothing between them.
BoundedSearch::Strip BoundedSearch::strip(Kept what) const {
  Strip s;
  s.strip.closed = bounds_.closed;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const Knot& k = knots_[i];
    const bool is_free = k.is_fixed() || what == Kept::Nothing;
    s.left.push_back(s.values.size());
    for (int copy = 0; copy < (k.is_clamped ? 2 : 1); ++copy) {
      if (copy == 1) s.strip.widths.push_back(0);
      s.strip.weights.push_back(k.weight);
      s.strip.targets.push_back(k.target);
      s.values.push_back(k.value);
      s.lower.push_back(is_free ? -infinity : k.lower + k.lift);
      s.upper.push_back(is_free ? infinity : k.upper - k.drop);
      s.free_lower.push_back(is_free ? -infinity : k.lower);
      s.free_upper.push_back(is_free ? infinity : k.upper);
      s.unit.push_back(k.unit);
    }
    s.right.push_back(s.values.size() - 1);
    if (i < cells()) s.strip.widths.push_back(end_of(i) - k.place);
  }
  return s;
}

void BoundedSearch::solve(int round) {
  const Strip s = strip(round == 0 && bounds_.lambda ? Kept::Nothing : Kept::Bounds);
  CurveEnergy energy(s.strip, s.values);
  Boxes boxes(s.lower, s.upper, s.unit);
  InteriorPointResult result;
  if (boxes.count() == 0) {
    energy.direction(boxes.weights(), boxes.force(), 0);
    energy.advance(1);
  } else {
    boxes.start(energy.values(), std::max(energy.energy(), least_energy_) / boxes.count());
    InteriorPointOptions options;
    options.least_energy = least_energy_;
    result = minimise(energy, boxes, options);
    if (result.violation > 0 || result.force.empty())
      throw SolverError("bounded_curve: the bounds are not kept after " + std::to_string(result.steps) + " steps");
    // Narrowed bounds are ours: the least energy is bounded by those that were asked for.
    const double bound = energy.bound(result.force) - Boxes(s.free_lower, s.free_upper, s.unit).gain(result.force);
    result.gap = (result.energy - bound) / std::max(result.energy, least_energy_);
  }
  settle(energy, result, s);
}

/// Takes over what was found.
void BoundedSearch::settle(const CurveEnergy& energy, const InteriorPointResult& result, const Strip& s) {
  const auto values = energy.values();
  const auto& bends = energy.second_derivatives();
  last_.clear();
  double bending = 0;
  for (std::size_t k = 0; k < cells(); ++k) {
    const std::size_t a = s.right[k], b = s.left[k + 1 < knots_.size() ? k + 1 : 0];
    last_.push_back({end_of(k) - knots_[k].place, values[a], values[b], bends[a], bends[b]});
    bending += last_.back().width * (bends[a] * bends[a] + bends[a] * bends[b] + bends[b] * bends[b]) / 6;
  }
  for (std::size_t i = 0; i < knots_.size(); ++i) knots_[i].value = values[s.left[i]];
  account_.energy = data_.energy_of(bending) * data_.range * data_.range;
  account_.energy_gap = result.gap;
  account_.factorisations += energy.factorisations();
  account_.active = 0;
  double largest = 0;
  for (const double f : result.force) largest = std::max(largest, std::abs(f));
  for (std::size_t row = 0; row < result.force.size(); ++row) {
    const double f = result.force[row], slack = f > 0 ? values[row] - s.lower[row] : s.upper[row] - values[row];
    account_.active += slack / s.unit[row] * largest < std::abs(f);
  }
}

/// Of the curve less the bound below (sign 1), or of the bound above less the curve.
CubicCell distance(const CubicCell& cell, double sign, double bound) {
  return {cell.width, sign * (cell.left - bound), sign * (cell.right - bound), sign * cell.bend_left,
          sign * cell.bend_right};
}

void BoundedSearch::narrow(std::size_t cell, double sign, double by) {
  for (const std::size_t i : {cell, cell + 1 < knots_.size() ? cell + 1 : 0})
    (sign > 0 ? knots_[i].lift : knots_[i].drop) += by;
}

/// Returns by how much the cell is outside.
double BoundedSearch::mend(std::size_t k, double sign, int round, std::vector<Knot>& added) {
  const double bound = sign > 0 ? minimum_ : maximum_;
  if (std::isinf(bound)) return 0;
  const CubicCell away = distance(last_[k], sign, bound);
  const double x = away.lowest(), dip = -away.value(x);
  if (dip <= kept) return 0;
  const std::size_t next = k + 1 < knots_.size() ? k + 1 : 0;
  for (const std::size_t i : {k, next}) {  // an end that is fixed at the bound: it cannot be left inwards
    const bool is_left = i == k;
    const bool is_here = (is_left ? away.left : away.right) <= kept;
    const bool leaves = is_left ? away.slope_left() < 0 : away.slope_right() > 0;
    if (knots_[i].is_fixed() && !knots_[i].is_clamped && is_here && leaves) {
      knots_[i].is_clamped = true;
      return dip;
    }
  }
  constexpr double least_part = 0.02, least_dip = 3e-6;
  const double inner = std::clamp(x, least_part * away.width, (1 - least_part) * away.width);
  const bool is_held = knots_[k].is_fixed() && knots_[next].is_fixed();
  if (is_held || (round < rounds_of_knots && dip > least_dip && x == inner)) {
    Knot knot{knots_[k].place + inner, 0, 0, minimum_, maximum_};
    knot.value = last_[k].value(inner);
    added.push_back(knot);
  } else if (round > 0) {
    narrow(k, sign, std::ldexp(dip, std::max(2, round + 3 - rounds_of_knots)));
  }
  return dip;
}

bool BoundedSearch::is_inside(int round) {
  std::vector<Knot> added;
  account_.largest_violation = 0;
  for (std::size_t k = 0; k < cells(); ++k)
    for (const double sign : {1., -1.})
      account_.largest_violation = std::max(account_.largest_violation, mend(k, sign, round, added));
  knots_.insert(knots_.end(), added.begin(), added.end());
  std::stable_sort(knots_.begin(), knots_.end(), [](const Knot& a, const Knot& b) { return a.place < b.place; });
  return account_.largest_violation == 0;
}

std::optional<HermiteCurve> BoundedSearch::straight() const {
  std::vector<double> places, centre, radius;
  const auto add = [&](double place, double lower, double upper) {
    places.push_back(2 * place / length_ - 1);
    centre.push_back(std::clamp(0., lower, upper));
    if (std::isfinite(lower) && std::isfinite(upper)) centre.back() = (lower + upper) / 2;
    radius.push_back(std::min(upper - centre.back(), centre.back() - lower));
  };
  for (const Knot& k : knots_) add(k.place, k.lower, k.upper);
  if (*std::min_element(radius.begin(), radius.end()) <= 0) return std::nullopt;
  const auto line = line_within({1, places, centre, radius, bounds_.closed});
  if (!line) return std::nullopt;
  const double middle = data_.line(0, 0) + data_.range * (*line)[0], half = data_.range * (*line)[1];
  const double width = length_ * data_.cell, slope = 2 * half / width;
  return HermiteCurve{{first_, first_ + width}, {middle - half, middle + half}, {slope, slope}};
}

HermiteCurve BoundedSearch::curve() const {
  HermiteCurve result;
  const double to_slope = data_.range / data_.cell;
  const auto add = [&](double place, double value, double slope) {
    result.knots.push_back(first_ + place * data_.cell);
    result.values.push_back(data_.line(0, 0) + data_.range * value);
    result.slopes.push_back(to_slope * slope);
  };
  for (std::size_t k = 0; k < last_.size(); ++k) add(knots_[k].place, last_[k].left, last_[k].slope_left());
  add(length_, last_.back().right, last_.back().slope_right());
  return result;
}

BoundedCurve BoundedSearch::run() {
  constexpr int most_rounds = 30;
  if (!bounds_.tolerances.empty())
    if (auto line = straight()) return {std::move(*line), account_};
  for (int round = 0; round < most_rounds; ++round) {
    solve(round);
    if (is_inside(round)) return {curve(), account_};
  }
  throw SolverError("bounded_curve: the curve leaves its bounds by " +
                    std::to_string(account_.largest_violation * data_.range) + " after " + std::to_string(most_rounds) +
                    " rounds");
}

}  // namespace

BoundedCurve bounded_curve(const std::vector<double>& knots, const Eigen::VectorXd& points, const CurveBounds& bounds) {
  check(knots, points, bounds);
  return BoundedSearch(knots, points, bounds).run();
}

}  // namespace batten
