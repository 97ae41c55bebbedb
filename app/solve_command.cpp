// SPDX-License-Identifier: MIT
#include <batten/app/problem_templates.h>
#include <batten/app/solve_command.h>
#include <batten/app/solve_flow.h>
#include <batten/app/solve_outputs.h>
#include <batten/app/solve_series.h>
#include <batten/app/solve_work.h>
#include <batten/app/thread_count.h>
#include <batten/app/usage_error.h>
#include <batten/domains/errors.h>
#include <batten/fem/plate_forces.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace batten {
namespace {

void write_rest(SolveWork& work) {
  const BoundaryResult& result = *work.account.result;
  const auto& problem = work.file.problem;
  work.progress.show(problem.is_plate() ? "moments and forces" : "samples");
  const GridSamples grid = samples_of(result.solution, problem);
  if (problem.is_plate() && !problem.sides.left.periodic && !problem.sides.bottom.periodic)
    work.account.corners = corner_forces(result.solution, std::get<KirchhoffPlate>(problem.material));
  for (const PointArray& array : grid.arrays)
    if (array.components == 1) work.account.extremes.push_back(extremes_of(grid, array));
  const SolveArguments& arguments = work.arguments;
  work.progress.show("write " + arguments.output);
  write_solution({arguments.output,
                  &result.solution,
                  &work.file,
                  {{"energy", result.energy}, {"compliance", result.compliance}, {"accuracy", result.accuracy}}},
                 grid);
  work.account.files.push_back(arguments.output);
  if (arguments.picture.empty()) return;
  work.progress.show("draw " + arguments.picture);
  draw_surface_picture(arguments.picture, grid, work.file.unknown(), "");
  work.account.files.push_back(arguments.picture);
}

void solve_at_rest(SolveWork& work) {
  work.account.result = solve_boundary_problem(work.file.problem, work.options());
  const BoundaryResult& result = *work.account.result;
  work.account.notes = result.notes;
  work.end_solve(result.accuracy, result.seconds);
  write_rest(work);
  work.end_phase("write");
}

void check_arguments(const SolveArguments& arguments) {
  if (arguments.problem.empty()) throw UsageError("PROBLEM is required, or --template KIND");
  if (arguments.output.empty()) throw UsageError("--output is required");
}

void print(const SolveAccount& account) {
  if (account.arguments->quiet) return;
  for (const std::string& text : account.notes) std::cerr << "batten: note: " << text << '\n';
  std::cout << summary_of(account) << std::flush;
}

void run_solve(const SolveArguments& arguments) {
  if (!arguments.template_kind.empty()) {
    std::cout << problem_template(arguments.template_kind) << std::flush;
    return;
  }
  check_arguments(arguments);
  check_solve_outputs(arguments);
  set_thread_count(arguments.threads);
  Progress progress("batten solve", arguments.quiet);
  Stopwatch total;
  progress.show("read");
  const ProblemFile file = read_problem(arguments.problem);
  check_series_outputs(arguments, file);
  SolveAccount account{.arguments = &arguments, .file = &file};
  SolveWork work{arguments, file, progress, account};
  account.seconds.push_back({"read", total.lap()});
  double elapsed = account.seconds.back().seconds;
  if (file.flow)
    solve_flow(work);
  else if (file.modes)
    solve_modes(work);
  else if (file.motion)
    solve_motion(work);
  else
    solve_at_rest(work);
  elapsed += total.lap();
  account.seconds.push_back({"total", elapsed});
  if (!arguments.report.empty()) {
    write_report(account);
    account.files.push_back(arguments.report);
  }
  progress.erase();
  print(account);
}

}  // namespace

Subcommand add_solve_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("solve", "Membranes, heat, plates and slow flows from a problem file");
  const auto a = std::make_shared<SolveArguments>();
  parser->add_option("PROBLEM", a->problem, "the problem, a TOML file (docs/solve.md)")->option_text(" ");
  auto* const kind = parser
                         ->add_option("--template", a->template_kind,
                                      "print a commented problem file to start from and end: " + template_kinds())
                         ->option_text("KIND");
  kind->check([](const std::string& text) {
    return problem_template(text) ? std::string()
                                  : "there is no template '" + text + "'; there are " + template_kinds();
  });
  parser->add_option("-o,--output", a->output, "the solution; of modes OUT_mode1.vti ..., of motion OUT_0000.vti ...")
      ->option_text("OUT.vti|OUT.vtu");
  parser
      ->add_option("--picture", a->picture,
                   "the solution; of motion its end; of modes maps with nodal lines; of a flow streamlines")
      ->option_text("OUT.png");
  parser->add_option("--report", a->report, "numbers about the solution")->option_text("OUT.json");
  parser->add_option("--threads", a->threads, "default: all of the machine; the result does not depend on it")
      ->option_text("N")
      ->check(CLI::Range(1, most_threads));
  parser->add_flag("--quiet", a->quiet, "print errors only");
  parser->footer(solve_help);
  return {parser, [a] { run_solve(*a); }};
}

}  // namespace batten
