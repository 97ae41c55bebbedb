// SPDX-License-Identifier: MIT
#include <batten/bases/spline_basis.h>
#include <batten/bases/spline_pieces.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>

namespace batten {
namespace {

// Rules away from the ends repeat, so they are derived exactly once on a short interval with the same two ends and the
// repeating row is then copied. 3 d + 4 cells leave more than one row that no end touches.
int short_cells(int cells, int degree) { return std::min(cells, 3 * degree + 4 + (cells & 1)); }

/// In units of `unit`, which divides them.
std::vector<int> short_breakpoints(const Interval& interval, int degree, int unit = 1) {
  const auto all = interval.breakpoints();
  const int cells = short_cells(interval.cells(), degree);
  std::vector<int> result(all.begin(), all.begin() + cells + 1);
  result.back() = result[static_cast<std::size_t>(cells) - 1] + all.back() - all[all.size() - 2];
  for (int& b : result) b /= unit;
  return result;
}

/// A banded matrix in rationals: row i has entries for the columns first[i], first[i] + 1, ...
struct ExactRows {
  int columns = 0;
  std::vector<int> first;
  std::vector<std::vector<Rational>> entries;
};

/// Integers with one common denominator where they fit exactly into doubles, else doubles with scale 1.
Integer common_denominator(const ExactRows& exact) {
  Integer lcm = 1;
  for (const auto& row : exact.entries)
    for (const auto& e : row) lcm = boost::multiprecision::lcm(lcm, denominator(e));
  const Integer limit = Integer(1) << 53;
  for (const auto& row : exact.entries)
    for (const auto& e : row)
      if (boost::multiprecision::abs(Integer(numerator(e * Rational(lcm)))) > limit) return 1;
  return lcm;
}

BandedRows to_doubles(const ExactRows& exact) {
  BandedRows result;
  result.rows = static_cast<int>(exact.entries.size());
  result.columns = exact.columns;
  for (const auto& row : exact.entries) result.width = std::max(result.width, static_cast<int>(row.size()));
  const Integer unit = common_denominator(exact);
  result.scale = 1. / unit.convert_to<double>();
  for (std::size_t i = 0; i < exact.entries.size(); ++i) {
    const int first = std::min(exact.first[i], exact.columns - result.width);
    std::vector<double> row(static_cast<std::size_t>(result.width));
    for (std::size_t k = 0; k < exact.entries[i].size(); ++k)
      row[k + static_cast<std::size_t>(exact.first[i] - first)] =
          Rational(exact.entries[i][k] * Rational(unit)).convert_to<double>();
    result.first.push_back(first);
    result.weights.insert(result.weights.end(), row.begin(), row.end());
  }
  return result;
}

/// Leading and trailing zeros taken off every row, so that the width is the true one.
void trim(ExactRows& rows) {
  for (std::size_t i = 0; i < rows.entries.size(); ++i) {
    auto& row = rows.entries[i];
    while (row.size() > 1 && row.back() == 0) row.pop_back();
    const auto lead = std::find_if(row.begin(), row.end() - 1, [](const Rational& e) { return e != 0; }) - row.begin();
    row.erase(row.begin(), row.begin() + lead);
    rows.first[i] += static_cast<int>(lead);
  }
}

/// The matrix with `rows` rows and `columns` columns whose ends are those of the short one.
BandedRows lengthened(BandedRows brief, int rows, int columns, int period, int shift) {
  brief.period = period;
  brief.shift = shift;
  find_repeating_rows(brief);
  if (rows == brief.rows) return brief;
  BandedRows result = brief;
  result.rows = rows;
  result.columns = columns;
  result.first.clear();
  result.weights.clear();
  const int extra = rows - brief.rows, split = brief.begin + period;
  for (int i = 0; i < rows; ++i) {
    // head, then copies of the first period of repeating rows, then tail
    const int source = i < split ? i : i < split + extra ? brief.begin + (i - brief.begin) % period : i - extra;
    result.first.push_back(brief.first[static_cast<std::size_t>(source)] + (i - source) / period * shift);
    const auto row = brief.row(source);
    result.weights.insert(result.weights.end(), row.begin(), row.end());
  }
  result.end = brief.end + extra;
  return result;
}

/// [order][p][a]: coefficients of the derivatives of the functions of a piece, by powers of the local coordinate.
std::vector<double> derivatives_of(const SplinePiece& piece) {
  std::vector<double> result;
  const std::size_t n = piece.coefficients.size();
  for (std::size_t order = 0; order < n; ++order)
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t a = 0; a < n; ++a) {
        Rational c = p + order < n ? piece.coefficients[a][p + order] : Rational(0);
        for (std::size_t k = 0; k < order; ++k) c *= Rational(static_cast<long>(p + order - k)) / piece.length;
        result.push_back(c.convert_to<double>());
      }
  return result;
}

}  // namespace

