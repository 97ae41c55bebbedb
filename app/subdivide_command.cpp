// SPDX-License-Identifier: MIT
#include <batten/app/bounded_subdivision.h>
#include <batten/app/curve_subdivision.h>
#include <batten/app/flow_subdivision.h>
#include <batten/app/grid_subdivision.h>
#include <batten/app/nearest_name.h>
#include <batten/app/output_names.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/scheme_options.h>
#include <batten/app/subdivide_command.h>
#include <batten/app/thread_count.h>
#include <batten/app/usage_error.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace batten {
namespace {

const char* const subdivide_help = R"(
A table with a header is a curve: its rows are points, in order. A matrix of
numbers without a header is a control grid: the number in column i of line j is
the value at (i, j), counted from 0. Each level doubles the points (arity 3:
triples them): p_k[x] = s[x] p_{k-1}[x^2].

Schemes are those of `batten scheme`; on a grid one of the line is used in x and
in y. Masks must keep constants: polyharmonic ones have --precision 0 unless
another is asked for. For curves there is natural-cubic as well: the curve of
least bending energy, whose coefficients are the points, or which passes
  --interpolate    through the points
  --smoothing L    near them: mean of |p(t_i) - b_i|^2 + L int |p''|^2 is least,
                   the parameter running from 0 to 1
  --tolerance E    within E of each, with the least int |p''|^2, up to 0.1 %
                   (--tolerance-column COL: within E times that column)
  --minimum V, --maximum V
                   one column of values, with one of the above: everywhere on
                   the curve, not only at its points
  --show result | rounds | forces (of E_k p_k: where the strip is held)
         | multiresolution (q_k and the details r_k, down so many --levels)
  --report OUT.json  energy (int |p''|^2, the parameter running from 0 to 1),
                   energy_gap, residuals

For grids there are bounded-harmonic, bounded-thin-plate and bounded-tension as
well: the scheme that the energy has on the rectangle with free sides. --rules
exact factors each level's energy, padded uses the rules of a small domain. The
numbers are the coefficients of hats (harmonic) or quadratics.

At the sides a grid of other schemes ends as --boundary says:
  reflect   the values mirrored: flat across the side, needs a symmetric mask
  open      only new values whose rules lie within the grid
  zero      zeros outside
  periodic  the grid again

For flows there are perfect-flow (no rotation but at the given vertices) and
slow-flow (creeping, smooth). The table has columns x, y, u, v and a row for each
vertex of a grid of square cells, in any order.
  --samples vertices  (default) u and v at (x, y); walls take the mean of their ends
            walls     u on the wall from (x, y) upward, v on that to the right
            rotors    a column rotation (u_y - v_x) instead, for --limit
  --kind commuting    (default) a cell's divergence passes to its four children:
                      a field without divergence keeps none, to rounding
         book         rotation as the law asks, divergence small
  --boundary extend   (default) nearest velocities outside; open and zero as above
  --limit             the flow that the exact scheme tends to, by its formula, at the
                      vertices of level K; the given flow is at rest outside
Written at vertices are velocity and speed, and but for the limit divergence,
rotation (u_y - v_x) and stream_function; cell_divergence in the cells.

Examples:
  batten subdivide examples/data/hand.csv --scheme natural-cubic --interpolate \
    --levels 4 -o hand.vtp --picture hand.png
  batten subdivide examples/data/plate.csv --scheme polyharmonic --order 2 \
    --method lp --size 9 --precision 3 --levels 3 -o plate.vti --picture plate.png
  batten subdivide examples/data/plate.csv --scheme bounded-harmonic --levels 2 -o h.vti
  batten subdivide examples/data/plate.csv --scheme bspline --order 4 --levels 3 -o plate.csv
  batten subdivide examples/data/eddies.csv --scheme slow-flow --samples walls \
    --levels 4 -o eddies.vtu --picture eddies.png
  batten subdivide examples/data/whirls.csv --scheme slow-flow --samples walls \
    --limit -o whirls.vti --picture whirls.png)";

std::vector<const char*> names_of_schemes() {
  std::vector<const char*> names = scheme_names();
  names.insert(names.end(), {"natural-cubic", "bounded-harmonic", "bounded-thin-plate", "bounded-tension",
                             "perfect-flow", "slow-flow"});
  return names;
}

void run_subdivide(const SubdivideArguments& arguments) {
  const auto names = names_of_schemes();
  if (std::find(names.begin(), names.end(), arguments.scheme.name) == names.end())
    throw UsageError("--scheme: " + unknown_scheme_text(arguments.scheme.name, names));
  for (const std::string& file : {arguments.output, arguments.picture, arguments.report})
    check_not_input(file, arguments.input);
  set_thread_count(arguments.threads);
  if (is_flow_scheme(arguments.scheme.name)) return subdivide_flow(arguments);
  refuse_flow_options(arguments);
  if (is_bounded_scheme(arguments.scheme.name)) return subdivide_bounded(arguments);
  is_curve(arguments) ? subdivide_curve(arguments) : subdivide_grid(arguments);
}

