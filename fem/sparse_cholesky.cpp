// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/sparse_cholesky.h>

#include <cholmod.h>

#include <algorithm>
#include <string>

namespace batten {

struct SparseCholesky::Factor {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* solution = nullptr;  // kept between solves, so that they do not allocate
  cholmod_dense* workspace_y = nullptr;
  cholmod_dense* workspace_e = nullptr;

  Factor() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 1;
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&workspace_y, &common);
    cholmod_free_dense(&workspace_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& lower) : factor_(std::make_unique<Factor>()) {
  Eigen::SparseMatrix<double> matrix = lower;
  matrix.makeCompressed();
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = matrix.outerIndexPtr();
  view.i = matrix.innerIndexPtr();
  view.x = matrix.valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  auto& common = factor_->common;
  factor_->factor = cholmod_analyze(&view, &common);
  if (factor_->factor != nullptr) cholmod_factorize(&view, factor_->factor, &common);
  if (common.status != CHOLMOD_OK || factor_->factor == nullptr)
    throw SolverError("SparseCholesky: expected a positive definite matrix of " + std::to_string(matrix.rows()) +
                      " rows, found CHOLMOD status " + std::to_string(common.status));
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

int SparseCholesky::size() const { return static_cast<int>(factor_->factor->n); }

void SparseCholesky::solve(std::span<double> b) const {
  cholmod_dense right{};
  right.nrow = right.nzmax = right.d = b.size();
  right.ncol = 1;
  right.x = b.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  auto& f = *factor_;
  if (!cholmod_solve2(CHOLMOD_A, f.factor, &right, nullptr, &f.solution, nullptr, &f.workspace_y, &f.workspace_e,
                      &f.common))
    throw SolverError("SparseCholesky::solve: CHOLMOD status " + std::to_string(f.common.status));
  std::copy_n(static_cast<const double*>(f.solution->x), b.size(), b.begin());
}

}  // namespace batten
