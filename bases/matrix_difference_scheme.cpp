// SPDX-License-Identifier: MIT
#include <batten/bases/difference_scheme.h>
#include <batten/bases/exact_linear.h>
#include <batten/bases/least_absolute_sum.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/matrix_difference_scheme.h>
#include <batten/domains/errors.h>

#include <algorithm>

namespace batten {
namespace {

constexpr double cost_of_a_gap = 1e4;  // of what is left of c: none is left when there is a solution

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

  std::vector<Mask2<Rational>> solution() const {
    const int gaps = equations();
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(gaps, gaps + static_cast<int>(unknowns_.size()));
    Eigen::VectorXd b(gaps), costs = Eigen::VectorXd::Ones(a.cols());
    costs.head(gaps).setConstant(cost_of_a_gap);
    const std::vector<Rational> right = right_side();
    for (int i = 0; i < gaps; ++i) {
      a(i, i) = 1;
      b[i] = static_cast<double>(right[static_cast<std::size_t>(i)]);
    }
    for (std::size_t u = 0; u < unknowns_.size(); ++u)
      for_terms(unknowns_[u], [&](int equation, const Rational& value) {
        a(equation, gaps + static_cast<int>(u)) = static_cast<double>(value);
      });
    return exact(least_absolute_sum(a, b, costs).basis, right);
  }

private:
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

  /// Solves the equations for the unknowns of the basis in rationals.
  std::vector<Mask2<Rational>> exact(const std::vector<int>& basis, const std::vector<Rational>& right) const {
    std::vector<int> chosen;
    for (int k : basis)
      if (k >= equations()) chosen.push_back(k - equations());
    const int last = static_cast<int>(chosen.size());
    RationalMatrix system(equations(), last + 1);
    for (int k = 0; k < last; ++k)
      for_terms(unknowns_[static_cast<std::size_t>(chosen[static_cast<std::size_t>(k)])],
                [&](int equation, const Rational& value) { system(equation, k) = value; });
    for (int i = 0; i < equations(); ++i) system(i, last) = right[static_cast<std::size_t>(i)];
    const EchelonForm form = echelon_form(std::move(system));
    if (!form.pivots.empty() && form.pivots.back() == last)
      throw InvalidInput(
          "matrix_difference_scheme: the sum rules of this order and a support that holds the scheme are "
          "needed, found no combination of differences for " +
          to_string(c_));
    std::vector<Mask2<Rational>> row(operators_.size());
    for (std::size_t i = 0; i < form.pivots.size(); ++i) {
      const int k = chosen[static_cast<std::size_t>(form.pivots[i])];
      const Unknown& unknown = unknowns_[static_cast<std::size_t>(k)];
      const Index<2> at = {first_[0] + unknown.at[0], first_[1] + unknown.at[1]};
      row[static_cast<std::size_t>(unknown.operator_index)] +=
          Mask2<Rational>::monomial(at, form.rows(static_cast<int>(i), last));
    }
    return row;
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
