// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/domains/errors.h>

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>
#include <string>

namespace batten {

GaussRule gauss_rule(int n) {
  if (n < 1 || n > 20) throw InvalidInput("gauss_rule: expected 1 to 20 points, found " + std::to_string(n));
  auto zeros = boost::math::legendre_p_zeros<double>(n);  // those that are not negative
  for (std::size_t k = zeros.size(); k-- > 0;)
    if (zeros[k] > 0) zeros.push_back(-zeros[k]);
  std::sort(zeros.begin(), zeros.end());
  GaussRule rule;
  for (const double x : zeros) {
    const double slope = boost::math::legendre_p_prime(n, x);
    rule.place.push_back((1 + x) / 2);
    rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace batten
