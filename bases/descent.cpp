// SPDX-License-Identifier: MIT
#include <batten/bases/descent.h>
#include <batten/bases/index_box.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr std::size_t most_rows = 200'000;

/// Calls work(place, index) for the window, x fastest.
template <int D, std::invocable<std::size_t, const Index<D>&> Work>
void for_window(const SupportWindow<D>& window, Work&& work) {
  Index<D> i = window.lower;
  std::size_t place = 0;
  for (int y = 0; y < (D == 1 ? 1 : window.size[D - 1]); ++y)
    for (int x = 0; x < window.size[0]; ++x) {
      i[D - 1] = window.lower[D - 1] + y;  // overwritten in one dimension
      i[0] = window.lower[0] + x;
      work(place++, i);
    }
}

/// A row of `rounds` steps: what it adds up to besides a constant, the constant, and its absolute sum.
struct Row {
  double rest = 0, constant = 0, absolute = 0;
};

Row split(std::vector<double>& entries) {
  const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(entries.size() / 2);
  std::nth_element(entries.begin(), middle, entries.end());
  Row row{0, *middle, 0};
  for (double e : entries) {
    row.rest += std::abs(e - row.constant);
    row.absolute += std::abs(e);
  }
  return row;
}

/// The largest of each over all rows of S, the mask of some rounds at once.
template <int D>
Row largest_rows(const LaurentPolynomial<double, D>& S, const SupportWindow<D>& window) {
  Row most;
  SupportWindow<D> points;  // m with entries S[m - j], j in the window
  for (std::size_t d = 0; d < D; ++d) {
    points.lower[d] = S.first()[d] + window.lower[d];
    points.size[d] = S.size()[d] + window.size[d] - 1;
  }
  std::vector<double> entries;
  for_window<D>(points, [&](std::size_t, const Index<D>& m) {
    entries.clear();
    for_window<D>(window, [&](std::size_t, const Index<D>& j) {
      Index<D> at = m;
      for (std::size_t d = 0; d < D; ++d) at[d] -= j[d];
      entries.push_back(S[at]);
    });
    const Row row = split(entries);
    most.rest = std::max(most.rest, row.rest);
    most.constant = std::max(most.constant, std::abs(row.constant));
    most.absolute = std::max(most.absolute, row.absolute);
  });
  return most;
}

/// max |V(t)_i - V(0)_i| over the points t of the level that S leads to.
template <int D>
double largest_change(const LaurentPolynomial<double, D>& S, const LaurentPolynomial<double, D>& values, int steps) {
  const auto fine = S * values;
  double most = 0;
  const SupportWindow<D> points{fine.first(), fine.size()};
  for_window<D>(points, [&](std::size_t, const Index<D>& m) {
    Index<D> i{};
    for (std::size_t d = 0; d < D; ++d) i[d] = floor_quotient(m[d], steps);
    most = std::max(most, std::abs(fine[m] - values[i]));
  });
  return most;
}

template <int D>
LaurentPolynomial<double, D> without_half(const LaurentPolynomial<double, D>& s) {
  return {s.first(), s.size(), {s.coefficients().begin(), s.coefficients().end()}};
}

}  // namespace

template <Coefficient T, int D>
SupportWindow<D> support_window(const LaurentPolynomial<T, D>& s, int arity) {
  SupportWindow<D> window;
  const Index<D> last = s.last();
  for (std::size_t d = 0; d < D; ++d) {
    window.lower[d] = floor_quotient(s.first()[d], arity - 1);
    window.size[d] = std::max(1, -floor_quotient(-last[d], arity - 1) - window.lower[d]);
  }
  return window;
}

template <Coefficient T, int D>
std::vector<T> descended(const LaurentPolynomial<T, D>& s, int arity, const Index<D>& digit,
                         const SupportWindow<D>& window, std::span<const T> g) {
  std::vector<T> f(g.size(), T(0));
  const auto coefficients = s.coefficients();
  const int row = s.size()[0];
  for_window<D>(window, [&](std::size_t place, const Index<D>& i) {
    // g at arity i + digit - j, counted from the window's lower end: j from high down to low
    Index<D> top{};
    for (std::size_t d = 0; d < D; ++d) top[d] = arity * i[d] + digit[d] - s.first()[d] - window.lower[d];
    const int y_begin = D == 1 ? 0 : std::max(0, top[D - 1] - window.size[D - 1] + 1);
    const int y_end = D == 1 ? 1 : std::min(s.size()[D - 1], top[D - 1] + 1);
    const int x_begin = std::max(0, top[0] - window.size[0] + 1), x_end = std::min(row, top[0] + 1);
    for (int y = y_begin; y < y_end; ++y) {
      const int from = D == 1 ? 0 : window.size[0] * (top[D - 1] - y);
      for (int x = x_begin; x < x_end; ++x)
        f[place] +=
            coefficients[static_cast<std::size_t>(x + row * y)] * g[static_cast<std::size_t>(from + top[0] - x)];
    }
  });
  return f;
}

