// SPDX-License-Identifier: MIT
#include <batten/app/scheme_account.h>
#include <batten/app/scheme_command.h>
#include <batten/app/scheme_pictures.h>
#include <batten/app/thread_count.h>
#include <batten/app/usage_error.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace batten {
namespace {

const char* const scheme_help = R"(
A scheme refines data by p_k[x] = s[x] p_{k-1}[x^2], s its mask; the limit of
data p is sum_i p_i n(x - i), n the scaling function. Masks and values are
written as polynomials: coefficients and the exponent (the place) of the first,
in the plane one row for each power of y, the lowest first (in the table the
highest first). Numbers are exact: p/q.

  bspline --order m [--arity 3]       exponential --roots "0,0,1,-1"
  box --directions "1,0;0,1;1,1"      tension --sigma s
  four-point [--w 1/16]               six-point [--w 3/256]
  deslauriers-dubuc --points 6        ternary-four-point [--w 1/10]
  butterfly [--w 1/16]                quad-interpolatory
  custom --mask "1/8,1/2,3/4,1/2,1/8" --offset -2 [--arity 2]

values             n on the grid Z / 2^level
derivatives        the same of its derivatives
inner_products     r,s: integrals of n^(r)(x) n^(s)(x - i) for all i
sum_rules          order of the zeros of the mask at -1
reproduction_degree  of the polynomials that come out as they went in
smoothness         the largest m with limits proved C^m, why, and bounds of the
                   Hoelder exponent; in the plane only when asked for

Examples:
  batten scheme four-point --json
  batten scheme box --directions "1,0;1,0;0,1;0,1;1,1;1,1" --picture quartic.png
  batten scheme bspline --order 4 --control "0,0;1,2;3,2;4,0" --closed --picture curve.png)";

void run_scheme(const SchemeArguments& arguments) {
  set_thread_count(arguments.threads);
  const AnyScheme scheme = scheme_of(arguments);
  check_scheme_outputs(scheme, arguments);
  const std::string account = scheme_account(scheme, arguments);
  write_scheme_outputs(scheme, arguments);
  if (arguments.json)
    std::cout << account << '\n';
  else if (!arguments.quiet)
    std::cout << scheme_table(account, mask_text(scheme, arguments));
}

void add_making_options(CLI::App& parser, SchemeArguments& a) {
  const auto text = [&](const char* name, auto& value, const char* what, const char* form) {
    parser.add_option(name, value, what)->option_text(form);
  };
  text("--order", a.order, "of a B-spline: degree + 1", "M");
  text("--directions", a.directions, "of a box spline", "\"A,B;...\"");
  text("--roots", a.roots, "of the operator of an exponential B-spline", "\"R,...\"");
  text("--sigma", a.sigma, "tension: 1 none, above 1 tighter, cos(2 pi/n) circles", "S");
  text("--w", a.weight, "weight of the outer points", "W");
  text("--points", a.points, "points of the interpolating polynomial", "N");
  text("--mask", a.mask, "coefficients, rows of the plane separated by ;", "\"C,...\"");
  text("--offset", a.offset, "exponent of the first coefficient (x,y in the plane)", "E");
  text("--arity", a.arity, "2 or 3 new points for an old one", "A");
}

}  // namespace

Subcommand add_scheme_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("scheme", "What a subdivision scheme is and does, exactly");
  const auto a = std::make_shared<SchemeArguments>();
  parser->add_option("NAME", a->name, "one of " + scheme_names())->required()->option_text(" ");
  add_making_options(*parser, *a);
  parser->add_option("--level", a->level, "of the grid of values, and of the mask where it changes")
      ->option_text("K")
      ->check(CLI::Range(0, 12));
  parser->add_flag("--values", a->values, "only these and what else is asked for");
  parser->add_option("--derivative", a->derivatives, "its values; in the plane two orders, 1,0")->option_text("R");
  parser->add_option("--inner-product", a->inner_products, "in the plane 1,0;1,0")->option_text("R,S");
  parser->add_flag("--smoothness", a->smoothness, "the verdict and its certificate");
  parser->add_flag("--json", a->json, "JSON instead of a table");
  parser->add_option("--picture", a->picture, "the scaling function and its derivatives")->option_text("OUT.png");
  parser->add_option("-o,--output", a->output, "the same for ParaView; .vti in the plane")->option_text("OUT.vtp");
  parser->add_option("--control", a->control, "a polygon to write and draw with its limit instead")
      ->option_text("\"X,Y;...\"");
  parser->add_flag("--closed", a->closed, "join its last point to its first");
  parser->add_option("--threads", a->threads, "default: all of the machine; the result does not depend on it")
      ->option_text("N")
      ->check(CLI::Range(1, most_threads));
  parser->add_flag("--quiet", a->quiet, "no table");
  parser->footer(scheme_help);
  return {parser, [a] { run_scheme(*a); }};
}

}  // namespace batten
