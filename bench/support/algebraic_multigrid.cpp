// SPDX-License-Identifier: MIT
#include <batten/bench/support/algebraic_multigrid.h>
#include <batten/bench/support/timing.h>

#include <stdexcept>
#include <vector>

#ifdef BATTEN_WITH_HYPRE

#include <HYPRE.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>

namespace batten {
namespace {

/// Starts MPI once, and ends it with the program.
struct Session {
  Session() {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  ~Session() {
    HYPRE_Finalize();
    MPI_Finalize();
  }
};

HYPRE_IJMatrix whole_matrix(const Eigen::SparseMatrix<double>& lower) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> a = lower.selfadjointView<Eigen::Lower>();
  const auto n = static_cast<HYPRE_BigInt>(a.rows());
  HYPRE_IJMatrix matrix;
  HYPRE_IJMatrixCreate(MPI_COMM_WORLD, 0, n - 1, 0, n - 1, &matrix);
  HYPRE_IJMatrixSetObjectType(matrix, HYPRE_PARCSR);
  HYPRE_IJMatrixInitialize(matrix);
  for (HYPRE_BigInt i = 0; i < n; ++i) {
    std::vector<HYPRE_BigInt> columns;
    std::vector<double> values;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(a, i); it; ++it) {
      columns.push_back(static_cast<HYPRE_BigInt>(it.col()));
      values.push_back(it.value());
    }
    HYPRE_Int count = static_cast<HYPRE_Int>(columns.size());
    HYPRE_IJMatrixSetValues(matrix, 1, &count, &i, columns.data(), values.data());
  }
  HYPRE_IJMatrixAssemble(matrix);
  return matrix;
}

HYPRE_IJVector vector_of(std::span<const double> values) {
  HYPRE_IJVector vector;
  const auto n = static_cast<HYPRE_BigInt>(values.size());
  HYPRE_IJVectorCreate(MPI_COMM_WORLD, 0, n - 1, &vector);
  HYPRE_IJVectorSetObjectType(vector, HYPRE_PARCSR);
  HYPRE_IJVectorInitialize(vector);
  std::vector<HYPRE_BigInt> rows;
  for (HYPRE_BigInt i = 0; i < n; ++i) rows.push_back(i);
  HYPRE_IJVectorSetValues(vector, n, rows.data(), values.data());
  HYPRE_IJVectorAssemble(vector);
  return vector;
}

}  // namespace

bool has_algebraic_multigrid() { return true; }

AlgebraicMultigridCost solve_by_algebraic_multigrid(const Eigen::SparseMatrix<double>& lower, std::span<const double> b,
                                                    double accuracy) {
  static const Session session;
  HYPRE_IJMatrix matrix = whole_matrix(lower);
  HYPRE_IJVector right = vector_of(b), unknown = vector_of(std::vector<double>(b.size()));
  HYPRE_ParCSRMatrix a;
  HYPRE_ParVector rhs, x;
  HYPRE_IJMatrixGetObject(matrix, reinterpret_cast<void**>(&a));
  HYPRE_IJVectorGetObject(right, reinterpret_cast<void**>(&rhs));
  HYPRE_IJVectorGetObject(unknown, reinterpret_cast<void**>(&x));
  HYPRE_Solver amg, pcg;
  HYPRE_BoomerAMGCreate(&amg);
  HYPRE_BoomerAMGSetTol(amg, 0);
  HYPRE_BoomerAMGSetMaxIter(amg, 1);
  HYPRE_BoomerAMGSetPrintLevel(amg, 0);
  HYPRE_ParCSRPCGCreate(MPI_COMM_WORLD, &pcg);
  HYPRE_PCGSetMaxIter(pcg, 2000);
  HYPRE_PCGSetTol(pcg, accuracy);
  HYPRE_PCGSetPrecond(pcg, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                      reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), amg);
  AlgebraicMultigridCost cost;
  cost.set_up = seconds_of([&] { HYPRE_ParCSRPCGSetup(pcg, a, rhs, x); });
  cost.solution = seconds_of([&] { HYPRE_ParCSRPCGSolve(pcg, a, rhs, x); });
  HYPRE_PCGGetNumIterations(pcg, &cost.iterations);
  HYPRE_ParCSRPCGDestroy(pcg);
  HYPRE_BoomerAMGDestroy(amg);
  HYPRE_IJVectorDestroy(right);
  HYPRE_IJVectorDestroy(unknown);
  HYPRE_IJMatrixDestroy(matrix);
  return cost;
}

}  // namespace batten

#else

namespace batten {

bool has_algebraic_multigrid() { return false; }

AlgebraicMultigridCost solve_by_algebraic_multigrid(const Eigen::SparseMatrix<double>&, std::span<const double>,
                                                    double) {
  throw std::runtime_error("solve_by_algebraic_multigrid: expected a build with hypre");
}

}  // namespace batten

#endif
