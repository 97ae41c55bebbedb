// SPDX-License-Identifier: MIT
// The clamped square plate under uniform load against other software: CHOLMOD's supernodal factorisation at 512² cells
// and hypre's BoomerAMG with conjugate gradients at 256² on the same matrix of bicubic splines, and FreeFEM's Morley
// elements with UMFPACK as a whole process at equal error of the centre deflection.
#include <batten/bench/support/algebraic_multigrid.h>
#include <batten/bench/support/child_process.h>
#include <batten/bench/support/places.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/supernodal_cholesky.h>
#include <batten/bench/support/timing.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/load_vector.h>
#include <batten/fem/solution.h>
#include <batten/io/image_file.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace batten {
namespace {

using Vector = std::vector<double>;

constexpr double centre_deflection = 0.00126531908748;  // q = D = a = 1
constexpr double accuracy = 1e-10;

BoundaryProblem clamped_plate(int cells) {
  const Side side = Side::clamped();
  BoundaryProblem problem{
      KirchhoffPlate{}, {Interval(0, 1, cells), Interval(0, 1, cells)}, 3, {side, side, side, side}, {}, {}};
  problem.loads.area = 1.;
  return problem;
}

/// The matrix and right-hand side of the functions that keep the conditions, numbered without the others.
struct Assembled {
  Eigen::SparseMatrix<double> lower;
  Vector b;
};

Assembled assemble(const BoundarySystem& system, const Vector& b) {
  const auto& space = system.space();
  const auto& energy = system.hierarchy().finest().energy;
  const int d = space.x.degree(), nx = space.x.size(), ny = space.y.size();
  std::vector<int> number(space.size(), -1);
  Assembled result;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      if (space.x.is_removed(i) || space.y.is_removed(j)) continue;
      number[static_cast<std::size_t>(j * nx + i)] = static_cast<int>(result.b.size());
      result.b.push_back(b[static_cast<std::size_t>(j * nx + i)]);
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int q = j; q <= std::min(ny - 1, j + d); ++q)
        for (int p = q == j ? i : std::max(0, i - d); p <= std::min(nx - 1, i + d); ++p) {
          const int row = number[static_cast<std::size_t>(q * nx + p)],
                    column = number[static_cast<std::size_t>(j * nx + i)];
          if (row >= 0 && column >= 0) entries.emplace_back(row, column, energy.entry(i, j, p, q));
        }
  const auto n = static_cast<Eigen::Index>(result.b.size());
  result.lower.resize(n, n);
  result.lower.setFromTriplets(entries.begin(), entries.end());
  return result;
}

struct Ours {
  double set_up = 0, solution = 0;
  int iterations = 0;
};

Ours solve_ours(int cells) {
  const BoundaryProblem problem = clamped_plate(cells);
  Ours cost;
  cost.set_up = least_seconds(3, [&] { const BoundarySystem system(problem); });
  const BoundarySystem system(problem);
  const Vector b = system.restricted(load_vector(problem));
  Vector c(b.size());
  cost.solution = least_seconds(5, [&] {
    std::fill(c.begin(), c.end(), 0.);
    cost.iterations = solve(system.multigrid(), b, c, {.accuracy = accuracy}).iterations;
  });
  return cost;
}

void compare_cholmod(Report& report, int cells) {
  const BoundarySystem system(clamped_plate(cells));
  auto assembled = assemble(system, system.restricted(load_vector(clamped_plate(cells))));
  double factor = 0, solution = 0;
  {
    SupernodalCholesky direct(std::move(assembled.lower));
    factor = seconds_of([&] { direct.factor(); });
    solution = seconds_of([&] { direct.solve(assembled.b); });
  }
  const Ours ours = solve_ours(cells);
  report.row({"CHOLMOD", cells, ours.iterations, ours.set_up, ours.solution, factor + solution,
              (factor + solution) / ours.solution, (factor + solution) / (ours.solution + ours.set_up)});
  report.at_least("CHOLMOD's factorisation and solution over our solution, 512^2", 100,
                  (factor + solution) / ours.solution);
}

