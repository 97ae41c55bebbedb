// SPDX-License-Identifier: MIT
#include <batten/bases/difference_scheme.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace batten {
namespace {

/// T over a common denominator, coefficient by coefficient, so that T_n is found in integers.
template <class Whole>
struct Term {
  Index<2> at;
  Whole value;
};
template <class Whole>
using Entry = std::vector<Term<Whole>>;

/// A dense block of integers, the entry of T_n.
template <class Whole>
struct Block {
  Index<2> first{}, size{};
  std::vector<Whole> values;
};

template <class Whole>
Whole magnitude(const Whole& x) {
  return x < 0 ? Whole(-x) : x;
}

template <int D>
Integer common_denominator(const MaskMatrix<Rational, D>& t) {
  Integer common = 1;
  for (int i = 0; i < t.rows(); ++i)
    for (int j = 0; j < t.columns(); ++j)
      for (const Rational& c : t(i, j).coefficients()) common = lcm(common, Integer(denominator(c)));
  return common;
}

template <class Whole, int D>
Entry<Whole> terms_of(const LaurentPolynomial<Rational, D>& p, const Integer& scale) {
  Entry<Whole> terms;
  const int row = std::max(p.size()[0], 1);
  for (int k = 0; k < static_cast<int>(p.coefficients().size()); ++k) {
    const Rational c = p.coefficients()[static_cast<std::size_t>(k)] * scale;
    Index<2> at{p.first()[0] + k % row, k / row};
    if constexpr (D == 2) at[1] += p.first()[1];
    if (c != 0) terms.push_back({at, static_cast<Whole>(Integer(numerator(c)))});
  }
  return terms;
}

/// The product of the entries of one row of T_(n-1) with a column of T[x^step], added up.
template <class Whole>
Block<Whole> row_times_column(const std::vector<Block<Whole>>& row, const std::vector<const Entry<Whole>*>& column,
                              int step) {
  std::optional<Index<2>> low;
  Index<2> high{};
  for (std::size_t k = 0; k < row.size(); ++k)
    for (const auto& term : *column[k])
      for (std::size_t d = 0; d < 2; ++d) {
        if (row[k].values.empty()) continue;
        const int a = row[k].first[d] + step * term.at[d], b = a + row[k].size[d];
        if (!low) low = high = {row[k].first[0] + step * term.at[0], row[k].first[1] + step * term.at[1]};
        (*low)[d] = std::min((*low)[d], a);
        high[d] = std::max(high[d], b);
      }
  if (!low) return {};
  Block<Whole> sum{*low, {high[0] - (*low)[0], high[1] - (*low)[1]}, {}};
  sum.values.resize(static_cast<std::size_t>(sum.size[0]) * static_cast<std::size_t>(sum.size[1]));
  const auto add_shifted = [&](const Block<Whole>& block, const Term<Whole>& term) {
    for (int y = 0; y < block.size[1]; ++y) {
      const auto from = static_cast<std::size_t>(y) * static_cast<std::size_t>(block.size[0]);
      const auto to = static_cast<std::size_t>(block.first[0] + step * term.at[0] - sum.first[0]) +
                      static_cast<std::size_t>(block.first[1] + y + step * term.at[1] - sum.first[1]) *
                          static_cast<std::size_t>(sum.size[0]);
      for (std::size_t x = 0; x < static_cast<std::size_t>(block.size[0]); ++x)
        sum.values[to + x] += term.value * block.values[from + x];
    }
  };
  for (std::size_t k = 0; k < row.size(); ++k)
    for (const auto& term : *column[k])
      if (!row[k].values.empty()) add_shifted(row[k], term);
  return sum;
}

/// The powers of T, one by one.
template <class Whole, int D>
class IteratedRows {
public:
  IteratedRows(const MaskMatrix<Rational, D>& t, const Integer& scale, int arity) : arity_(arity), size_(t.rows()) {
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j) {
        entries_.push_back(terms_of<Whole>(t(i, j), scale));
        blocks_.push_back(i == j ? Block<Whole>{{0, 0}, {1, 1}, {Whole(1)}} : Block<Whole>{});
      }
  }

  void advance() {
    std::vector<Block<Whole>> next;
    for (int i = 0; i < size_; ++i) {
      const std::vector<Block<Whole>> row(blocks_.begin() + i * size_, blocks_.begin() + (i + 1) * size_);
      for (int j = 0; j < size_; ++j) {
        std::vector<const Entry<Whole>*> column;
        for (int k = 0; k < size_; ++k) column.push_back(&entries_[static_cast<std::size_t>(k * size_ + j)]);
        next.push_back(row_times_column(row, column, step_));
      }
    }
    blocks_ = std::move(next);
    step_ *= arity_;
  }

  /// The largest absolute row sum, in units of the scale's power.
  Whole norm() const {
    Whole most = 0;
    for (int i = 0; i < size_; ++i) {
      std::vector<Whole> sums(static_cast<std::size_t>(step_) * static_cast<std::size_t>(D == 1 ? 1 : step_));
      for (int j = 0; j < size_; ++j) add_magnitudes(blocks_[static_cast<std::size_t>(i * size_ + j)], sums);
      for (const Whole& s : sums) most = std::max(most, s);
    }
    return most;
  }

private:
  std::size_t residue(int i) const { return static_cast<std::size_t>(((i % step_) + step_) % step_); }

  void add_magnitudes(const Block<Whole>& block, std::vector<Whole>& sums) const {
    for (std::size_t k = 0; k < block.values.size(); ++k) {
      const int row = block.size[0], x = block.first[0] + static_cast<int>(k) % row,
                y = block.first[1] + static_cast<int>(k) / row;
      const std::size_t place = residue(x) + (D == 1 ? 0 : residue(y) * static_cast<std::size_t>(step_));
      sums[place] += magnitude(block.values[k]);
    }
  }

