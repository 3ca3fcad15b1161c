// SPDX-License-Identifier: GPL-3.0-or-later
// Block Lanczos iteration with thick restart, on BLAS 3.
#include "reducer/modes/block_lanczos.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <petscsys.h>
#include <Eigen/Cholesky>

// In a block of its own because it does not compile before the others.
#include <petscblaslapack.h>

#include "common/error.hpp"
#include "reducer/algebra/tall.hpp"

// Eigenvalue solver by divide and conquer, which PETSc's header lacks.
extern "C" void dsyevd_(const char*, const char*, const PetscBLASInt*, double*, const PetscBLASInt*, double*, double*,
                        const PetscBLASInt*, PetscBLASInt*, const PetscBLASInt*, PetscBLASInt*);

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using ColumnRange = Eigen::Ref<const MatrixXd>;
using Columns = Eigen::Map<MatrixXd, 0, Eigen::OuterStride<>>;  ///< views of the caller's array

/// C := A B.
void multiply_wide(const ColumnRange& A, const MatrixXd& B, MatrixXd& C) {
  const auto m = static_cast<PetscBLASInt>(C.rows()), n = static_cast<PetscBLASInt>(C.cols());
  const auto k = static_cast<PetscBLASInt>(A.cols()), lda = static_cast<PetscBLASInt>(A.outerStride());
  const auto ldb = static_cast<PetscBLASInt>(B.rows()), ldc = static_cast<PetscBLASInt>(C.outerStride());
  const double one = 1.0, zero = 0.0;
  BLASgemm_("N", "N", &m, &n, &k, &one, A.data(), &lda, B.data(), &ldb, &zero, C.data(), &ldc);
}

/// W := W R⁻¹ for upper triangular R.
void divide_by(const MatrixXd& R, MatrixXd& W) {
  const auto m = static_cast<PetscBLASInt>(W.rows()), n = static_cast<PetscBLASInt>(W.cols());
  const double one = 1.0;
  BLAStrsm_("R", "U", "N", "N", &m, &n, &one, R.data(), &n, W.data(), &m);
}

/// Replaces the first columns of V by V Z, a few rows at a time.
void combine_columns(const MatrixXd& Z, Eigen::Ref<MatrixXd> V) {
  constexpr Index rows = 512;
  MatrixXd part;
  for (Index first = 0; first < V.rows(); first += rows) {
    const Index count = std::min(rows, V.rows() - first);
    part.resize(count, Z.cols());
    multiply_wide(V.block(first, 0, count, Z.rows()), Z, part);
    V.block(first, 0, count, Z.cols()) = part;
  }
}

/// Eigenvalues of T, largest first, and its eigenvectors.
struct Ritz {
  VectorXd mu;
  MatrixXd Z;
};

Ritz ritz_of(MatrixXd T) {
  const auto n = static_cast<PetscBLASInt>(T.rows());
  VectorXd value(n);
  std::vector<double> work(1);
  std::vector<PetscBLASInt> iwork(1);
  PetscBLASInt lwork = -1, liwork = -1, info = 0;
  for (int pass = 0; pass < 2; ++pass) {
    dsyevd_("V", "L", &n, T.data(), &n, value.data(), work.data(), &lwork, iwork.data(), &liwork, &info);
    lwork = static_cast<PetscBLASInt>(work[0]);
    liwork = iwork[0];
    work.resize(static_cast<std::size_t>(lwork));
    iwork.resize(static_cast<std::size_t>(liwork));
  }
  TISSERAND_ENSURE(info == 0, "LAPACK found no eigenvalues of {} x {} numbers (info {})", n, n, info);
  return {value.reverse(), T.rowwise().reverse()};
}

class BlockLanczos {
 public:
  BlockLanczos(const ShiftedOperator& op, const LanczosControl& control, LanczosBasis basis)
      : op_(op),
        control_(control),
        block_(control.block),
        most_(static_cast<int>(basis.array.cols()) - basis.constraints - block_),
        initial_(basis.initial),
        all_(basis.array.data(), basis.array.rows(), basis.array.cols(),
             Eigen::OuterStride<>(basis.array.outerStride())),
        V_(all_.col(basis.constraints).data(), all_.rows(), most_ + block_, Eigen::OuterStride<>(all_.outerStride())),
        T_(MatrixXd::Zero(most_ + block_, most_ + block_)) {}

  LanczosPairs solve() {
    if (most_ < control_.wanted + 2 * block_ || !start()) return {};
    int next = first_look();
    for (;;) {
      if (!grow()) return {VectorXd(), steps_, true};
      ++steps_;
      const bool full = size_ + block_ > most_;
      if (size_ < next && !full && steps_ < control_.most_steps) continue;
      Ritz ritz = ritz_of(T_.topLeftCorner(size_, size_));
      op_.agree(ritz.mu.data(), ritz.mu.size());
      op_.agree(ritz.Z.data(), ritz.Z.size());
      const MatrixXd residual = R_ * ritz.Z.bottomRows(block_);
      const VectorXd error = control_.errors(ritz.mu, residual.colwise().norm());
      int converged = 0;
      while (converged < size_ && ritz.mu[converged] > 0.0 && error[converged] <= control_.tolerance) ++converged;
      if (control_.ends(steps_, converged, ritz.mu, error)) {
        combine_columns(ritz.Z.leftCols(converged), V_);
        return {ritz.mu.head(converged), steps_, false};
      }
      if (full) restart(ritz.mu, ritz.Z, residual);
      next = next_look(converged);
    }
  }

