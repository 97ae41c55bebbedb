// SPDX-License-Identifier: MIT
#include <batten/bases/index_box.h>
#include <batten/bases/rational_elimination.h>
#include <batten/bases/refinement_equation.h>
#include <batten/domains/errors.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace batten {
namespace {

constexpr std::size_t most_unknowns = 6000;
constexpr std::size_t most_terms = 10'000'000;  // of the equations before what is outside the support is taken away

/// The integer points of a box, numbered with the first coordinate fastest.
template <int E>
struct IntegerBox {
  Index<E> lower, upper;

  std::size_t count() const {
    std::size_t n = 1;
    for (std::size_t d = 0; d < E; ++d) n *= static_cast<std::size_t>(std::max(upper[d] - lower[d] + 1, 0));
    return n;
  }
  /// The number of a point, -1 outside.
  std::ptrdiff_t number_of(const Index<E>& i) const {
    std::ptrdiff_t number = 0;
    for (std::size_t d = E; d-- > 0;) {
      if (i[d] < lower[d] || i[d] > upper[d]) return -1;
      number = number * (upper[d] - lower[d] + 1) + (i[d] - lower[d]);
    }
    return number;
  }
  Index<E> point(std::size_t number) const {
    Index<E> i{};
    for (std::size_t d = 0; d < E; ++d) {
      const auto size = static_cast<std::size_t>(upper[d] - lower[d] + 1);
      i[d] = lower[d] + static_cast<int>(number % size);
      number /= size;
    }
    return i;
  }
};

/// The integer points of the smallest box around the support, without its upper faces for limits from the right.
template <int E>
IntegerBox<E> support_box(const RefinementEquation<E>& equation) {
  IntegerBox<E> box{};
  const int widening = equation.arity - 1;
  for (std::size_t d = 0; d < E; ++d) {
    const auto [low, high] = std::minmax_element(equation.mask.begin(), equation.mask.end(),
                                                 [d](auto& a, auto& b) { return a.first[d] < b.first[d]; });
    box.lower[d] = -floor_quotient(-low->first[d], widening);
    box.upper[d] = floor_quotient(high->first[d] - (equation.limit == Limit::FromRight ? 1 : 0), widening);
  }
  return box;
}

/// Row i of v(i) = Σ_k mask[arity i - k] v(k), as (number of k, coefficient).
using TransitionRow = std::vector<std::pair<std::size_t, Rational>>;

template <int E>
TransitionRow transition_row(const RefinementEquation<E>& equation, const IntegerBox<E>& box, const Index<E>& i) {
  TransitionRow row;
  for (const auto& [j, c] : equation.mask) {
    Index<E> k{};
    for (std::size_t d = 0; d < E; ++d) k[d] = equation.arity * i[d] - j[d];
    const std::ptrdiff_t number = box.number_of(k);
    if (number >= 0 && c != 0) row.emplace_back(static_cast<std::size_t>(number), c);
  }
  return row;
}

/// Takes the terms away that see an unknown without a row, and so on with rows that this leaves empty: they belong to
/// points of the box outside the support.
void prune(std::vector<TransitionRow>& rows) {
  const auto sees_nothing = [&](const auto& term) { return rows[term.first].empty(); };
  std::size_t taken = 1;
  while (taken > 0) {
    taken = 0;
    for (auto& row : rows) taken += std::erase_if(row, sees_nothing);
  }
}

/// All multi-indices of a degree.
template <int E>
std::vector<Index<E>> multi_indices(int degree) {
  std::vector<Index<E>> result;
  IntegerBox<E> box{};
  box.upper.fill(degree);
  for (std::size_t n = 0; n < box.count(); ++n) {
    const auto q = box.point(n);
    int total = 0;
    for (int power : q) total += power;
    if (total == degree) result.push_back(q);
  }
  return result;
}

/// (-i)^q
template <int E>
Rational reflected_power(const Index<E>& i, const Index<E>& q) {
  Integer result = 1;
  for (std::size_t d = 0; d < E; ++d)
    for (int n = 0; n < q[d]; ++n) result *= -i[d];
  return Rational(result);
}

/// P(∂) x^q for P and x^q of the same degree: P_q q!.
template <int E>
Rational derivative_of_power(const Terms<E>& P, const Index<E>& q) {
  const auto term = P.find(q);
  if (term == P.end()) return 0;
  Rational value = term->second;
  for (int power : q)
    for (int n = 2; n <= power; ++n) value *= n;
  return value;
}

template <int E>
int degree_of(const Terms<E>& P) {
  int degree = 0;
  for (int power : P.begin()->first) degree += power;
  return degree;
}

template <int E>
std::vector<ExactEquation> equations_of(const RefinementEquation<E>& equation, const std::vector<TransitionRow>& rows,
                                        const std::vector<Index<E>>& points, const std::vector<int>& unknown_of) {
  const int degree = degree_of<E>(equation.derivative);
  Rational factor = 1;
  for (int n = 0; n < degree; ++n) factor *= equation.arity;
  std::vector<ExactEquation> result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (unknown_of[i] < 0) continue;
    ExactEquation row{{{unknown_of[i], Rational(-1)}}};
    for (const auto& [k, c] : rows[i]) row.terms.emplace_back(unknown_of[k], factor * c);
    result.push_back(std::move(row));
  }
  for (const auto& q : multi_indices<E>(degree)) {
    ExactEquation moment{{}, derivative_of_power<E>(equation.derivative, q)};
    for (std::size_t n = 0; n < points.size(); ++n)
      moment.terms.emplace_back(static_cast<int>(n), reflected_power<E>(points[n], q));
    result.push_back(std::move(moment));
  }
  return result;
}

