// SPDX-License-Identifier: MIT
#include <batten/app/nearest_name.h>
#include <batten/app/output_names.h>
#include <batten/app/polyharmonic_account.h>
#include <batten/app/polyharmonic_pictures.h>
#include <batten/app/quotient_account.h>
#include <batten/app/scheme_account.h>
#include <batten/app/scheme_command.h>
#include <batten/app/scheme_options.h>
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
  polyharmonic --order m [--method exact|laurent|jacobi|lp|lsq] [--size N]
  quotient --numerator "1" --denominator "1,-3,1" [--size N]

values             n on the grid Z / 2^level
derivatives        the same of its derivatives
inner_products     r,s: integrals of n^(r)(x) n^(s)(x - i) for all i
sum_rules          order of the zeros of the mask at -1
reproduction_degree  of the polynomials that come out as they went in
smoothness         the largest m with limits proved C^m, why, and bounds of the
                   Hoelder exponent; in the plane only when asked for

polyharmonic: a finite mask of N x N coefficients in place of the quotient of
Laplacians 4^(1-m) (l[x^2,y^2] / l[x,y])^m, whose limits are harmonic (m = 1) or
thin-plate splines (m = 2). exact, laurent: its Laurent coefficients; jacobi:
smoothing rounds; lp, lsq: the least largest, or squared, residual, as far as
--precision D, --zeros, --symmetry and --shape allow. It tells:
  residual              largest of the four sums of |l^m s - 4^(1-m) l^m[x^2,y^2]|
                        over indices of the same parities
  multilevel_residuals  the same of 1, 2, ... rounds at once
  coset_sums            all 1 where constants are kept
--compare shows all kinds at sizes 5 to 21 and over rounds; --picture draws it.
quotient: Laurent coefficients of any quotient of masks that is bounded for
|x| = |y| = 1; the middle of a mask belongs to the power 0.

Examples:
  batten scheme four-point --json
  batten scheme box --directions "1,0;1,0;0,1;0,1;1,1;1,1" --picture quartic.png
  batten scheme bspline --order 4 --control "0,0;1,2;3,2;4,0" --closed --picture curve.png
  batten scheme polyharmonic --order 1 --method lp --size 5
  batten scheme polyharmonic --order 1 --compare --picture compare.png)";

void print(const SchemeArguments& arguments, const std::string& json, const std::string& table) {
  if (arguments.json)
    std::cout << json << '\n';
  else if (!arguments.quiet)
    std::cout << table;
}

/// Throws UsageError for the first option that was given although the name has it not.
void refuse(const SchemeArguments& arguments, std::initializer_list<std::pair<const char*, bool>> options) {
  for (const auto& [option, is_given] : options)
    if (is_given) throw UsageError(arguments.name + " has no option " + option);
}

/// What is asked of schemes whose limits are known exactly.
void refuse_questions(const SchemeArguments& a) {
  refuse(a, {{"--values", a.values},
             {"--derivative", !a.derivatives.empty()},
             {"--inner-product", !a.inner_products.empty()},
             {"--level", a.level != 0},
             {"--control", !a.control.empty()},
             {"--closed", a.closed}});
}

void run_quotient(const SchemeArguments& arguments) {
  check_options(arguments, {"--numerator", "--denominator"}, {"--size"});
  refuse_questions(arguments);
  refuse(arguments, {{"--smoothness", arguments.smoothness},
                     {"--compare", arguments.compare},
                     {"--picture", !arguments.picture.empty()},
                     {"--output", !arguments.output.empty()}});
  const std::string account = quotient_account(arguments);
  print(arguments, account, scheme_table(account, ""));
}

void run_polyharmonic(const SchemeArguments& arguments) {
  check_scheme_options(arguments);
  refuse_questions(arguments);
  check_output_name("-o", arguments.output, {arguments.compare ? ".csv" : ".vti"});
  check_output_name("--picture", arguments.picture, {".png"});
  if (arguments.compare) {
    const std::string table = compare_polyharmonic(arguments);
    if (!arguments.quiet) std::cout << table;
    return;
  }
  const PolyharmonicMask mask = polyharmonic_mask_of(arguments);
  const std::string account =
      polyharmonic_account(mask, arguments, arguments.json ? Fractions::Exact : Fractions::Short);
  write_polyharmonic_outputs(mask, arguments);
  print(arguments, account, scheme_table(account, ""));
}

void run_scheme(const SchemeArguments& arguments) {
  set_thread_count(arguments.threads);
  if (arguments.name == "quotient") return run_quotient(arguments);
  if (arguments.name == "polyharmonic") return run_polyharmonic(arguments);
  refuse(arguments, {{"--compare", arguments.compare}});
  const AnyScheme scheme = scheme_of(arguments);
  check_scheme_outputs(scheme, arguments);
  const std::string account = scheme_account(scheme, arguments);
  write_scheme_outputs(scheme, arguments);
  print(arguments, account, scheme_table(account, mask_text(scheme, arguments)));
}

}  // namespace

Subcommand add_scheme_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("scheme", "What a subdivision scheme is and does, exactly");
  const auto a = std::make_shared<SchemeArguments>();
  parser->add_option("NAME", a->name, "one of " + name_list(scheme_names()) + ", quotient")
      ->required()
      ->option_text(" ");
  add_making_options(*parser, *a);
  add_quotient_options(*parser, *a);
  parser->add_option("--level", a->level, "of the grid of values, and of the mask where it changes")
      ->option_text("K")
      ->check(CLI::Range(0, 12));
  parser->add_flag("--values", a->values, "only these and what else is asked for");
  parser->add_option("--derivative", a->derivatives, "its values; in the plane two orders, 1,0")->option_text("R");
  parser->add_option("--inner-product", a->inner_products, "in the plane 1,0;1,0")->option_text("R,S");
  parser->add_flag("--smoothness", a->smoothness, "the verdict and its certificate");
  parser->add_option("--rounds", a->rounds, "of the multilevel residuals, default 5")
      ->option_text("K")
      ->check(CLI::Range(0, 8));
  parser->add_flag("--compare", a->compare, "polyharmonic: all methods against size and rounds; -o OUT.csv");
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