 private:
  /// Columns at the first computation of Ritz pairs; fewer cannot have converged.
  int first_look() const { return control_.wanted + 3 * block_; }
  /// Columns at the next one: a further pair needs about two columns, so this is two thirds of the way.
  int next_look(int converged) const { return size_ + std::max(block_, (control_.wanted - converged) * 4 / 3); }

  /// Makes the first block by one application of the operator to random vectors, which removes parts without mass.
  /// Initial vectors replace random ones; those beyond the block are added to them.
  bool start() {
    std::mt19937_64 random(20260101);
    MatrixXd X(op_.size, block_);
    for (double& x : X.reshaped()) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
    MatrixXd mine = X.middleRows(op_.first, op_.rows);
    mine.leftCols(std::min(initial_, block_)).setZero();
    for (int k = 0; k < initial_; ++k) mine.col(k % block_) += V_.col(k);
    W_ = op_.solve(op_.mass(mine));
    return normalise();
  }

  /// Applies the operator to the last block of V and appends the next one: OP V = V T + V_next R (0 .. 0 1).
  bool grow() {
    W_ = op_.solve(P_);
    const Index before =
        arrow_.rows() == size_ ? 0 : size_ - block_;  // the block before the last, or all after a restart
    if (size_ > 0) {
      const MatrixXd coupling = arrow_.rows() == size_ ? arrow_ : MatrixXd(R_.transpose());
      subtract_tall_product(V_.middleCols(before, size_ - before), coupling, W_);
      T_.block(before, size_, size_ - before, block_) = coupling;
      T_.block(size_, before, block_, size_ - before) = coupling.transpose();
    }
    const MatrixXd A = inner_products(P_, W_);
    T_.block(size_, size_, block_, block_) = 0.5 * (A + A.transpose());
    subtract_tall_product(V_.middleCols(size_, block_), T_.block(size_, size_, block_, block_), W_);
    size_ += block_;
    return normalise();
  }

  /// Computes V_next with W = V_next R, orthonormal and orthogonal to V (by M), and P = M V_next.
  bool normalise() {
    R_ = MatrixXd::Identity(block_, block_);
    for (int pass = 0; pass < 5; ++pass) {
      P_ = op_.mass(W_);
      const auto before = all_.leftCols(all_.cols() - V_.cols() + size_);  // constraints and V
      const MatrixXd H = inner_products(before, P_);
      subtract_tall_product(before, H, W_);
      const MatrixXd G = inner_products(W_, P_);
      const Eigen::LLT<MatrixXd> factor(0.5 * (G + G.transpose()));
      if (!op_.agree(factor.info() == Eigen::Success)) return false;
      MatrixXd R = factor.matrixU();
      op_.agree(R.data(), R.size());
      divide_by(R, W_);
      divide_by(R, P_);
      R_ = (R * R_).eval();
      if (!op_.agree(R_.diagonal().minCoeff() > 0.0)) return false;
      // If the pass removed little and the block is well conditioned, the next would change round-off only. The removed
      // part is not in T: with 1e-5 in place of 1e-9 residuals of 250 pairs were 1e-7.
      const VectorXd diagonal = R.diagonal();
      const double removed = H.size() > 0 ? H.cwiseAbs().maxCoeff() : 0.0;
      if (op_.agree(removed < 1e-9 * diagonal.minCoeff() && diagonal.minCoeff() > 1e-3 * diagonal.maxCoeff())) {
        V_.middleCols(size_, block_) = W_;
        return true;
      }
    }
    return false;
  }

  /// Keeps the leading Ritz vectors and continues from the last block.
  void restart(const VectorXd& mu, const MatrixXd& Z, const MatrixXd& residual) {
    const int kept = std::min(size_ - block_, control_.wanted + (size_ - control_.wanted) / 3);
    combine_columns(Z.leftCols(kept), V_);
    V_.middleCols(kept, block_) = W_;
    T_.setZero();
    T_.diagonal().head(kept) = mu.head(kept);
    arrow_ = residual.leftCols(kept).transpose();
    size_ = kept;
  }

  /// Aᵀ B, summed over the rows of all processes.
  MatrixXd inner_products(const ColumnRange& A, const ColumnRange& B) const {
    MatrixXd C = tall_inner_products(A, B);
    op_.sum(C.data(), C.size());
    return C;
  }

  const ShiftedOperator& op_;
  const LanczosControl& control_;
  int block_;    ///< columns of a block
  int most_;     ///< columns of V at which the iteration is restarted
  int initial_;  ///< number of initial vectors
  Columns all_;  ///< constraints and V
  Columns V_;
  MatrixXd T_;
  MatrixXd W_;      ///< vectors from which the next block is made
  MatrixXd P_;      ///< M times the last block of V
  MatrixXd R_;      ///< block x block
  MatrixXd arrow_;  ///< after a restart: coupling of the kept vectors to the first block that follows them
  int size_ = 0;    ///< columns of V before its last block
  int steps_ = 0;   ///< number of solved blocks
};

}  // namespace

int lanczos_block(int wanted) { return wanted < 200 ? 8 : 16; }

int lanczos_columns(int wanted, int block) { return 5 * wanted / 2 + 10 * block; }

LanczosPairs block_lanczos(const ShiftedOperator& op, const LanczosControl& control, LanczosBasis basis) {
  return BlockLanczos(op, control, basis).solve();
}

}  // namespace tisserand::reducer
