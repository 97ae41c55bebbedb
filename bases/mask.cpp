// SPDX-License-Identifier: MIT
#include <batten/bases/index_box.h>
#include <batten/bases/mask.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

/// The two-dimensional view of an index: y is 0 in one dimension.
template <int D>
std::array<int, 2> xy(const Index<D>& i) {
  if constexpr (D == 1)
    return {i[0], 0};
  else
    return i;
}

template <int D>
std::array<std::size_t, 2> extent(const Index<D>& size) {
  if constexpr (D == 1)
    return {static_cast<std::size_t>(size[0]), 1};
  else
    return {static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1])};
}

template <int D>
Index<D> index_of(int x, int y) {
  if constexpr (D == 1)
    return {x};
  else
    return {x, y};
}

/// Calls work(place in the storage, index relative to the first) for all of a box.
template <int D, std::invocable<std::size_t, const Index<D>&> Work>
void for_box(const Index<D>& size, Work&& work) {
  const auto [nx, ny] = extent<D>(size);
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x < nx; ++x) work(x + nx * y, index_of<D>(static_cast<int>(x), static_cast<int>(y)));
}

template <int D>
std::size_t volume(const Index<D>& size) {
  const auto [nx, ny] = extent<D>(size);
  return nx * ny;
}

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(const Rational&) { return true; }

template <int D>
std::string shift_text(const Index<D>& half) {
  std::string text = "(";
  for (int d = 0; d < D; ++d) text += (d ? ", " : "") + std::string(half[static_cast<std::size_t>(d)] ? "1/2" : "0");
  return text + ")";
}

void require(bool holds, const char* what, const std::string& found) {
  if (!holds) throw InvalidInput(std::string(what) + ", found " + found);
}

}  // namespace

template <Coefficient T, int D>
LaurentPolynomial<T, D>::LaurentPolynomial(const Index<D>& first, const Index<D>& size, std::vector<T> coefficients,
                                           const Index<D>& half)
    : first_(first), size_(size), half_(half), coefficients_(std::move(coefficients)) {
  for (int n : size) require(n >= 0, "LaurentPolynomial: sizes must not be negative", std::to_string(n));
  for (int h : half) require(h == 0 || h == 1, "LaurentPolynomial: half must be 0 or 1", std::to_string(h));
  require(coefficients_.size() == volume<D>(size),
          ("LaurentPolynomial: the box needs " + std::to_string(volume<D>(size)) + " coefficients").c_str(),
          std::to_string(coefficients_.size()));
  const auto finite = [](const T& c) { return is_finite(c); };
  const auto other = std::find_if_not(coefficients_.begin(), coefficients_.end(), finite);
  if (other != coefficients_.end())
    throw InvalidInput("LaurentPolynomial: coefficients must be finite, found a number that is not at place " +
                       std::to_string(other - coefficients_.begin()));
  trim();
}

template <Coefficient T, int D>
Index<D> LaurentPolynomial<T, D>::last() const {
  Index<D> last = first_;
  for (std::size_t d = 0; d < D; ++d) last[d] += size_[d] - 1;
  return last;
}

template <Coefficient T, int D>
T LaurentPolynomial<T, D>::operator[](const Index<D>& i) const {
  Index<D> at{};
  for (std::size_t d = 0; d < D; ++d) {
    at[d] = i[d] - first_[d];
    if (at[d] < 0 || at[d] >= size_[d]) return T(0);
  }
  const auto [x, y] = extent<D>(at);
  return coefficients_[D == 1 ? x : x + static_cast<std::size_t>(size_[0]) * y];
}

template <Coefficient T, int D>
LaurentPolynomial<T, D>& LaurentPolynomial<T, D>::operator*=(const T& factor) {
  for (T& c : coefficients_) c *= factor;
  trim();
  return *this;
}

