// SPDX-License-Identifier: MIT
#include <batten/bases/difference_scheme.h>
#include <batten/bases/exact_linear_program.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/matrix_difference_scheme.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

/// The linear program of one row: unknowns are the coefficients of A_j on a box each, equations those of the product on
/// the box that holds all of it.
class RowProgram {
public:
  RowProgram(const Mask2<Rational>& c, int order, int margin) : c_(c), operators_(difference_operators<2>(order)) {
    first_ = {c.first()[0] - margin, c.first()[1] - margin};
    size_ = {c.size()[0] + 2 * margin, c.size()[1] + 2 * margin};
    for (int j = 0; j <= order; ++j)
      for (int y = 0; y < size_[1] - j; ++y)
        for (int x = 0; x < size_[0] - (order - j); ++x) unknowns_.push_back({j, {x, y}});
  }

  /// The coefficients are x - x' with x, x' >= 0.
  std::vector<Mask2<Rational>> solution() const {
    LinearProgram program;
    program.costs.assign(2 * unknowns_.size(), 1);
    for (const Rational& right : right_side()) program.equations.push_back({{}, right});
    for (std::size_t u = 0; u < unknowns_.size(); ++u)
      for_terms(unknowns_[u], [&](int equation, const Rational& value) {
        auto& terms = program.equations[static_cast<std::size_t>(equation)].terms;
        terms.emplace_back(static_cast<int>(2 * u), value);
        terms.emplace_back(static_cast<int>(2 * u + 1), -value);
      });
    const std::vector<Rational> found = solved(program);
    std::vector<Mask2<Rational>> row(operators_.size());
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      const Index<2> at = {first_[0] + unknowns_[u].at[0], first_[1] + unknowns_[u].at[1]};
      const Rational value = found[2 * u] - found[2 * u + 1];
      if (value != 0)
        row[static_cast<std::size_t>(unknowns_[u].operator_index)] += Mask2<Rational>::monomial(at, value);
    }
    return row;
  }

private:
  static std::vector<Rational> solved(const LinearProgram& program) {
    try {
      return nearly_optimal_values(program);
    } catch (const SolverError& error) {
      throw InvalidInput(
          "matrix_difference_scheme: the sum rules of this order and a support that holds the scheme are "
          "needed, found no combination of differences (" +
          std::string(error.what()) + ")");
    }
  }

  struct Unknown {
    int operator_index;
    Index<2> at;
  };

  int equations() const { return size_[0] * size_[1]; }

  /// Calls work(equation, coefficient) for x^at times the operator.
  template <std::invocable<int, const Rational&> Work>
  void for_terms(const Unknown& unknown, Work&& work) const {
    const auto& op = operators_[static_cast<std::size_t>(unknown.operator_index)];
    for (int y = 0; y < op.size()[1]; ++y)
      for (int x = 0; x < op.size()[0]; ++x) work(unknown.at[0] + x + size_[0] * (unknown.at[1] + y), op[{x, y}]);
  }

  std::vector<Rational> right_side() const {
    std::vector<Rational> right;
    for (int k = 0; k < equations(); ++k) right.push_back(c_[{first_[0] + k % size_[0], first_[1] + k / size_[0]}]);
    return right;
  }

  const Mask2<Rational>& c_;
  std::vector<Mask2<Rational>> operators_;
  Index<2> first_{}, size_{};
  std::vector<Unknown> unknowns_;
};

MaskMatrix<Rational, 2> least_scheme(const Mask2<Rational>& scaled, const MatrixDifferenceOptions& options,
                                     int coarse) {
  const auto operators = difference_operators<2>(options.order);
  MaskMatrix<Rational, 2> t(options.order + 1, options.order + 1);
  for (int i = 0; i <= options.order; ++i) {
    const auto product = operators[static_cast<std::size_t>(i)] * scaled;
    for (int k = 0; k < coarse * coarse; ++k) {
      const Index<2> residue = {k % coarse, k / coarse};
      const auto row = least_difference_row(coset(product, residue, coarse), options.order, options.margin);
      for (int j = 0; j <= options.order; ++j)
        t(i, j) += shifted(upsampled(row[static_cast<std::size_t>(j)], coarse), residue);
    }
  }
  return t;
}

}  // namespace

template <int D>
MaskMatrix<Rational, D> matrix_difference_scheme(const LaurentPolynomial<Rational, D>& s,
                                                 const MatrixDifferenceOptions& options, int arity) {
  if (options.order < 1 || options.steps < 1 || options.margin < 0)
    throw InvalidInput("matrix_difference_scheme: order and steps must be at least 1 and the margin not negative");
  if constexpr (D == 1) {
    return MaskMatrix<Rational, 1>(1, 1, {iterated(difference_scheme(s, options.order, arity), options.steps, arity)});
  } else {
    auto scaled = iterated(without_half_shift(s), options.steps, arity);
    int coarse = 1;
    for (int n = 0; n < options.steps; ++n) coarse *= arity;
    for (int n = 1; n < options.order; ++n) scaled *= Rational(coarse);
    return least_scheme(scaled, options, coarse);
  }
}

std::vector<Mask2<Rational>> least_difference_row(const Mask2<Rational>& c, int order, int margin) {
  if (c.is_zero()) return std::vector<Mask2<Rational>>(static_cast<std::size_t>(order) + 1);
  return RowProgram(c, order, margin).solution();
}

MaskMatrix<Rational, 2> factored_difference_scheme(const Mask2<Rational>& s, int arity) {
  const auto all = std::vector<Rational>(static_cast<std::size_t>(arity), 1);
  const Mask2<Rational> along_x({0, 0}, {arity, 1}, all), along_y({0, 0}, {1, arity}, all);
  const auto mask = without_half_shift(s);
  return {2, 2, {exact_quotient(mask, along_x), {}, {}, exact_quotient(mask, along_y)}};
}

template MaskMatrix<Rational, 1> matrix_difference_scheme(const Mask<Rational>&, const MatrixDifferenceOptions&, int);
template MaskMatrix<Rational, 2> matrix_difference_scheme(const Mask2<Rational>&, const MatrixDifferenceOptions&, int);

}  // namespace batten
