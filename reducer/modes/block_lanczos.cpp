// Block Lanczos iteration with thick restart, on BLAS 3; over all ranks where the factor lies on them.
#include "reducer/modes/block_lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include <petscsys.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

// Does not compile before the others, so it has a block of its own.
#include <petscblaslapack.h>

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A hundredth of the residual that modes may have: one step of inverse iteration follows, which need not lower it.
constexpr double converged_residual = 1e-10;

using ColumnRange = Eigen::Ref<const MatrixXd>;

/// C := C + factor A B.
void add_times(double factor, const ColumnRange& A, const MatrixXd& B, Eigen::Ref<MatrixXd> C) {
  const auto m = static_cast<PetscBLASInt>(C.rows()), n = static_cast<PetscBLASInt>(C.cols());
  const auto k = static_cast<PetscBLASInt>(A.cols()), lda = static_cast<PetscBLASInt>(A.outerStride());
  const auto ldb = static_cast<PetscBLASInt>(B.rows()), ldc = static_cast<PetscBLASInt>(C.outerStride());
  const double one = 1.0;
  if (k > 0) BLASgemm_("N", "N", &m, &n, &k, &factor, A.data(), &lda, B.data(), &ldb, &one, C.data(), &ldc);
}

/// Aᵀ B.
MatrixXd inner_products(const ColumnRange& A, const ColumnRange& B) {
  MatrixXd C = MatrixXd::Zero(A.cols(), B.cols());
  const auto m = static_cast<PetscBLASInt>(C.rows()), n = static_cast<PetscBLASInt>(C.cols());
  const auto k = static_cast<PetscBLASInt>(A.rows()), lda = static_cast<PetscBLASInt>(A.outerStride());
  const auto ldb = static_cast<PetscBLASInt>(B.outerStride());
  const double one = 1.0;
  if (m > 0) BLASgemm_("T", "N", &m, &n, &k, &one, A.data(), &lda, B.data(), &ldb, &one, C.data(), &m);
  return C;
}

/// W := W R⁻¹ for upper triangular R.
void divide_by(const MatrixXd& R, MatrixXd& W) {
  const auto m = static_cast<PetscBLASInt>(W.rows()), n = static_cast<PetscBLASInt>(W.cols());
  const double one = 1.0;
  BLAStrsm_("R", "U", "N", "N", &m, &n, &one, R.data(), &n, W.data(), &m);
}

/// The first columns of V := V Z, in place, a few rows at a time.
void combine_columns(const MatrixXd& Z, MatrixXd& V) {
  constexpr Index rows = 512;
  MatrixXd part;
  for (Index first = 0; first < V.rows(); first += rows) {
    const Index count = std::min(rows, V.rows() - first);
    part.setZero(count, Z.cols());
    add_times(1.0, V.block(first, 0, count, Z.rows()), Z, part);
    V.block(first, 0, count, Z.cols()) = part;
  }
}

/// What the iteration applies, to the rows that this process has.
struct Operator {
  double shift = 0.0;
  Index size = 0;   ///< rows of all
  Index first = 0;  ///< the first row of this process
  Index rows = 0;   ///< how many it has
  bool shared = false;
  std::function<MatrixXd(const MatrixXd&)> mass;   ///< M X
  std::function<MatrixXd(const MatrixXd&)> solve;  ///< (S − shift M)⁻¹ X
  std::function<void(double)> share;               ///< hears how much is done

  /// Aᵀ B over the rows of all.
  MatrixXd inner_products(const ColumnRange& A, const ColumnRange& B) const {
    MatrixXd C = reducer::inner_products(A, B);
    if (shared && C.size() > 0) sum_over_ranks(C.data(), C.size());
    return C;
  }
  /// The numbers of the leader for all, so that no rank decides otherwise than the others.
  void agree(double* values, Index count) const {
    if (shared) broadcast(values, count);
  }
  bool agree(bool value) const {
    double number = value ? 1.0 : 0.0;
    agree(&number, 1);
    return number != 0.0;
  }
};