  int arity_, size_, step_ = 1;
  std::vector<Entry<Whole>> entries_;
  std::vector<Block<Whole>> blocks_;
};

template <class Whole, int D>
std::vector<Rational> norms(const MaskMatrix<Rational, D>& t, const Integer& scale, int most, int arity,
                            bool stop_below_one) {
  IteratedRows<Whole, D> rows(t, scale, arity);
  std::vector<Rational> found = {1};
  Integer unit = 1;
  for (int n = 1; n <= most; ++n) {
    rows.advance();
    unit *= scale;
    found.push_back(Rational(Integer(rows.norm())) / unit);
    if (stop_below_one && found.back() < 1) break;
  }
  return found;
}

/// ‖T^n‖, n = 0, 1, ... : in 64-bit integers while no sum can leave them, in long integers otherwise.
template <int D>
std::vector<Rational> norms_of_powers(const MaskMatrix<Rational, D>& t, int most, int arity, bool stop_below_one) {
  if (t.rows() != t.columns())
    throw InvalidInput("iterated_norm: the matrix must be square, found " + std::to_string(t.rows()) + " x " +
                       std::to_string(t.columns()));
  if (most < 0) throw InvalidInput("iterated_norm: n must not be negative, found " + std::to_string(most));
  const Integer scale = common_denominator(t);
  Integer largest = 1;
  for (int i = 0; i < t.rows(); ++i) {
    Rational row = 0;
    for (int j = 0; j < t.columns(); ++j) row += absolute_sum(t(i, j)) * scale;
    largest = std::max(largest, Integer(numerator(row)));
  }
  Integer bound = 1;
  for (int n = 0; n < most; ++n) bound *= largest;
  if (bound < Integer(INT64_MAX)) return norms<std::int64_t>(t, scale, most, arity, stop_below_one);
  return norms<Integer>(t, scale, most, arity, stop_below_one);
}

}  // namespace

Mask<Rational> difference_scheme(const Mask<Rational>& s, int order, int arity) {
  if (order < 1) throw InvalidInput("difference_scheme: the order must be at least 1, found " + std::to_string(order));
  const Mask<Rational> smoothing(0, std::vector<Rational>(static_cast<std::size_t>(arity), 1));
  Mask<Rational> t = exact_quotient(without_half_shift(s), power(smoothing, order));
  for (int n = 1; n < order; ++n) t *= Rational(arity);
  return t;
}

template <int D>
std::vector<LaurentPolynomial<Rational, D>> difference_operators(int order) {
  if constexpr (D == 1) {
    return {power(Mask<Rational>(0, {1, -1}), order)};
  } else {
    const Mask<Rational> difference(0, {1, -1});
    std::vector<Mask2<Rational>> operators;
    for (int j = 0; j <= order; ++j)
      operators.push_back(tensor_product(power(difference, order - j), power(difference, j)));
    return operators;
  }
}

template <int D>
bool is_difference_scheme(const MaskMatrix<Rational, D>& t, const LaurentPolynomial<Rational, D>& s, int order,
                          int steps, int arity) {
  const auto operators = difference_operators<D>(order);
  const int size = static_cast<int>(operators.size());
  if (t.rows() != size || t.columns() != size) return false;
  LaurentPolynomial<Rational, D> scaled = iterated(without_half_shift(s), steps, arity);
  int coarse = 1;
  for (int n = 0; n < steps; ++n) coarse *= arity;
  for (int n = 1; n < order; ++n) scaled *= Rational(coarse);
  std::vector<LaurentPolynomial<Rational, D>> upsampled_operators;
  for (const auto& op : operators) upsampled_operators.push_back(upsampled(op, coarse));
  const auto right = applied(t, upsampled_operators);
  for (std::size_t i = 0; i < operators.size(); ++i)
    if (operators[i] * scaled != right[i]) return false;
  return true;
}

template <int D>
Rational iterated_norm(const MaskMatrix<Rational, D>& t, int n, int arity) {
  return norms_of_powers(t, n, arity, false).back();
}

Rational iterated_norm(const Mask<Rational>& t, int n, int arity) {
  return iterated_norm(MaskMatrix<Rational, 1>(1, 1, {t}), n, arity);
}

template <int D>
std::vector<Rational> norms_until_contraction(const MaskMatrix<Rational, D>& t, int most, int arity) {
  auto found = norms_of_powers(t, most, arity, true);
  found.erase(found.begin());  // ‖T^0‖
  return found;
}

template <int D>
LaurentPolynomial<Rational, D> without_half_shift(const LaurentPolynomial<Rational, D>& s) {
  return {s.first(), s.size(), std::vector<Rational>(s.coefficients().begin(), s.coefficients().end())};
}

template std::vector<Mask<Rational>> difference_operators<1>(int);
template std::vector<Mask2<Rational>> difference_operators<2>(int);
template bool is_difference_scheme(const MaskMatrix<Rational, 1>&, const Mask<Rational>&, int, int, int);
template bool is_difference_scheme(const MaskMatrix<Rational, 2>&, const Mask2<Rational>&, int, int, int);
template Rational iterated_norm(const MaskMatrix<Rational, 1>&, int, int);
template Rational iterated_norm(const MaskMatrix<Rational, 2>&, int, int);
template std::vector<Rational> norms_until_contraction(const MaskMatrix<Rational, 1>&, int, int);
template std::vector<Rational> norms_until_contraction(const MaskMatrix<Rational, 2>&, int, int);
template Mask<Rational> without_half_shift(const Mask<Rational>&);
template Mask2<Rational> without_half_shift(const Mask2<Rational>&);

}  // namespace batten