/// Inner products of the splines on a short interval, by the orders of the derivatives.
struct SplineBasis::Derived {
  std::vector<int> breakpoints;
  EndKnots ends;
  std::vector<double> periodic_end;  // degree x degree, of a periodic basis
  std::mutex mutex;
  std::map<std::pair<int, int>, BandedRows> products;
};

/// The unit of length in which inner products are derived: the cells of an interval of equal ones have length 1, so
/// that all levels share what is derived.
int SplineBasis::unit() const { return interval_.is_uniform() ? interval_.regular_cell() : 1; }

SplineBasis SplineBasis::on(const Interval& interval, const EndConditions& ends) const {
  SplineBasis other(interval, degree_, ends);
  if (other.derived_->breakpoints == derived_->breakpoints && other.derived_->ends == derived_->ends)
    other.derived_ = derived_;
  return other;
}

SplineBasis::SplineBasis(const Interval& interval, int degree, const EndConditions& ends)
    : interval_(interval),
      degree_(degree),
      ends_(ends),
      stored_pieces_(short_cells(interval.cells(), degree)),
      derived_(std::make_shared<Derived>()) {
  derived_->breakpoints = short_breakpoints(interval, degree, unit());
  derived_->ends = is_periodic() ? EndKnots::Continued : EndKnots::Repeated;
  if (degree < 0 || degree > max_degree)
    throw InvalidInput("SplineBasis: expected a degree from 0 to " + std::to_string(max_degree) + ", found " +
                       std::to_string(degree));
  const auto has_slope = [](EndCondition c) { return c == EndCondition::Flat || c == EndCondition::Clamped; };
  if (degree < 2 && (has_slope(ends.lower) || has_slope(ends.upper)))
    throw InvalidInput("SplineBasis: expected degree >= 2 for a prescribed derivative, found degree " +
                       std::to_string(degree));
  if ((ends.upper == EndCondition::Periodic) != is_periodic())
    throw InvalidInput("SplineBasis: expected periodic conditions at both ends, found them at one");
  if (is_periodic() && (interval.cells() < 2 * degree + 1 || !interval.is_uniform()))
    throw InvalidInput("SplineBasis: expected at least " + std::to_string(2 * degree + 1) +
                       " equal cells between periodic ends, found " + std::to_string(interval.cells()) +
                       (interval.is_uniform() ? "" : " that differ"));
  if (kept() <= 0)
    throw InvalidInput("SplineBasis: expected more cells: the conditions at the ends take away " +
                       std::to_string(size() - kept()) + " of " + std::to_string(size()) + " functions");
  if (is_periodic())
    for (const auto& row : periodic_end(degree))
      for (const auto& weight : row) derived_->periodic_end.push_back(weight.convert_to<double>());
  const auto n = static_cast<std::size_t>(degree) + 1;
  for (const auto& piece : spline_pieces(short_breakpoints(interval, degree), degree, derived_->ends)) {
    const auto stored = piece.repeats
                            ? std::vector<double>(pieces_.end() - static_cast<std::ptrdiff_t>(n * n * n), pieces_.end())
                            : derivatives_of(piece);
    pieces_.insert(pieces_.end(), stored.begin(), stored.end());
  }
}

int SplineBasis::kept() const {
  return size() - images() - EndConditions::removed_at(ends_.lower) - EndConditions::removed_at(ends_.upper);
}

int SplineBasis::piece_of(int cell) const {
  const int from_end = interval_.cells() - cell;
  if (from_end <= stored_pieces_ - degree_ - 1) return stored_pieces_ - from_end;
  return std::min(cell, degree_);
}

namespace {

/// Σ_p coefficients[p][a] u^p for all functions a at once.
template <std::size_t n>
void evaluate_piece(const double* coefficients, double u, double* values) {
  std::array<double, n> sum{};
  for (std::size_t p = n; p-- > 0;)
    for (std::size_t a = 0; a < n; ++a) sum[a] = sum[a] * u + coefficients[p * n + a];
  std::copy(sum.begin(), sum.end(), values);
}

}  // namespace