template <Coefficient T, int D>
std::vector<T> windowed(const LaurentPolynomial<T, D>& p, const SupportWindow<D>& window) {
  std::vector<T> result;
  for_window<D>(window, [&](std::size_t, const Index<D>& i) { result.push_back(p[i]); });
  return result;
}

template <int D>
DescentBound descent_bound(const LaurentPolynomial<double, D>& mask, int arity,
                           const LaurentPolynomial<double, D>& own_grid) {
  const auto s = without_half(mask), values = without_half(own_grid);
  const auto window = support_window(s, arity);
  std::size_t width = 1;
  for (int n : window.size) width *= static_cast<std::size_t>(n);
  DescentBound best;
  double largest_sum = 1, change = 0;  // of no rounds
  auto S = LaurentPolynomial<double, D>::constant(1);
  for (int rounds = 1, steps = arity; best.ratio > 0.5; ++rounds, steps *= arity) {
    S = upsampled(S, arity) * s;
    if (S.coefficients().size() > most_rows) break;
    const Row most = largest_rows(S, window);
    largest_sum = std::max(largest_sum, most.absolute);
    change = largest_change(S, values, steps);
    if (most.rest >= best.ratio) continue;
    best = {rounds, most.rest, change / (1 - most.rest),
            std::max(largest_sum, static_cast<double>(width) * most.constant / (1 - most.rest)), true};
  }
  if (!best.is_proved) best.oscillation = 2 * change, best.amplification = 2 * largest_sum;
  return best;
}

Digits::Digits(double x, bool minus_half) : cell_(static_cast<int>(std::floor(std::abs(x)))) {
  constexpr std::uint64_t one = std::uint64_t{1} << 60;
  const double t = std::ldexp(std::abs(x) - cell_, 60), rest = std::ldexp(t - std::floor(t), 60);
  high_ = static_cast<std::uint64_t>(t);
  low_ = static_cast<std::uint64_t>(rest);
  is_rounded_ = rest != std::floor(rest);
  if (x < 0) {
    cell_ = -cell_;
    if (high_ != 0 || low_ != 0) {  // -cell - t = -(cell + 1) + (1 - t)
      --cell_;
      high_ = low_ == 0 ? one - high_ : one - 1 - high_;
      low_ = low_ == 0 ? 0 : one - low_;
    }
  }
  if (!minus_half) return;
  if (high_ < one / 2) {
    --cell_;
    high_ += one / 2;
  } else {
    high_ -= one / 2;
  }
}

int Digits::next(int arity) {
  constexpr std::uint64_t mask = (std::uint64_t{1} << 60) - 1;
  const auto factor = static_cast<std::uint64_t>(arity);
  const std::uint64_t low = factor * low_, high = factor * high_ + (low >> 60);
  low_ = low & mask;
  high_ = high & mask;
  return static_cast<int>(high >> 60);
}

template SupportWindow<1> support_window(const Mask<double>&, int);
template SupportWindow<2> support_window(const Mask2<double>&, int);
template SupportWindow<1> support_window(const Mask<Rational>&, int);
template SupportWindow<2> support_window(const Mask2<Rational>&, int);
template std::vector<double> descended(const Mask<double>&, int, const Index<1>&, const SupportWindow<1>&,
                                       std::span<const double>);
template std::vector<double> descended(const Mask2<double>&, int, const Index<2>&, const SupportWindow<2>&,
                                       std::span<const double>);
template std::vector<Rational> descended(const Mask<Rational>&, int, const Index<1>&, const SupportWindow<1>&,
                                         std::span<const Rational>);
template std::vector<Rational> descended(const Mask2<Rational>&, int, const Index<2>&, const SupportWindow<2>&,
                                         std::span<const Rational>);
template std::vector<double> windowed(const Mask<double>&, const SupportWindow<1>&);
template std::vector<double> windowed(const Mask2<double>&, const SupportWindow<2>&);
template std::vector<Rational> windowed(const Mask<Rational>&, const SupportWindow<1>&);
template std::vector<Rational> windowed(const Mask2<Rational>&, const SupportWindow<2>&);
template DescentBound descent_bound(const Mask<double>&, int, const Mask<double>&);
template DescentBound descent_bound(const Mask2<double>&, int, const Mask2<double>&);

}  // namespace batten
