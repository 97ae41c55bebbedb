// SPDX-License-Identifier: MIT
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/scheme.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr int checked_levels = 8;

Rational tolerance_of(const Rational&) { return 0; }
double tolerance_of(double magnitude) { return 64 * std::numeric_limits<double>::epsilon() * magnitude; }

/// Whether a equals b, to 64 ε magnitude over doubles.
template <Coefficient T>
bool agrees(const T& a, const T& b, const T& magnitude) {
  using std::abs;
  return T(abs(a - b)) <= tolerance_of(magnitude);
}

template <int D>
int grid_factor(int arity) {
  return D == 1 ? arity : arity * arity;
}

template <Coefficient T>
std::string number_text(const T& x) {
  return to_string(Mask<T>::constant(x));
}

template <Coefficient T, int D>
void require_mask(const std::string& name, const LaurentPolynomial<T, D>& mask, int arity) {
  if (arity != 2 && arity != 3)
    throw InvalidInput("SubdivisionScheme " + name + ": the arity must be 2 or 3, found " + std::to_string(arity));
  const int expected = grid_factor<D>(arity);
  if (!agrees<T>(sum(mask), T(expected), absolute_sum(mask)))
    throw InvalidInput("SubdivisionScheme " + name + ": the coefficients of the mask must sum to " +
                       std::to_string(expected) + ", found " + number_text<T>(sum(mask)));
}

template <Coefficient T, int D>
bool keeps_old_points(const LaurentPolynomial<T, D>& mask, int arity) {
  if (mask.half() != Index<D>{}) return false;
  const auto kept = coset(mask, Index<D>{}, arity) - LaurentPolynomial<T, D>::constant(T(1));
  return std::all_of(kept.coefficients().begin(), kept.coefficients().end(),
                     [](const T& c) { return agrees<T>(c, T(0), T(1)); });
}

template <Coefficient T, int D>
void require_cosets_sum_to_one(const std::string& name, const LaurentPolynomial<T, D>& mask, int arity) {
  for (int k = 0; k < grid_factor<D>(arity); ++k) {
    Index<D> residue{};
    for (std::size_t d = 0; d < D; ++d) residue[d] = d == 0 ? k % arity : k / arity;
    const T found = sum(coset(mask, residue, arity));
    if (!agrees<T>(found, T(1), absolute_sum(mask)))
      throw InvalidInput("require_affine_invariance: every coset of the mask must sum to 1, found that coset " +
                         index_text<D>(residue) + " of " + name + " sums to " + number_text<T>(found));
  }
}

/// The power of x, possibly a half one, that centres a mask.
template <int D>
LaurentPolynomial<double, D> centring_power(const LaurentPolynomial<double, D>& mask) {
  const auto middle = centred(mask);
  Index<D> exponent{}, half{};
  for (std::size_t d = 0; d < D; ++d) {
    const int twice = 2 * (middle.first()[d] - mask.first()[d]) + middle.half()[d] - mask.half()[d];
    half[d] = twice & 1;
    exponent[d] = (twice - half[d]) / 2;
  }
  return LaurentPolynomial<double, D>::monomial(exponent, 1, half);
}

/// The product of two B-splines is a box spline.
SplineStructure<2> product_structure(const Scheme& a, const Scheme& b) {
  SplineStructure<2> structure;
  if (a.structure().directions.empty() || b.structure().directions.empty()) return structure;
  for (const auto& d : a.structure().directions) structure.directions.push_back({d[0], 0});
  for (const auto& d : b.structure().directions) structure.directions.push_back({0, d[0]});
  return structure;
}

}  // namespace

template <int D>
SubdivisionScheme<D>::SubdivisionScheme(std::string name, ExactMask mask, int arity, Structure structure)
    : name_(std::move(name)), arity_(arity), exact_(std::move(mask)), structure_(std::move(structure)) {
  require_mask(name_, *exact_, arity);
  first_ = to_double(*exact_);
}

template <int D>
SubdivisionScheme<D>::SubdivisionScheme(std::string name, RealMask mask, int arity, Structure structure)
    : name_(std::move(name)), arity_(arity), first_(std::move(mask)), structure_(std::move(structure)) {
  require_mask(name_, first_, arity);
}