SplineBasis::Local SplineBasis::at(double t, int order) const {
  const int cell = interval_.cell_of(t);
  const auto b = interval_.breakpoints().subspan(static_cast<std::size_t>(cell), 2);
  const double u = (t - b[0]) / (b[1] - b[0]);
  const std::size_t n = static_cast<std::size_t>(degree_) + 1;
  const double* c =
      pieces_.data() + (static_cast<std::size_t>(piece_of(cell)) * n + static_cast<std::size_t>(order)) * n * n;
  Local local{cell, {}};
  switch (n) {
    case 1:
      evaluate_piece<1>(c, u, local.values.data());
      break;
    case 2:
      evaluate_piece<2>(c, u, local.values.data());
      break;
    case 3:
      evaluate_piece<3>(c, u, local.values.data());
      break;
    case 4:
      evaluate_piece<4>(c, u, local.values.data());
      break;
    case 5:
      evaluate_piece<5>(c, u, local.values.data());
      break;
    default:
      evaluate_piece<6>(c, u, local.values.data());
      break;
  }
  if (!is_plain()) constrain(local);
  return local;
}

void SplineBasis::constrain(Local& local) const {
  const int last = size() - 1 - local.first;
  if (ends_.lower == EndCondition::Flat && local.first == 0) local.values[1] += local.values[0];
  if (ends_.upper == EndCondition::Flat && last == degree_)
    local.values[static_cast<std::size_t>(degree_) - 1] += local.values[static_cast<std::size_t>(degree_)];
  for (int a = 0; a <= degree_; ++a)
    if (is_removed(local.first + a)) local.values[static_cast<std::size_t>(a)] = 0;
}

std::vector<double> SplineBasis::greville() const {
  std::vector<double> result;
  for (int i = 0; i < size(); ++i) {
    double offset = 0;
    for (int k = 1; k <= degree_; ++k)
      offset += interval_.breakpoints()[static_cast<std::size_t>(std::clamp(i + k - degree_, 0, interval_.cells()))];
    result.push_back(interval_.lower() +
                     interval_.length() * (offset / (static_cast<double>(degree_) * interval_.finest_cells())));
  }
  return result;
}

BandedRows SplineBasis::subspace_restriction() const { return batten::subspace_restriction(size(), degree_, ends_); }

/// Row j needs c_j and those behind it only.
void SplineBasis::apply_periodic_end(double* c, std::ptrdiff_t stride) const {
  for (int j = 0; j < degree_; ++j) {
    double sum = 0;
    for (int k = j; k < degree_; ++k)
      sum += derived_->periodic_end[static_cast<std::size_t>(j * degree_ + k)] * c[k * stride];
    c[j * stride] = sum;
  }
}

void SplineBasis::to_unconstrained(double* c, std::ptrdiff_t stride) const {
  const std::ptrdiff_t last = size() - 1;
  if (is_periodic()) {
    apply_periodic_end(c, stride);
    return apply_periodic_end(c + last * stride, -stride);
  }
  for (int i = 0; i < EndConditions::removed_at(ends_.lower); ++i) c[i * stride] = 0;
  for (int i = 0; i < EndConditions::removed_at(ends_.upper); ++i) c[(last - i) * stride] = 0;
  if (ends_.lower == EndCondition::Flat) c[0] = c[stride];
  if (ends_.upper == EndCondition::Flat) c[last * stride] = c[(last - 1) * stride];
}

namespace {

BandedRows short_inner_products(std::span<const int> breakpoints, EndKnots ends, int degree, int r, int s) {
  const auto products = exact_inner_products(breakpoints, degree, r, s, ends);
  const int n = static_cast<int>(products.size());
  ExactRows exact{n, {}, {}};
  for (int i = 0; i < n; ++i) {
    const int from = std::max(0, i - degree), to = std::min(n - 1, i + degree);
    const auto& row = products[static_cast<std::size_t>(i)];
    exact.first.push_back(from);
    exact.entries.emplace_back(row.begin() + (from - i + degree), row.begin() + (to - i + degree + 1));
  }
  return to_doubles(exact);
}

}  // namespace

BandedRows SplineBasis::inner_products(int r, int s) const {
  const std::lock_guard lock(derived_->mutex);
  auto& brief = derived_->products[{r, s}];
  if (brief.rows == 0) brief = short_inner_products(derived_->breakpoints, derived_->ends, degree_, r, s);
  auto whole = lengthened(brief, size(), size(), 1, 1);
  whole.scale *= std::pow(unit(), 1 - r - s);
  if (is_plain()) return whole;
  return with_constrained_rows(with_constrained_columns(whole, ends_), ends_);
}

std::vector<double> SplineBasis::integrals() const {
  const auto mass = inner_products(0);
  std::vector<double> result;
  for (int i = 0; i < mass.rows; ++i) {
    const auto row = mass.row(i);
    result.push_back(mass.scale * std::accumulate(row.begin(), row.end(), 0.));
  }
  return result;
}