class BlockLanczos {
 public:
  BlockLanczos(Operator op, int wanted)
      : op_(std::move(op)),
        wanted_(wanted),
        most_(static_cast<int>(std::min<Index>(2 * wanted + 9 * lanczos_block, op_.size))),
        V_(op_.rows, most_ + lanczos_block),
        T_(MatrixXd::Zero(most_ + lanczos_block, most_ + lanczos_block)) {}

  std::optional<EigenPairs> solve() {
    constexpr int most_steps = 1000;
    if (most_ < wanted_ + 2 * lanczos_block || !start()) return std::nullopt;
    for (int step = 0; step < most_steps; ++step) {
      if (!grow()) return std::nullopt;
      const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(T_.topLeftCorner(size_, size_));
      Eigen::VectorXd mu = ritz.eigenvalues().reverse();
      MatrixXd Z = ritz.eigenvectors().rowwise().reverse();
      op_.agree(mu.data(), mu.size());
      op_.agree(Z.data(), Z.size());
      const MatrixXd residual = R_ * Z.bottomRows(lanczos_block);
      int converged = 0;
      while (converged < size_ && op_.agree(residual.col(converged).norm() <= converged_residual * mu[converged]))
        ++converged;
      tell(converged);
      if (converged >= wanted_) return pairs(mu.head(converged), Z.leftCols(converged));
      if (size_ + lanczos_block > most_) restart(mu, Z, residual);
    }
    return std::nullopt;
  }

 private:
  /// Pairs converge late: at first the columns count, of three times as many as pairs and 60 that it usually takes.
  void tell(int converged) {
    ++blocks_;
    const double columns = lanczos_block * blocks_ / (3.0 * wanted_ + 60.0);
    op_.share(std::max(static_cast<double>(converged) / wanted_, std::min(columns, 0.95)));
  }

  /// The first block: one application of the operator to random vectors, so that it has nothing without mass.
  bool start() {
    std::mt19937_64 random(20260101);
    MatrixXd X(op_.size, lanczos_block);
    for (double& x : X.reshaped()) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
    W_ = op_.solve(op_.mass(X.middleRows(op_.first, op_.rows)));
    return normalise();
  }

  /// Applies the operator to the last block of V and appends the next one: OP V = V T + V_next R (0 .. 0 1).
  bool grow() {
    W_ = op_.solve(P_);
    const Index before =
        arrow_.rows() == size_ ? 0 : size_ - lanczos_block;  // the block before the last, or all after a restart
    if (size_ > 0) {
      const MatrixXd coupling = arrow_.rows() == size_ ? arrow_ : MatrixXd(R_.transpose());
      add_times(-1.0, V_.middleCols(before, size_ - before), coupling, W_);
      T_.block(before, size_, size_ - before, lanczos_block) = coupling;
      T_.block(size_, before, lanczos_block, size_ - before) = coupling.transpose();
    }
    const MatrixXd A = op_.inner_products(P_, W_);
    T_.block(size_, size_, lanczos_block, lanczos_block) = 0.5 * (A + A.transpose());
    add_times(-1.0, V_.middleCols(size_, lanczos_block), T_.block(size_, size_, lanczos_block, lanczos_block), W_);
    size_ += lanczos_block;
    return normalise();
  }

  /// W = V_next R, V_next orthonormal and orthogonal to V (by M); P = M V_next.
  bool normalise() {
    R_ = MatrixXd::Identity(lanczos_block, lanczos_block);
    for (int pass = 0; pass < 5; ++pass) {
      P_ = op_.mass(W_);
      const MatrixXd H = op_.inner_products(V_.leftCols(size_), P_);
      add_times(-1.0, V_.leftCols(size_), H, W_);
      const MatrixXd G = op_.inner_products(W_, P_);
      const Eigen::LLT<MatrixXd> factor(0.5 * (G + G.transpose()));
      if (!op_.agree(factor.info() == Eigen::Success)) return false;
      MatrixXd R = factor.matrixU();
      op_.agree(R.data(), R.size());
      divide_by(R, W_);
      divide_by(R, P_);
      R_ = (R * R_).eval();
      if (!op_.agree(R_.diagonal().minCoeff() > 0.0)) return false;
      // What the pass removed was small and the block well conditioned: the next would change round-off only.
      const Eigen::VectorXd diagonal = R.diagonal();
      const double removed = size_ > 0 ? H.cwiseAbs().maxCoeff() : 0.0;
      if (op_.agree(removed < 1e-9 * diagonal.minCoeff() && diagonal.minCoeff() > 1e-3 * diagonal.maxCoeff())) {
        V_.middleCols(size_, lanczos_block) = W_;
        return true;
      }
    }
    return false;
  }