/// arity^M Σ_k mask[arity i - k] v(k) as a matrix on the points.
Eigen::SparseMatrix<double, Eigen::RowMajor> transition_matrix(const std::vector<TransitionRow>& rows,
                                                               const std::vector<int>& unknown_of, double factor) {
  std::vector<Eigen::Triplet<double>> entries;
  int count = 0;
  for (const auto& row : rows) {
    if (row.empty()) continue;
    for (const auto& [k, c] : row) entries.emplace_back(count, unknown_of[k], factor * static_cast<double>(c));
    ++count;
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> A(count, count);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// An orthonormal basis of the polynomials up to a degree on the points.
template <int E>
Eigen::MatrixXd polynomials(const std::vector<Index<E>>& points, int degree) {
  std::vector<Index<E>> powers;
  for (int d = 0; d <= degree; ++d) std::ranges::copy(multi_indices<E>(d), std::back_inserter(powers));
  const auto rows = static_cast<Eigen::Index>(points.size()), columns = static_cast<Eigen::Index>(powers.size());
  Eigen::MatrixXd V(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index q = 0; q < columns; ++q)
      V(i, q) = static_cast<double>(
          reflected_power<E>(points[static_cast<std::size_t>(i)], powers[static_cast<std::size_t>(q)]));
  return V.householderQr().householderQ() * Eigen::MatrixXd::Identity(rows, std::min(rows, columns));
}

/// Whether A makes vectors small whose moments up to the derivative's degree vanish, as it does where the derivative is
/// continuous and the scheme converges. In doubles, on one vector without structure; eigenvalues above 0.998 count
/// as 1.
bool contracts(const Eigen::SparseMatrix<double, Eigen::RowMajor>& A, const Eigen::MatrixXd& Q) {
  constexpr int most_rounds = 5000;
  constexpr double small = 1e-4, large = 1e6;
  const auto without_moments = [&](const Eigen::VectorXd& v) { return Eigen::VectorXd(v - Q * (Q.transpose() * v)); };
  Eigen::VectorXd w(A.rows());
  for (Eigen::Index i = 0; i < w.size(); ++i)
    w[i] = std::fmod(0.6180339887 * static_cast<double>(i + 1), 1) - 0.5;  // spread over (-1/2, 1/2)
  w = without_moments(w);
  const double start = w.norm();
  if (start <= 1e-12) return true;  // there are no such vectors
  for (int round = 0; round < most_rounds && w.norm() < large * start; ++round) {
    if (w.norm() <= small * start) return true;
    w = without_moments(A * w);  // A keeps the moments at zero; rounding does not
  }
  return false;
}

void require_solvable_size(std::size_t unknowns) {
  if (unknowns > most_unknowns)
    throw InvalidInput("integer_values: at most " + std::to_string(most_unknowns) +
                       " values of a refinement equation can be found, found a support with " +
                       std::to_string(unknowns));
}

}  // namespace

template <int E>
std::optional<Terms<E>> integer_values(const RefinementEquation<E>& equation) {
  if (equation.mask.empty()) return std::nullopt;
  const auto box = support_box(equation);
  std::size_t residues = 1;
  for (int d = 0; d < E; ++d) residues *= static_cast<std::size_t>(equation.arity);
  if (box.count() * equation.mask.size() / residues > most_terms) require_solvable_size(box.count());
  std::vector<TransitionRow> rows;
  for (std::size_t i = 0; i < box.count(); ++i) rows.push_back(transition_row(equation, box, box.point(i)));
  prune(rows);
  std::vector<int> unknown_of(rows.size(), -1);
  std::vector<Index<E>> points;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].empty()) continue;
    unknown_of[i] = static_cast<int>(points.size());
    points.push_back(box.point(i));
  }
  require_solvable_size(points.size());
  const auto v = unique_solution(equations_of(equation, rows, points, unknown_of), static_cast<int>(points.size()));
  const int degree = degree_of<E>(equation.derivative);
  if (!v ||
      !contracts(transition_matrix(rows, unknown_of, std::pow(equation.arity, degree)), polynomials<E>(points, degree)))
    return std::nullopt;
  Terms<E> values;
  for (std::size_t n = 0; n < points.size(); ++n)
    if ((*v)[n] != 0) values.emplace(points[n], (*v)[n]);
  return values;
}