BandedRows SplineBasis::refinement(const SplineBasis& finer) const {
  if (finer.degree_ != degree_ || finer.interval_.cells() / 2 != interval_.cells() || finer.ends_ != ends_)
    throw InvalidInput("SplineBasis::refinement: expected the next finer basis of the same degree and ends");
  if (is_periodic()) return periodic_refinement(interval_.cells(), degree_);
  const int fine_cells = std::min(finer.interval_.cells(), 2 * (3 * degree_ + 4) + (finer.interval_.cells() & 1));
  const auto all = finer.interval_.breakpoints();
  std::vector<int> fine(all.begin(), all.begin() + fine_cells + 1), coarse;
  fine.back() = fine[static_cast<std::size_t>(fine_cells) - 1] + all.back() - all[all.size() - 2];
  for (int i = 0; i < fine_cells / 2; ++i) coarse.push_back(fine[static_cast<std::size_t>(2 * i)]);
  coarse.push_back(fine.back());
  const auto columns = exact_refinement(coarse, fine, degree_);
  ExactRows exact{fine_cells + degree_, {}, {}};  // rows of the transpose
  for (const auto& column : columns) {
    exact.first.push_back(column.first);
    exact.entries.push_back(column.weights);
  }
  const auto whole = transposed(lengthened(to_doubles(exact), size(), finer.size(), 1, 2));
  return ends_.are_free() ? whole : without_removed_rows(with_constrained_columns(whole, ends_), ends_);
}

namespace {

/// The r-th derivatives of the functions of a piece with respect to t, at its start (u = 0) or end (u = 1).
std::vector<Rational> end_derivatives(const SplinePiece& piece, int r, bool at_end) {
  std::vector<Rational> row;
  for (const auto& p : piece.coefficients) {
    Rational value = 0;
    for (std::size_t k = static_cast<std::size_t>(r); k < p.size(); ++k) {
      Rational term = p[k];
      for (int q = 0; q < r; ++q) term *= Rational(static_cast<long>(k) - q) / piece.length;
      if (at_end || k == static_cast<std::size_t>(r)) value += term;
    }
    row.push_back(value);
  }
  return row;
}

/// Half the row of the cell before a breakpoint and half that of the cell behind it, whose functions are one further
/// on.
std::vector<Rational> mean_of_limits(const std::vector<Rational>& before, const std::vector<Rational>& behind) {
  std::vector<Rational> row(before.size() + 1);
  for (std::size_t a = 0; a < before.size(); ++a) {
    row[a] += before[a] / 2;
    row[a + 1] += behind[a] / 2;
  }
  return row;
}

}  // namespace

BandedRows SplineBasis::samples(int r) const {
  const auto pieces = spline_pieces(short_breakpoints(interval_, degree_), degree_, derived_->ends);
  ExactRows exact{static_cast<int>(pieces.size()) + degree_, {}, {}};
  for (std::size_t i = 0; i <= pieces.size(); ++i) {
    const bool is_end = i == pieces.size(), jumps = r == degree_ && i > 0 && !is_end;
    const std::size_t cell = is_end || jumps ? i - 1 : i;
    auto row = end_derivatives(pieces[cell], r, cell < i);
    exact.first.push_back(static_cast<int>(cell));
    exact.entries.push_back(jumps ? mean_of_limits(row, end_derivatives(pieces[i], r, false)) : std::move(row));
  }
  trim(exact);
  const auto whole = lengthened(to_doubles(exact), interval_.cells() + 1, size(), 1, 1);
  return is_plain() ? whole : with_constrained_columns(whole, ends_);
}

BandedRows SplineBasis::differences() const {
  const auto b = short_breakpoints(interval_, degree_);
  const int cells = static_cast<int>(b.size()) - 1;
  ExactRows exact{cells + degree_, {}, {}};
  const auto knot = [&](int i) {
    const int k = std::clamp(i - degree_, 0, cells), beyond = is_periodic() ? i - degree_ - k : 0;
    return Rational(b[static_cast<std::size_t>(k)] + beyond * (b[1] - b[0]));
  };
  for (int i = 0; i + 1 < cells + degree_; ++i) {
    const Rational slope = Rational(degree_) / (knot(i + degree_ + 1) - knot(i + 1));
    exact.first.push_back(i);
    exact.entries.push_back({-slope, slope});
  }
  const auto whole = lengthened(to_doubles(exact), size() - 1, size(), 1, 1);
  return is_plain() ? whole : with_constrained_columns(whole, ends_);
}

}  // namespace batten
