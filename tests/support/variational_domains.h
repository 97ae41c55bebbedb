// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/spline_level.h>

#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

// Small domains on which the laws of variational schemes are tested.
namespace batten::test {

struct NamedDomain {
  std::string name;
  VariationalDomain domain;
};

inline void PrintTo(const NamedDomain& named, std::ostream* out) { *out << named.name; }

inline Eigen::VectorXd random_coefficients(Eigen::Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  Eigen::VectorXd v(n);
  for (double& x : v) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
  return v;
}

/// Cells whose widths vary up to threefold.
inline Breakpoints uneven(double length, int cells, unsigned seed) {
  const Eigen::VectorXd r = random_coefficients(cells, seed);
  std::vector<double> x = {0};
  for (double v : r) x.push_back(x.back() + 2 + v);
  for (double& v : x) v *= length / x.back();
  return Breakpoints(x);
}

/// Coefficients from 1 to `contrast`, log-uniform.
inline std::vector<double> rough(std::size_t cells, double contrast, unsigned seed) {
  std::vector<double> result;
  for (double v : random_coefficients(static_cast<Eigen::Index>(cells), seed))
    result.push_back(std::pow(contrast, (v + 1) / 2));
  return result;
}

/// An L: all cells but those right of and above the middle, whole cells of levels with at least two cells a side.
inline std::vector<char> l_shape(int nx, int ny) {
  std::vector<char> result;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) result.push_back(i < nx / 2 || j < ny / 2);
  return result;
}

/// A domain of unit cells, or of uneven ones.
inline VariationalDomain variational_domain(const Energy& energy, int degree, int nx, int ny, bool even = true) {
  const auto cut = [&](int n) { return even ? Breakpoints::uniform(0, n, n) : uneven(n, n, static_cast<unsigned>(n)); };
  VariationalDomain result{cut(nx)};
  if (ny > 0) result.y = cut(ny);
  result.energy = energy;
  result.degree = degree;
  return result;
}

/// All energies, degrees, kinds of cells: those whose Greville values give a bell form.
inline std::vector<NamedDomain> bell_form_domains() {
  std::vector<NamedDomain> result;
  const std::vector<std::pair<std::string, Energy>> energies = {
      {"membrane", Energy::membrane()},
      {"thin_plate", Energy::thin_plate()},
      {"tension", Energy::tension(0.3)},
      {"bending_along_axes", Energy::sum_of({{1, 2, 0}, {4, 0, 2}})}};
  for (const auto& [name, energy] : energies)
    for (int degree = energy.order(); degree <= 3; ++degree)
      for (bool even : {true, false}) {
        const std::string text = name + "_degree_" + std::to_string(degree) + (even ? "_even" : "_uneven");
        if (energy.order() == 1 || degree > 1)
          result.push_back({text + "_interval", variational_domain(energy, degree, even ? 24 : 23, 0, even)});
        result.push_back({text + "_rectangle", variational_domain(energy, degree, even ? 8 : 11, 9, even)});
      }
  auto varying = variational_domain(Energy::membrane(), 1, 12, 8);
  varying.coefficient = rough(96, 1000, 5);
  result.push_back({"membrane_of_contrast_1000", varying});
  varying = variational_domain(Energy::thin_plate(), 2, 9, 8, false);
  varying.coefficient = rough(72, 1000, 6);
  result.push_back({"thin_plate_of_contrast_1000", varying});
  auto masked = variational_domain(Energy::membrane(), 1, 8, 8);
  masked.inside = l_shape(8, 8);
  result.push_back({"membrane_on_an_l", masked});
  auto triangles = variational_domain(Energy::membrane(), 1, 8, 12);
  triangles.triangles = true;
  result.push_back({"membrane_on_triangles", triangles});
  auto extended = variational_domain(Energy::thin_plate(), 2, 20, 0);
  extended.ends = KnotSplines::Ends::Extended;
  result.push_back({"thin_plate_degree_2_extended", extended});
  return result;
}

}  // namespace batten::test