template <int D>
Terms<D> terms_of(const LaurentPolynomial<Rational, D>& s) {
  Terms<D> terms;
  if (s.is_zero()) return terms;
  const IntegerBox<D> box{s.first(), s.last()};
  for (std::size_t n = 0; n < box.count(); ++n)
    if (s.coefficients()[n] != 0) terms.emplace(box.point(n), s.coefficients()[n]);
  return terms;
}

template <int D>
LaurentPolynomial<Rational, D> polynomial_of(const Terms<D>& terms, const Index<D>& half) {
  if (terms.empty()) return {};
  IntegerBox<D> box{terms.begin()->first, terms.begin()->first};
  for (const auto& term : terms)
    for (std::size_t d = 0; d < D; ++d) {
      box.lower[d] = std::min(box.lower[d], term.first[d]);
      box.upper[d] = std::max(box.upper[d], term.first[d]);
    }
  std::vector<Rational> coefficients(box.count());
  for (const auto& [i, c] : terms) coefficients[static_cast<std::size_t>(box.number_of(i))] = c;
  Index<D> size{};
  for (std::size_t d = 0; d < D; ++d) size[d] = box.upper[d] - box.lower[d] + 1;
  return {box.lower, size, std::move(coefficients), half};
}

template <int E>
Terms<E> product(const Terms<E>& a, const Terms<E>& b) {
  Terms<E> result;
  for (const auto& [i, x] : a)
    for (const auto& [j, y] : b) {
      Index<E> k = i;
      for (std::size_t d = 0; d < E; ++d) k[d] += j[d];
      result[k] += x * y;
    }
  std::erase_if(result, [](const auto& term) { return term.second == 0; });
  return result;
}

template std::optional<Terms<1>> integer_values(const RefinementEquation<1>&);
template std::optional<Terms<2>> integer_values(const RefinementEquation<2>&);
template std::optional<Terms<4>> integer_values(const RefinementEquation<4>&);
template Terms<1> terms_of(const Mask<Rational>&);
template Terms<2> terms_of(const Mask2<Rational>&);
template Mask<Rational> polynomial_of<1>(const Terms<1>&, const Index<1>&);
template Mask2<Rational> polynomial_of<2>(const Terms<2>&, const Index<2>&);
template Terms<1> product<1>(const Terms<1>&, const Terms<1>&);
template Terms<2> product<2>(const Terms<2>&, const Terms<2>&);
template Terms<4> product<4>(const Terms<4>&, const Terms<4>&);

}  // namespace batten
