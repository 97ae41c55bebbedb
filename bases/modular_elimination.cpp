// SPDX-License-Identifier: MIT
#include <batten/bases/modular_elimination.h>

#include <cassert>

namespace batten {
namespace {

// Products of two numbers below 2^26 are below 2^52: so many of them, and one number more, fit into 64 bits.
constexpr int products_that_fit = 4000;

}  // namespace

std::uint32_t inverse_modulo(std::uint64_t a, std::uint32_t prime) {
  std::uint64_t result = 1, base = a % prime;  // a^(prime - 2) = 1/a, by Fermat
  for (std::uint32_t e = prime - 2; e > 0; e /= 2) {
    if (e % 2) result = result * base % prime;
    base = base * base % prime;
  }
  return static_cast<std::uint32_t>(result);
}

ModularElimination::ModularElimination(int unknowns, std::uint32_t prime)
    : prime_(prime), row_of_column_(static_cast<std::size_t>(unknowns), -1), work_(static_cast<std::size_t>(unknowns)) {
  assert(prime < (1U << 26));
}

bool ModularElimination::add(std::span<const std::uint32_t> row) {
  assert(row.size() == work_.size());
  work_.assign(row.begin(), row.end());
  std::vector<std::pair<std::size_t, std::uint32_t>> multipliers;
  int waiting = 0;  // products added since the last reduction
  for (std::size_t column = 0; column < work_.size(); ++column) {
    const std::uint64_t value = work_[column] %= prime_;
    if (value == 0) continue;
    if (row_of_column_[column] < 0) {
      keep(column, std::move(multipliers));
      return true;
    }
    const auto k = static_cast<std::size_t>(row_of_column_[column]);
    multipliers.emplace_back(k, static_cast<std::uint32_t>(value));
    if (++waiting == products_that_fit) {
      for (std::uint64_t& w : work_) w %= prime_;
      waiting = 1;
    }
    const std::uint64_t factor = prime_ - value;
    const auto& upper = rows_[k].upper;
    std::uint64_t* target = work_.data() + column + 1;
    for (std::size_t j = 0; j < upper.size(); ++j) target[j] += factor * upper[j];
  }
  return false;
}

void ModularElimination::keep(std::size_t column, std::vector<std::pair<std::size_t, std::uint32_t>> multipliers) {
  const std::uint64_t inverse = inverse_modulo(work_[column], prime_);
  std::size_t end = work_.size();
  while (end > column + 1 && work_[end - 1] % prime_ == 0) --end;
  std::vector<std::uint32_t> upper;
  upper.reserve(end - column - 1);
  for (std::size_t j = column + 1; j < end; ++j)
    upper.push_back(static_cast<std::uint32_t>(work_[j] % prime_ * inverse % prime_));
  row_of_column_[column] = static_cast<std::ptrdiff_t>(rows_.size());
  rows_.push_back({column, static_cast<std::uint32_t>(inverse), std::move(multipliers), std::move(upper)});
}

std::vector<std::uint32_t> ModularElimination::solve(std::span<const std::uint32_t> right) const {
  assert(is_full() && right.size() == rows_.size());
  std::vector<std::uint64_t> y(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::uint64_t value = right[i];
    int waiting = 0;
    for (const auto& [k, multiplier] : rows_[i].multipliers) {
      value += (prime_ - multiplier) * y[k];
      if (++waiting % products_that_fit == 0) value %= prime_;
    }
    y[i] = value % prime_ * rows_[i].inverse_pivot % prime_;
  }
  std::vector<std::uint32_t> x(rows_.size());
  for (std::size_t column = x.size(); column-- > 0;) {
    const auto i = static_cast<std::size_t>(row_of_column_[column]);
    const auto& upper = rows_[i].upper;
    std::uint64_t sum = 0;
    for (std::size_t j = 0; j < upper.size(); ++j) {
      sum += std::uint64_t{upper[j]} * x[column + 1 + j];
      if (j % products_that_fit == products_that_fit - 1) sum %= prime_;
    }
    x[column] = static_cast<std::uint32_t>((y[i] + prime_ - sum % prime_) % prime_);
  }
  return x;
}

}  // namespace batten
