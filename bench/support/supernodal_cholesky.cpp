// SPDX-License-Identifier: MIT
#include <batten/bench/support/supernodal_cholesky.h>
#include <batten/domains/errors.h>

#include <cholmod.h>
#include <dlfcn.h>

#include <algorithm>
#include <utility>

namespace batten {

struct SupernodalCholesky::State {
  cholmod_common common{};
  Eigen::SparseMatrix<double> lower;
  cholmod_sparse matrix{};  // refers to `lower`
  cholmod_factor* factor = nullptr;

  explicit State(Eigen::SparseMatrix<double> l) : lower(std::move(l)) {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  void check(const char* step) const {
    if (common.status != CHOLMOD_OK || factor == nullptr)
      throw SolverError(std::string("CHOLMOD: ") + step + " ended with status " + std::to_string(common.status));
  }
};

SupernodalCholesky::SupernodalCholesky(Eigen::SparseMatrix<double> matrix)
    : state_(std::make_unique<State>(std::move(matrix))) {
  auto& lower = state_->lower;
  auto& m = state_->matrix;
  m.nrow = m.ncol = static_cast<std::size_t>(lower.rows());
  m.nzmax = static_cast<std::size_t>(lower.nonZeros());
  m.p = lower.outerIndexPtr();
  m.i = lower.innerIndexPtr();
  m.x = lower.valuePtr();
  m.stype = -1;
  m.itype = CHOLMOD_INT;
  m.xtype = CHOLMOD_REAL;
  m.dtype = CHOLMOD_DOUBLE;
  m.sorted = m.packed = 1;
  state_->factor = cholmod_analyze(&m, &state_->common);
  state_->check("the analysis");
}

SupernodalCholesky::~SupernodalCholesky() = default;

std::size_t SupernodalCholesky::factor_bytes() const { return state_->factor->xsize * sizeof(double); }

void SupernodalCholesky::factor() {
  cholmod_factorize(&state_->matrix, state_->factor, &state_->common);
  state_->check("the factorisation");
}

void SupernodalCholesky::solve(std::span<double> b) {
  cholmod_dense right{};
  right.nrow = right.nzmax = right.d = b.size();
  right.ncol = 1;
  right.x = b.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, state_->factor, &right, &state_->common);
  if (solution == nullptr)
    throw SolverError("CHOLMOD: the solution ended with status " + std::to_string(state_->common.status));
  std::copy_n(static_cast<const double*>(solution->x), b.size(), b.begin());
  cholmod_free_dense(&solution, &state_->common);
}

std::string use_one_blas_thread() {
  const auto set_threads = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  const auto configuration = reinterpret_cast<char* (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_config"));
  if (set_threads == nullptr || configuration == nullptr)
    return "not OpenBLAS (install libopenblas-dev for a fair comparison)";
  set_threads(1);
  return std::string(configuration()) + ", 1 thread";
}

}  // namespace batten
