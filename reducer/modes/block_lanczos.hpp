// Block Lanczos iteration for the lowest eigenpairs of large pencils: eight or sixteen right-hand sides at a time, so
// that the factor is read once for all of them. eps_block_lanczos.cpp makes a type of SLEPc's EPS of it.
#pragma once

#include <functional>

#include "reducer/modes/inverse_iteration.hpp"

namespace tisserand::reducer {

/// Columns of a block: at most that many eigenvectors of one eigenvalue are found for certain. 16 where many
/// pairs are wanted, else 8: wider blocks take a fifth more columns in all, but orthogonalisation reads the basis half
/// as often.
int lanczos_block(int wanted);

/// Columns of the basis for `wanted` pairs.
int lanczos_columns(int wanted, int block);

/// The array that the iteration works in, rows of this process.
struct LanczosBasis {
  Eigen::Ref<Eigen::MatrixXd> array;  ///< constraints, then the basis
  int constraints = 0;                ///< leading columns, orthonormal by M, to which all vectors stay orthogonal
  int initial = 0;                    ///< columns behind them that hold vectors to begin with
};

/// Settings of the caller for the iteration.
struct LanczosControl {
  int wanted = 0;
  int block = 0;
  double tolerance = 0.0;
  int most_steps = 0;  ///< blocks at which Ritz pairs are looked at in any case
  /// Error estimates of Ritz values μ = 1/(λ − shift) with residuals ‖OP x − μ x‖_M; converged up to `tolerance`.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& mu, const Eigen::VectorXd& residual)> errors;
  /// Receives the steps, the number of converged pairs, μ and the estimates; whether to end.
  std::function<bool(int steps, int converged, const Eigen::VectorXd& mu, const Eigen::VectorXd& error)> ends;
};

/// Results of the iteration; the vectors are in the basis after its constraints.
struct LanczosPairs {
  Eigen::VectorXd mu;      ///< of the converged pairs, largest first
  int steps = 0;           ///< blocks that were solved for
  bool broke_down = true;  ///< the basis cannot grow: an invariant subspace, or hardly any mass
};

/// Block Lanczos iteration with OP = (S − shift M)⁻¹ M, which is symmetric in the inner product of M: three-term
/// recurrence, one pass of orthogonalisation against all earlier vectors, thick restart [WS00]. Starts from the same
/// random numbers always. If several processes share the rows, sums over rows are sums over processes.
LanczosPairs block_lanczos(const ShiftedOperator& op, const LanczosControl& control, LanczosBasis basis);

}  // namespace tisserand::reducer