void add_flow_options(CLI::App& parser, SubdivideArguments& a) {
  parser.add_option("--kind", a.kind, "of flows: commuting (default) or book")
      ->option_text("NAME")
      ->check(CLI::IsMember({"commuting", "book"}));
  parser.add_option("--samples", a.samples, "of flows: at vertices (default), on walls, or rotors")
      ->option_text("WHERE")
      ->check(CLI::IsMember({"vertices", "walls", "rotors"}));
}

void add_curve_options(CLI::App& parser, SubdivideArguments& a) {
  parser.add_option("--columns", a.columns, "of the points; default: x, y, z, or the first two")
      ->option_text("COL ...")
      ->expected(1, 3);
  parser.add_option("--parameter", a.parameter, "uniform (default), centripetal, chord, or a column")
      ->option_text("NAME");
  parser.add_flag("--closed", a.closed, "join the last point of a curve to its first");
  parser.add_flag("--interpolate", a.interpolate, "natural-cubic through the points");
  parser.add_option("--smoothing", a.smoothing, "natural-cubic near the points")
      ->option_text("L")
      ->check(CLI::NonNegativeNumber);
  parser.add_option("--tolerance", a.tolerance, "natural-cubic so near to each point")
      ->option_text("E")
      ->check(CLI::PositiveNumber);
  parser.add_option("--tolerance-column", a.tolerance_column, "column of a tolerance for each point, times E")
      ->option_text("COL");
  parser.add_option("--minimum", a.minimum, "of one column of values: nowhere below")->option_text("V");
  parser.add_option("--maximum", a.maximum, "of one column of values: nowhere above")->option_text("V");
  parser.add_option("--report", a.report, "of curves: energy, gap, residuals")->option_text("OUT.json");
  parser.add_flag("--limit", a.limit, "of curves and flows: points of the limit instead");
  parser.add_option("--show", a.show, "what is written and drawn of natural-cubic")
      ->option_text("WHAT")
      ->check(CLI::IsMember({"result", "rounds", "forces", "multiresolution"}));
}

}  // namespace

Subcommand add_subdivide_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("subdivide", "Refine a curve, a control grid or a flow");
  const auto a = std::make_shared<SubdivideArguments>();
  parser
      ->add_option("INPUT", a->input,
                   "table of points or of a flow with a header, or matrix of numbers; - reads standard input")
      ->required()
      ->option_text(" ");
  parser->add_option("--scheme", a->scheme.name, "one of " + name_list(names_of_schemes()))
      ->required()
      ->option_text("NAME");
  add_making_options(*parser, a->scheme);
  parser->add_option("--levels", a->levels, "how often, default 3")->option_text("K")->check(CLI::Range(0, 12));
  parser
      ->add_option("--boundary", a->boundary, "default: reflect where the mask is symmetric, else open; flows: extend")
      ->option_text("NAME")
      ->check(CLI::IsMember({"reflect", "open", "zero", "periodic", "extend"}));
  parser->add_option("--rules", a->rules, "of bounded schemes: exact (default) or padded")
      ->option_text("WHICH")
      ->check(CLI::IsMember({"exact", "padded"}));
  parser->add_option("--tension", a->tension, "of bounded-tension: 0 thin plate, 1 membrane, default 0.9")
      ->option_text("T")
      ->check(CLI::Range(0., 1.));
  add_flow_options(*parser, *a);
  add_curve_options(*parser, *a);
  parser->add_option("-o,--output", a->output, "grids OUT.vti, flows OUT.vti or .vtu, curves OUT.vtp, all OUT.csv")
      ->required()
      ->option_text("OUT");
  auto* const picture = parser->add_option("--picture", a->picture, "of the result")->option_text("OUT.png");
  parser->add_option("--view", a->view, "of a grid's picture: surface (default) or map; flows have a map with arrows")
      ->option_text("VIEW")
      ->check(CLI::IsMember({"surface", "map"}))
      ->needs(picture);
  parser->add_option("--pixels", a->pixels, "size of a flow's picture, default 1200 900")
      ->option_text("W H")
      ->check(CLI::Range(200, 16000))
      ->needs(picture);
  parser->add_option("--threads", a->threads, "default: all of the machine; the result does not depend on it")
      ->option_text("N")
      ->check(CLI::Range(1, most_threads));
  parser->add_flag("--quiet", a->quiet, "print errors only");
  parser->footer(subdivide_help);
  return {parser, [a] { run_subdivide(*a); }};
}

}  // namespace batten
