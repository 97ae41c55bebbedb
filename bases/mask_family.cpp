// SPDX-License-Identifier: MIT
#include <batten/bases/derivative_mask.h>
#include <batten/bases/mask_family.h>
#include <batten/bases/mask_text.h>
#include <batten/domains/errors.h>

#include <algorithm>

namespace batten {
namespace {

std::vector<Index<2>> images(const Index<2>& i, MaskSymmetry symmetry) {
  const auto [x, y] = i;
  switch (symmetry) {
    case MaskSymmetry::Square:
      return {i, {-x, y}, {x, -y}, {-x, -y}, {y, x}, {-y, x}, {y, -x}, {-y, -x}};
    case MaskSymmetry::Rectangle:
      return {i, {-x, y}, {x, -y}, {-x, -y}};
    case MaskSymmetry::Point:
      return {i, {-x, -y}};
    case MaskSymmetry::None:
      break;
  }
  return {i};
}

/// Without repetitions, the first one kept in front.
std::vector<Index<2>> orbit_of(const Index<2>& i, MaskSymmetry symmetry) {
  std::vector<Index<2>> orbit;
  for (const Index<2>& image : images(i, symmetry))
    if (std::find(orbit.begin(), orbit.end(), image) == orbit.end()) orbit.push_back(image);
  return orbit;
}

bool is_inside(const Index<2>& i, int half, MaskShape shape) {
  const int x = std::abs(i[0]), y = std::abs(i[1]);
  if (shape == MaskShape::Disc) return x * x + y * y <= half * half;
  if (shape == MaskShape::Diamond) return x + y <= half;
  return std::max(x, y) <= half;
}

/// Σ s[i,j] x^i y^j i^a j^b at x, y = ±1, a combination of derivatives of order <= a + b.
ExactEquation moment(const MaskFamily& family, const Index<2>& at, const Index<2>& order, const Rational& right) {
  ExactEquation equation{{}, right};
  for (int u = 0; u < family.unknowns(); ++u) {
    Rational factor = 0;
    for (const auto& [i, j] : family.orbit(u)) {
      const int sign = ((at[0] < 0 && i % 2 != 0) != (at[1] < 0 && j % 2 != 0)) ? -1 : 1;
      factor += sign * integer_power(i, order[0]) * integer_power(j, order[1]);
    }
    if (factor != 0) equation.terms.emplace_back(u, factor);
  }
  return equation;
}

void append_zero(std::vector<NamedEquation>& all, const MaskFamily& family, const PrescribedZero& zero,
                 const std::string& name) {
  for (int degree = 0; degree < zero.order; ++degree)
    for (int b = 0; b <= degree; ++b)
      all.push_back({name + ": the derivative " + index_text<2>({degree - b, b}) + " at " + index_text<2>(zero.at) +
                         " must vanish",
                     moment(family, zero.at, {degree - b, b}, 0)});
}

std::vector<NamedEquation> wanted_equations(const MaskFamily& family, const MaskConstraints& constraints) {
  std::vector<NamedEquation> all;
  if (constraints.precision) {
    const std::string name = "precision " + std::to_string(*constraints.precision);
    if (*constraints.precision < 0)
      throw InvalidInput("independent_equations: the precision must be at least 0, found " + name.substr(10));
    all.push_back({name + ": the coefficients must sum to 4", moment(family, {1, 1}, {0, 0}, 4)});
    for (const Index<2>& at : {Index<2>{-1, 1}, Index<2>{1, -1}, Index<2>{-1, -1}})
      append_zero(all, family, {at, *constraints.precision + 1}, name);
  }
  for (const PrescribedZero& zero : constraints.zeros) {
    if (std::abs(zero.at[0]) != 1 || std::abs(zero.at[1]) != 1)
      throw InvalidInput("independent_equations: zeros must be prescribed at (±1, ±1), found " +
                         index_text<2>(zero.at));
    append_zero(all, family, zero, "zero of order " + std::to_string(zero.order) + " at " + index_text<2>(zero.at));
  }
  return all;
}

/// Equations in echelon form; a row holds the factors and the right side.
class Echelon {
public:
  explicit Echelon(int unknowns) : unknowns_(static_cast<std::size_t>(unknowns)) {}