template <Coefficient T, int D>
LaurentPolynomial<T, D>& LaurentPolynomial<T, D>::add(const LaurentPolynomial& other, const T& factor) {
  if (other.is_zero()) return *this;
  if (is_zero()) {
    *this = other;
    return *this *= factor;
  }
  require(half_ == other.half_, "LaurentPolynomial: summands must have powers shifted by the same half",
          shift_text<D>(half_) + " and " + shift_text<D>(other.half_));
  Index<D> first = first_, size{};
  const Index<D> a = last(), b = other.last();
  for (std::size_t d = 0; d < D; ++d) {
    first[d] = std::min(first_[d], other.first_[d]);
    size[d] = std::max(a[d], b[d]) - first[d] + 1;
  }
  std::vector<T> sum(volume<D>(size));
  for_box<D>(size, [&](std::size_t k, Index<D> i) {
    for (std::size_t d = 0; d < D; ++d) i[d] += first[d];
    sum[k] = (*this)[i] + factor * other[i];
  });
  return *this = LaurentPolynomial(first, size, std::move(sum), half_);
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> LaurentPolynomial<T, D>::product(const LaurentPolynomial& other) const {
  if (is_zero() || other.is_zero()) return {};
  Index<D> first{}, size{}, half{};
  for (std::size_t d = 0; d < D; ++d) {
    first[d] = first_[d] + other.first_[d] + (half_[d] & other.half_[d]);
    size[d] = size_[d] + other.size_[d] - 1;
    half[d] = half_[d] ^ other.half_[d];
  }
  std::vector<T> result(volume<D>(size));
  const auto row = static_cast<std::size_t>(size[0]);
  for_box<D>(size_, [&](std::size_t a, const Index<D>& i) {
    if (coefficients_[a] == 0) return;
    for_box<D>(other.size_, [&](std::size_t b, const Index<D>& j) {
      const auto p = xy<D>(i), q = xy<D>(j);
      const auto place = static_cast<std::size_t>(p[0] + q[0]) + row * static_cast<std::size_t>(p[1] + q[1]);
      if (other.coefficients_[b] != 0) result[place] += coefficients_[a] * other.coefficients_[b];
    });
  });
  return {first, size, std::move(result), half};
}

template <Coefficient T, int D>
void LaurentPolynomial<T, D>::trim() {
  Index<D> low = size_, high{};
  for_box<D>(size_, [&](std::size_t k, const Index<D>& i) {
    if (coefficients_[k] == 0) return;
    for (std::size_t d = 0; d < D; ++d) {
      low[d] = std::min(low[d], i[d]);
      high[d] = std::max(high[d], i[d] + 1);
    }
  });
  if (low == Index<D>{} && high == size_) return;
  if (high == Index<D>{}) {
    *this = {};
    return;
  }
  Index<D> size{};
  for (std::size_t d = 0; d < D; ++d) size[d] = high[d] - low[d];
  std::vector<T> kept(volume<D>(size));
  const auto from = xy<D>(low);
  const auto row = static_cast<std::size_t>(size_[0]);
  for_box<D>(size, [&](std::size_t k, const Index<D>& i) {
    const auto at = xy<D>(i);
    kept[k] =
        coefficients_[static_cast<std::size_t>(at[0] + from[0]) + row * static_cast<std::size_t>(at[1] + from[1])];
  });
  for (std::size_t d = 0; d < D; ++d) first_[d] += low[d];
  size_ = size;
  coefficients_ = std::move(kept);
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> upsampled(const LaurentPolynomial<T, D>& s, int n) {
  require(n >= 1, "upsampled: the power must be at least 1", std::to_string(n));
  if (s.is_zero()) return s;
  Index<D> first{}, size{}, half{};
  for (std::size_t d = 0; d < D; ++d) {
    const int twice = n * s.half()[d];  // n/2 of the shift is whole
    first[d] = n * s.first()[d] + twice / 2;
    half[d] = twice % 2;
    size[d] = n * (s.size()[d] - 1) + 1;
  }
  std::vector<T> result(volume<D>(size));
  const std::size_t row = extent<D>(size)[0], step = static_cast<std::size_t>(n);
  for_box<D>(s.size(), [&](std::size_t k, const Index<D>& i) {
    const auto at = extent<D>(i);
    result[step * at[0] + (D == 1 ? 0 : row * step * at[1])] = s.coefficients()[k];
  });
  return {first, size, std::move(result), half};
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> reflected(const LaurentPolynomial<T, D>& s) {
  Index<D> first{};
  const Index<D> last = s.last();
  for (std::size_t d = 0; d < D; ++d) first[d] = -last[d] - s.half()[d];
  return {first, s.size(), std::vector<T>(s.coefficients().rbegin(), s.coefficients().rend()), s.half()};
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> shifted(const LaurentPolynomial<T, D>& s, const Index<D>& by) {
  Index<D> first = s.first();
  for (std::size_t d = 0; d < D; ++d) first[d] += by[d];
  return {first, s.size(), std::vector<T>(s.coefficients().begin(), s.coefficients().end()), s.half()};
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> centred(const LaurentPolynomial<T, D>& s) {
  Index<D> first{}, half{};
  for (std::size_t d = 0; d < D; ++d) {
    first[d] = -(s.size()[d] / 2);
    half[d] = s.is_zero() ? 0 : 1 - s.size()[d] % 2;
  }
  return {first, s.size(), std::vector<T>(s.coefficients().begin(), s.coefficients().end()), half};
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> power(const LaurentPolynomial<T, D>& s, int n) {
  require(n >= 0, "power: the exponent must not be negative", std::to_string(n));
  auto result = LaurentPolynomial<T, D>::constant(T(1));
  for (int i = 0; i < n; ++i) result *= s;
  return result;
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> coset(const LaurentPolynomial<T, D>& s, const Index<D>& residue, int arity) {
  require(arity >= 1, "coset: the arity must be at least 1", std::to_string(arity));
  Index<D> first{}, size{};
  const Index<D> last = s.last();
  for (std::size_t d = 0; d < D; ++d) {
    first[d] = -floor_quotient(residue[d] - s.first()[d], arity);  // ceiling of (first - residue) / arity
    size[d] = std::max(0, floor_quotient(last[d] - residue[d], arity) - first[d] + 1);
  }
  std::vector<T> result(volume<D>(size));
  for_box<D>(size, [&](std::size_t k, Index<D> e) {
    for (std::size_t d = 0; d < D; ++d) e[d] = arity * (first[d] + e[d]) + residue[d];
    result[k] = s[e];
  });
  return {first, size, std::move(result)};
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> iterated(const LaurentPolynomial<T, D>& s, int steps, int arity) {
  require(steps >= 0, "iterated: the number of steps must not be negative", std::to_string(steps));
  auto result = LaurentPolynomial<T, D>::constant(T(1));
  for (int i = 0; i < steps; ++i) result = upsampled(result, arity) * s;
  return result;
}

template <Coefficient T>
Mask2<T> swapped(const Mask2<T>& s) {
  std::vector<T> result;
  for (int x = 0; x < s.size()[0]; ++x)
    for (int y = 0; y < s.size()[1]; ++y) result.push_back(s[{s.first()[0] + x, s.first()[1] + y}]);
  return {{s.first()[1], s.first()[0]}, {s.size()[1], s.size()[0]}, std::move(result), {s.half()[1], s.half()[0]}};
}

template <Coefficient T>
Mask2<T> tensor_product(const Mask<T>& a, const Mask<T>& b) {
  std::vector<T> result;
  for (const T& y : b.coefficients())
    for (const T& x : a.coefficients()) result.push_back(x * y);
  return {{a.first()[0], b.first()[0]}, {a.size()[0], b.size()[0]}, std::move(result), {a.half()[0], b.half()[0]}};
}

template <int D>
LaurentPolynomial<double, D> to_double(const LaurentPolynomial<Rational, D>& s) {
  std::vector<double> rounded;
  for (const Rational& c : s.coefficients()) rounded.push_back(static_cast<double>(c));
  return {s.first(), s.size(), std::move(rounded), s.half()};
}

template class LaurentPolynomial<Rational, 1>;
template class LaurentPolynomial<Rational, 2>;
template class LaurentPolynomial<double, 1>;
template class LaurentPolynomial<double, 2>;
template Mask<Rational> upsampled(const Mask<Rational>&, int);
template Mask2<Rational> upsampled(const Mask2<Rational>&, int);
template Mask<double> upsampled(const Mask<double>&, int);
template Mask2<double> upsampled(const Mask2<double>&, int);
template Mask<Rational> reflected(const Mask<Rational>&);
template Mask2<Rational> reflected(const Mask2<Rational>&);
template Mask<double> reflected(const Mask<double>&);
template Mask2<double> reflected(const Mask2<double>&);
template Mask<Rational> shifted(const Mask<Rational>&, const Index<1>&);
template Mask2<Rational> shifted(const Mask2<Rational>&, const Index<2>&);
template Mask<double> shifted(const Mask<double>&, const Index<1>&);
template Mask2<double> shifted(const Mask2<double>&, const Index<2>&);
template Mask<Rational> centred(const Mask<Rational>&);
template Mask2<Rational> centred(const Mask2<Rational>&);
template Mask<double> centred(const Mask<double>&);
template Mask2<double> centred(const Mask2<double>&);
template Mask<Rational> power(const Mask<Rational>&, int);
template Mask2<Rational> power(const Mask2<Rational>&, int);
template Mask<double> power(const Mask<double>&, int);
template Mask2<double> power(const Mask2<double>&, int);
template Mask<Rational> coset(const Mask<Rational>&, const Index<1>&, int);
template Mask2<Rational> coset(const Mask2<Rational>&, const Index<2>&, int);
template Mask<double> coset(const Mask<double>&, const Index<1>&, int);
template Mask2<double> coset(const Mask2<double>&, const Index<2>&, int);
template Mask<Rational> iterated(const Mask<Rational>&, int, int);
template Mask2<Rational> iterated(const Mask2<Rational>&, int, int);
template Mask<double> iterated(const Mask<double>&, int, int);
template Mask2<double> iterated(const Mask2<double>&, int, int);
template Mask2<Rational> swapped(const Mask2<Rational>&);
template Mask2<double> swapped(const Mask2<double>&);
template Mask2<Rational> tensor_product(const Mask<Rational>&, const Mask<Rational>&);
template Mask2<double> tensor_product(const Mask<double>&, const Mask<double>&);
template Mask<double> to_double(const Mask<Rational>&);
template Mask2<double> to_double(const Mask2<Rational>&);

}  // namespace batten
