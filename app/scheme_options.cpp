// SPDX-License-Identifier: MIT
#include <batten/app/scheme_options.h>

#include <CLI/CLI.hpp>

namespace batten {
namespace {

/// Calls visit(option, value, what it is, form) for every option that makes a scheme.
template <class Arguments, class Visit>
void for_making_options(Arguments& a, Visit&& visit) {
  visit("--order", a.order, "of a B-spline: degree + 1; of the power of the Laplacian", "M");
  visit("--directions", a.directions, "of a box spline", "\"A,B;...\"");
  visit("--roots", a.roots, "of the operator of an exponential B-spline", "\"R,...\"");
  visit("--sigma", a.sigma, "tension: 1 none, above 1 tighter, cos(2 pi/n) circles", "S");
  visit("--w", a.weight, "weight of the outer points", "W");
  visit("--points", a.points, "points of the interpolating polynomial", "N");
  visit("--mask", a.mask, "coefficients, rows of the plane separated by ;", "\"C,...\"");
  visit("--offset", a.offset, "exponent of the first coefficient (x,y in the plane)", "E");
  visit("--arity", a.arity, "2 or 3 new points for an old one", "A");
  visit("--method", a.method, "polyharmonic: exact, laurent, jacobi, lp (default) or lsq", "NAME");
  visit("--size", a.size, "polyharmonic, flows: odd number N of N x N coefficients, default 9", "N");
  visit("--precision", a.precision, "polyharmonic: degree of polynomials kept", "D");
  visit("--zeros", a.zeros, "lp, lsq: zeros at (1 or -1, 1 or -1) and their orders", "\"X,Y,K;...\"");
  visit("--symmetry", a.symmetry, "lp, lsq: square (default), rectangle, point or none", "NAME");
  visit("--shape", a.shape, "lp, lsq: square (default), disc or diamond", "NAME");
  visit("--relaxation", a.relaxation, "jacobi: the factor a, default 1/8^m", "A");
}

template <class Arguments, class Visit>
void for_quotient_options(Arguments& a, Visit&& visit) {
  visit("--numerator", a.numerator, "of a quotient: coefficients as for --mask", "\"C,...\"");
  visit("--denominator", a.denominator, "of a quotient", "\"C,...\"");
}

}  // namespace

void add_making_options(CLI::App& parser, SchemeArguments& arguments) {
  for_making_options(arguments, [&](const char* name, auto& value, const char* what, const char* form) {
    parser.add_option(name, value, what)->option_text(form);
  });
}

void add_quotient_options(CLI::App& parser, SchemeArguments& arguments) {
  for_quotient_options(arguments, [&](const char* name, auto& value, const char* what, const char* form) {
    parser.add_option(name, value, what)->option_text(form);
  });
}

std::vector<std::string> making_options_given(const SchemeArguments& arguments) {
  std::vector<std::string> given;
  const auto note = [&](const char* name, const auto& value, const char*, const char*) {
    if (value) given.emplace_back(name);
  };
  for_making_options(arguments, note);
  for_quotient_options(arguments, note);
  return given;
}

}  // namespace batten