template <int D>
SubdivisionScheme<D>::SubdivisionScheme(std::string name, MaskOfLevel mask, int arity, Structure structure)
    : name_(std::move(name)),
      arity_(arity),
      first_(mask(1)),
      mask_of_level_(std::move(mask)),
      structure_(std::move(structure)) {
  require_mask(name_, first_, arity);
}

template <int D>
LaurentPolynomial<double, D> SubdivisionScheme<D>::mask(int level) const {
  if (level < 1)
    throw InvalidInput("SubdivisionScheme " + name_ + ": levels of masks start at 1, found " + std::to_string(level));
  return level == 1 || is_stationary() ? first_ : mask_of_level_(level);
}

template <int D>
const LaurentPolynomial<Rational, D>& SubdivisionScheme<D>::exact_mask() const {
  if (!exact_)
    throw InvalidInput("SubdivisionScheme::exact_mask: one rational mask for all levels is needed, found that " +
                       name_ + (is_stationary() ? " has coefficients that are not rational" : " is not stationary"));
  return *exact_;
}

template <int D>
double SubdivisionScheme<D>::mask_sum(int level) const {
  return sum(mask(level));
}

template <int D>
typename SubdivisionScheme<D>::Support SubdivisionScheme<D>::support() const {
  Support support;
  const Index<D> last = first_.last();
  for (std::size_t d = 0; d < D; ++d) {
    const int half = first_.half()[d], steps = 2 * (arity_ - 1);
    support.lower[d] = Rational(2 * first_.first()[d] + half, steps);
    support.upper[d] = Rational(2 * last[d] + half, steps);
  }
  return support;
}

template <int D>
Placement SubdivisionScheme<D>::placement() const {
  const auto is_odd = [](int n) { return n % 2 == 1; };
  const auto odd = std::count_if(first_.size().begin(), first_.size().end(), is_odd);
  return odd == D ? Placement::Primal : odd == 0 ? Placement::Dual : Placement::Mixed;
}

template <int D>
bool SubdivisionScheme<D>::is_interpolatory() const {
  if (exact_) return keeps_old_points(*exact_, arity_);
  for (int level = 1; level <= (is_stationary() ? 1 : checked_levels); ++level)
    if (!keeps_old_points(mask(level), arity_)) return false;
  return true;
}

template <int D>
void require_affine_invariance(const SubdivisionScheme<D>& scheme) {
  if (scheme.is_exact()) return require_cosets_sum_to_one(scheme.name(), scheme.exact_mask(), scheme.arity());
  for (int level = 1; level <= (scheme.is_stationary() ? 1 : checked_levels); ++level)
    require_cosets_sum_to_one(scheme.name() + (scheme.is_stationary() ? "" : " at level " + std::to_string(level)),
                              scheme.mask(level), scheme.arity());
}

template <int D>
SubdivisionScheme<D> centred(const SubdivisionScheme<D>& scheme) {
  const auto shift = centring_power(scheme.mask());
  const std::string name = scheme.name() + " centred";
  if (scheme.is_exact()) return {name, centred(scheme.exact_mask()), scheme.arity(), scheme.structure()};
  if (scheme.is_stationary()) return {name, centred(scheme.mask()), scheme.arity(), scheme.structure()};
  return {name, [scheme, shift](int level) { return shift * scheme.mask(level); }, scheme.arity(), scheme.structure()};
}

Scheme2 tensor_product(const Scheme& a, const Scheme& b) {
  if (a.arity() != b.arity())
    throw InvalidInput("tensor_product: both schemes must have the same arity, found " + std::to_string(a.arity()) +
                       " and " + std::to_string(b.arity()));
  const std::string name = a.name() + " x " + b.name();
  if (a.is_exact() && b.is_exact())
    return {name, tensor_product(a.exact_mask(), b.exact_mask()), a.arity(), product_structure(a, b)};
  if (a.is_stationary() && b.is_stationary()) return {name, tensor_product(a.mask(), b.mask()), a.arity()};
  return {name, [a, b](int level) { return tensor_product(a.mask(level), b.mask(level)); }, a.arity()};
}

template class SubdivisionScheme<1>;
template class SubdivisionScheme<2>;
template Scheme centred(const Scheme&);
template Scheme2 centred(const Scheme2&);
template void require_affine_invariance(const Scheme&);
template void require_affine_invariance(const Scheme2&);

}  // namespace batten