  enum class Verdict { New, Follows, Contradicts };
  Verdict add(const ExactEquation& equation) {
    std::vector<Rational> row(unknowns_ + 1);
    for (const auto& [unknown, factor] : equation.terms) row[static_cast<std::size_t>(unknown)] += factor;
    row.back() = equation.right;
    for (std::size_t k = 0; k < rows_.size(); ++k) subtract(row, rows_[k], pivots_[k]);
    const auto pivot = std::find_if(row.begin(), row.end() - 1, [](const Rational& a) { return a != 0; });
    if (pivot == row.end() - 1) return row.back() == 0 ? Verdict::Follows : Verdict::Contradicts;
    pivots_.push_back(static_cast<std::size_t>(pivot - row.begin()));
    rows_.push_back(std::move(row));
    return Verdict::New;
  }

private:
  static void subtract(std::vector<Rational>& row, const std::vector<Rational>& other, std::size_t pivot) {
    if (row[pivot] == 0) return;
    const Rational factor = row[pivot] / other[pivot];
    for (std::size_t k = 0; k < row.size(); ++k)
      if (other[k] != 0) row[k] -= factor * other[k];
  }

  std::size_t unknowns_;
  std::vector<std::vector<Rational>> rows_;
  std::vector<std::size_t> pivots_;
};

}  // namespace

MaskFamily::MaskFamily(int size, MaskSymmetry symmetry, MaskShape shape, int smallest) : half_((size - 1) / 2) {
  if (size % 2 == 0 || size < smallest)
    throw InvalidInput("MaskFamily: the size must be odd and at least " + std::to_string(smallest) + ", found " +
                       std::to_string(size));
  unknown_of_place_.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), -1);
  for (int y = 0; y <= 2 * half_; ++y)
    for (int x = 0; x <= 2 * half_; ++x) {
      const Index<2> i = {half_ - x, half_ - y};  // representatives with positive coordinates
      if (!is_inside(i, half_, shape) || unknown_of_place_[place(i)] >= 0) continue;
      for (const Index<2>& image : orbits_.emplace_back(orbit_of(i, symmetry)))
        unknown_of_place_[place(image)] = unknowns() - 1;
    }
}

std::size_t MaskFamily::place(const Index<2>& i) const {
  return static_cast<std::size_t>(i[0] + half_) +
         static_cast<std::size_t>(i[1] + half_) * static_cast<std::size_t>(2 * half_ + 1);
}

std::optional<int> MaskFamily::unknown_at(const Index<2>& i) const {
  if (std::max(std::abs(i[0]), std::abs(i[1])) > half_) return std::nullopt;
  const int unknown = unknown_of_place_[place(i)];
  return unknown < 0 ? std::nullopt : std::optional(unknown);
}

Mask2<Rational> MaskFamily::mask(std::span<const Rational> values) const {
  if (values.size() != orbits_.size())
    throw InvalidInput("MaskFamily::mask: " + std::to_string(unknowns()) + " values are needed, found " +
                       std::to_string(values.size()));
  std::vector<Rational> coefficients(unknown_of_place_.size());
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    if (unknown_of_place_[k] >= 0) coefficients[k] = values[static_cast<std::size_t>(unknown_of_place_[k])];
  return {{-half_, -half_}, {2 * half_ + 1, 2 * half_ + 1}, std::move(coefficients)};
}

std::vector<NamedEquation> independent_equations(const MaskFamily& family, const MaskConstraints& constraints) {
  std::vector<NamedEquation> kept;
  Echelon echelon(family.unknowns());
  for (NamedEquation& candidate : wanted_equations(family, constraints)) {
    const auto verdict = echelon.add(candidate.equation);
    if (verdict == Echelon::Verdict::Contradicts)
      throw InvalidInput("independent_equations: no mask of this size, shape and symmetry satisfies the constraint \"" +
                         candidate.name + "\" together with those before it");
    if (verdict == Echelon::Verdict::New) kept.push_back(std::move(candidate));
  }
  return kept;
}

}  // namespace batten