  /// Keeps the leading Ritz vectors and goes on from the last block.
  void restart(const Eigen::VectorXd& mu, const MatrixXd& Z, const MatrixXd& residual) {
    const int kept = std::min(size_ - lanczos_block, wanted_ + (size_ - wanted_) / 3);
    combine_columns(Z.leftCols(kept), V_);
    V_.middleCols(kept, lanczos_block) = W_;
    T_.setZero();
    T_.diagonal().head(kept) = mu.head(kept);
    arrow_ = residual.leftCols(kept).transpose();
    size_ = kept;
  }

  EigenPairs pairs(const Eigen::VectorXd& mu, const MatrixXd& Z) {
    combine_columns(Z, V_);
    V_.conservativeResize(Eigen::NoChange, Z.cols());
    return {(op_.shift + mu.array().inverse()).matrix(), std::move(V_)};
  }

  Operator op_;
  int wanted_;
  int most_;  ///< columns of V at which the iteration is restarted
  MatrixXd V_;
  MatrixXd T_;
  MatrixXd W_;      ///< what becomes the next block
  MatrixXd P_;      ///< M times the last block of V
  MatrixXd R_;      ///< lanczos_block x lanczos_block
  MatrixXd arrow_;  ///< after a restart: coupling of the kept vectors to the first block that follows them
  int size_ = 0;    ///< columns of V before its last block
  int blocks_ = 0;  ///< how many were solved for
};

/// The same by all ranks: M of the leader, its rows of the vectors and at the end all of them. Collective.
std::optional<EigenPairs> search_by_ranks(const Mumps& factor, const SymmetricRows& M, double shift, int wanted,
                                          std::function<void(double)> share) {
  broadcast(&shift, 1);
  const Matrix mass = spread(M);
  const Share mine = rows_of_rank(factor.rows(), rank_number());
  Operator op{shift, factor.rows(), mine.first, mine.end - mine.first, true, nullptr, nullptr, std::move(share)};
  op.mass = [&mass](const MatrixXd& X) { return multiply_rows(mass, X); };
  op.solve = [&factor](const MatrixXd& X) { return factor.solve(X); };
  std::optional<EigenPairs> pairs = BlockLanczos(std::move(op), wanted).solve();
  if (pairs) pairs->vector = gather_rows(pairs->vector, factor.rows());
  return pairs;
}

}  // namespace

std::optional<EigenPairs> block_lanczos(const Pencil& pencil, int wanted) {
  if (const SharedFactor* const shared = pencil.factor.shared()) {
    call_followers({Task::search, shared->number(), wanted});
    return all_or_none(
        [&] { return search_by_ranks(shared->mumps(), symmetric_rows(pencil.M), pencil.shift, wanted, pencil.share); });
  }
  Operator op{pencil.shift, pencil.S.size(), 0, pencil.S.size(), false, nullptr, nullptr, pencil.share};
  op.mass = [&pencil](const MatrixXd& X) { return multiply(pencil.M, X); };
  op.solve = [&pencil](const MatrixXd& X) { return pencil.factor.solve(X); };
  return BlockLanczos(std::move(op), wanted).solve();
}

void help_to_search(const Mumps& factor, int wanted) {
  search_by_ranks(factor, {}, 0.0, wanted, [](double /*done*/) {});
}

}  // namespace tisserand::reducer
