// Block Lanczos iteration with thick restart, on BLAS 3; over all ranks where the factor lies on them.
#include "reducer/modes/block_lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include <petscsys.h>
#include <Eigen/Cholesky>

// Does not compile before the others, so it has a block of its own.
#include <petscblaslapack.h>

#include "common/error.hpp"
#include "reducer/algebra/tall.hpp"

// By divide and conquer; PETSc's header lacks it.
extern "C" void dsyevd_(const char*, const char*, const PetscBLASInt*, double*, const PetscBLASInt*, double*, double*,
                        const PetscBLASInt*, PetscBLASInt*, const PetscBLASInt*, PetscBLASInt*);

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A tenth of the residual that modes may have: one step of inverse iteration follows, which need not lower it, and
/// measures it with another norm.
constexpr double converged_residual = 1e-9;

using ColumnRange = Eigen::Ref<const MatrixXd>;

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

/// The first columns of V := V Z, in place, a few rows at a time.
void combine_columns(const MatrixXd& Z, MatrixXd& V) {
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
  Eigen::VectorXd mu;
  MatrixXd Z;
};

Ritz ritz_of(MatrixXd T) {
  const auto n = static_cast<PetscBLASInt>(T.rows());
  Eigen::VectorXd value(n);
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
    MatrixXd C = tall_inner_products(A, B);
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
        block_(lanczos_block(wanted)),
        most_(static_cast<int>(std::min<Index>(5 * wanted / 2 + 9 * block_, op_.size))),
        V_(op_.rows, most_ + block_),
        T_(MatrixXd::Zero(most_ + block_, most_ + block_)) {}

  std::optional<EigenPairs> solve() {
    constexpr int most_steps = 1000;
    if (most_ < wanted_ + 2 * block_ || !start()) return std::nullopt;
    int next = first_look();
    for (int step = 0; step < most_steps; ++step) {
      if (!grow()) return std::nullopt;
      const bool full = size_ + block_ > most_;
      if (size_ < next && !full) {
        tell(0);
        continue;
      }
      Ritz ritz = ritz_of(T_.topLeftCorner(size_, size_));
      op_.agree(ritz.mu.data(), ritz.mu.size());
      op_.agree(ritz.Z.data(), ritz.Z.size());
      const MatrixXd residual = R_ * ritz.Z.bottomRows(block_);
      int converged = 0;
      while (converged < size_ && op_.agree(residual.col(converged).norm() <= converged_residual * ritz.mu[converged]))
        ++converged;
      tell(converged);
      if (converged >= wanted_) return pairs(ritz.mu.head(converged), ritz.Z.leftCols(converged));
      if (full) restart(ritz.mu, ritz.Z, residual);
      next = next_look(converged);
    }
    return std::nullopt;
  }

 private:
  /// Columns at which Ritz pairs are first looked at: no sooner than so many can have converged.
  int first_look() const { return wanted_ + 3 * block_; }
  /// When to look again: a pair takes two columns more or less, so this is two thirds of the way.
  int next_look(int converged) const { return size_ + std::max(block_, (wanted_ - converged) * 4 / 3); }

  /// Pairs converge late: at first the columns count, of three times as many as pairs and 60 that it usually takes.
  void tell(int converged) {
    ++blocks_;
    const double columns = block_ * blocks_ / (3.0 * wanted_ + 60.0);
    op_.share(std::max(static_cast<double>(converged) / wanted_, std::min(columns, 0.95)));
  }

  /// The first block: one application of the operator to random vectors, so that it has nothing without mass.
  bool start() {
    std::mt19937_64 random(20260101);
    MatrixXd X(op_.size, block_);
    for (double& x : X.reshaped()) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
    W_ = op_.solve(op_.mass(X.middleRows(op_.first, op_.rows)));
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
    const MatrixXd A = op_.inner_products(P_, W_);
    T_.block(size_, size_, block_, block_) = 0.5 * (A + A.transpose());
    subtract_tall_product(V_.middleCols(size_, block_), T_.block(size_, size_, block_, block_), W_);
    size_ += block_;
    return normalise();
  }

  /// W = V_next R, V_next orthonormal and orthogonal to V (by M); P = M V_next.
  bool normalise() {
    R_ = MatrixXd::Identity(block_, block_);
    for (int pass = 0; pass < 5; ++pass) {
      P_ = op_.mass(W_);
      const MatrixXd H = op_.inner_products(V_.leftCols(size_), P_);
      subtract_tall_product(V_.leftCols(size_), H, W_);
      const MatrixXd G = op_.inner_products(W_, P_);
      const Eigen::LLT<MatrixXd> factor(0.5 * (G + G.transpose()));
      if (!op_.agree(factor.info() == Eigen::Success)) return false;
      MatrixXd R = factor.matrixU();
      op_.agree(R.data(), R.size());
      divide_by(R, W_);
      divide_by(R, P_);
      R_ = (R * R_).eval();
      if (!op_.agree(R_.diagonal().minCoeff() > 0.0)) return false;
      // What the pass removed was small and the block well conditioned: the next would change round-off only. (What
      // was removed is not in T. With 1e-5 in place of 1e-9 residuals of 250 pairs were 1e-7.)
      const Eigen::VectorXd diagonal = R.diagonal();
      const double removed = size_ > 0 ? H.cwiseAbs().maxCoeff() : 0.0;
      if (op_.agree(removed < 1e-9 * diagonal.minCoeff() && diagonal.minCoeff() > 1e-3 * diagonal.maxCoeff())) {
        V_.middleCols(size_, block_) = W_;
        return true;
      }
    }
    return false;
  }

  /// Keeps the leading Ritz vectors and goes on from the last block.
  void restart(const Eigen::VectorXd& mu, const MatrixXd& Z, const MatrixXd& residual) {
    const int kept = std::min(size_ - block_, wanted_ + (size_ - wanted_) / 3);
    combine_columns(Z.leftCols(kept), V_);
    V_.middleCols(kept, block_) = W_;
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
  int block_;  ///< columns of a block
  int most_;   ///< columns of V at which the iteration is restarted
  MatrixXd V_;
  MatrixXd T_;
  MatrixXd W_;      ///< what becomes the next block
  MatrixXd P_;      ///< M times the last block of V
  MatrixXd R_;      ///< block x block
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

int lanczos_block(int wanted) { return wanted < 200 ? 8 : 16; }

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