void compare_boomeramg(Report& report, int cells) {
  if (!has_algebraic_multigrid()) return report.note("hypre", "not in this build");
  const BoundarySystem system(clamped_plate(cells));
  const auto assembled = assemble(system, system.restricted(load_vector(clamped_plate(cells))));
  const auto amg = solve_by_algebraic_multigrid(assembled.lower, assembled.b, accuracy);
  const Ours ours = solve_ours(cells);
  const double theirs = amg.set_up + amg.solution;
  report.note("BoomerAMG's iterations", amg.iterations);
  report.row({"BoomerAMG-PCG", cells, ours.iterations, ours.set_up, ours.solution, theirs, theirs / ours.solution,
              theirs / (ours.solution + ours.set_up)});
  report.at_least("BoomerAMG's time over our solution, 256^2", 30, theirs / ours.solution);
}

std::string freefem_script(int cells) {
  return "load \"Morley\"\n"
         "mesh Th = square(" +
         std::to_string(cells) + ", " + std::to_string(cells) +
         ");\n"
         "fespace Vh(Th, P2Morley);\n"
         "Vh [w, wx, wy], [v, vx, vy];\n"
         "macro bilap(w, v) (dxx(w)*dxx(v) + dyy(w)*dyy(v) + 2.*dxy(w)*dxy(v)) //\n"
         "solve plate([w, wx, wy], [v, vx, vy], solver = UMFPACK) =\n"
         "  int2d(Th)(bilap(w, v)) - int2d(Th)(v) + on(1, 2, 3, 4, w = 0, wx = 0, wy = 0);\n"
         "ofstream out(\"centre.txt\");\n"
         "out.precision(14);\n"
         "out << w(0.5, 0.5) << endl;\n";
}

double relative_error(double centre) { return std::abs(centre / centre_deflection - 1); }

/// Cells of ours and of Morley's elements at which the centre deflection is right to 1e-4.
void compare_freefem(Report& report) {
  const std::string program = "FreeFem++-nw";
  if (!is_installed(program)) return report.note("FreeFEM", "not installed");
  constexpr int morley_cells = 408, our_cells = 12;
  const ScratchFolder scratch;
  std::ofstream(scratch.file("plate.edp")) << freefem_script(morley_cells);
  std::ofstream(scratch.file("plate.toml"))
      << "problem = \"plate\"\nx = [0, 1]\ny = [0, 1]\ncells = [" << our_cells << ", " << our_cells
      << "]\n[load]\nq = 1\n[sides]\nleft = \"clamped\"\nright = \"clamped\"\nbottom = \"clamped\"\ntop = "
         "\"clamped\"\n";
  const ChildCost theirs =
      run_child({{"env", "FF_LOADPATH=/usr/lib/freefem++;;", program, "-nw", "-v", "0", "plate.edp"}, scratch.path()});
  ChildCost ours;
  ours.seconds = 1e9;
  for (int k = 0; k < 5; ++k) {
    const auto cost =
        run_child({{batten_command(), "solve", "plate.toml", "-o", "plate.vti", "--quiet"}, scratch.path()});
    if (cost.seconds < ours.seconds) ours = cost;
  }
  double centre = 0;
  std::ifstream(scratch.file("centre.txt")) >> centre;
  const double our_centre = Solution::from_record(read_record(scratch.file("plate.vti"))).value(0.5, 0.5);
  report.table("whole processes", {"program", "cells", "relative error of the centre", "seconds"});
  report.row({"FreeFEM, Morley, UMFPACK", morley_cells, relative_error(centre), theirs.seconds});
  report.row({"batten solve, degree 3", our_cells, relative_error(our_centre), ours.seconds});
  report.at_most("our relative error of the centre", 1e-4, relative_error(our_centre));
  report.at_least("FreeFEM's relative error of the centre over ours", 1,
                  relative_error(centre) / relative_error(our_centre));
  report.at_least("FreeFEM's time over ours at 1e-4", 100, theirs.seconds / ours.seconds);
}

void measure(Report& report) {
  report.note("BLAS below CHOLMOD", use_one_blas_thread());
  report.table("the same matrix, to 1e-10", {"solver", "cells", "our iterations", "our set-up, s", "our solution, s",
                                             "its time, s", "its time / our solution", "its time / ours with set-up"});
  compare_cholmod(report, 512);
  compare_boomeramg(report, 256);
  compare_freefem(report);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "plate_peers", batten::measure); }
