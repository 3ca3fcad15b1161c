// SPDX-License-Identifier: GPL-3.0-or-later
// Block Lanczos iteration for the lowest eigenpairs of large pencils. It solves for eight or sixteen right-hand sides
// at a time, so that the factor is read once for all. eps_block_lanczos.cpp makes it a type of SLEPc's EPS.
#pragma once

#include <functional>

#include "reducer/modes/inverse_iteration.hpp"

namespace tisserand::reducer {

/// Columns of a block, the largest number of eigenvectors of one eigenvalue that are found with certainty. It is 16 for
/// many wanted pairs, else 8. Wider blocks need a fifth more columns in all, but orthogonalisation reads the basis half
/// as often.
int lanczos_block(int wanted);

/// Columns of the basis for `wanted` pairs.
int lanczos_columns(int wanted, int block);

/// Array of the iteration, rows of this process.
struct LanczosBasis {
  Eigen::Ref<Eigen::MatrixXd> array;  ///< constraints, then the basis
  int constraints = 0;                ///< leading columns, orthonormal by M, to which all vectors stay orthogonal
  int initial = 0;                    ///< columns after them that hold initial vectors
};

/// Settings of the caller for the iteration.
struct LanczosControl {
  int wanted = 0;
  int block = 0;
  double tolerance = 0.0;
  int most_steps = 0;  ///< blocks after which Ritz pairs are always computed
  /// Error estimates of Ritz values μ = 1/(λ − shift) with residuals ‖OP x − μ x‖_M. Pairs up to `tolerance` converged.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& mu, const Eigen::VectorXd& residual)> errors;
  /// Receives the steps, the number of converged pairs, μ and the estimates. Returns whether to stop.
  std::function<bool(int steps, int converged, const Eigen::VectorXd& mu, const Eigen::VectorXd& error)> ends;
};

/// Results of the iteration; the vectors are in the basis after its constraints.
struct LanczosPairs {
  Eigen::VectorXd mu;      ///< μ of the converged pairs, largest first
  int steps = 0;           ///< number of solved blocks
  bool broke_down = true;  ///< the basis cannot grow: invariant subspace, or hardly any mass
};

/// Block Lanczos iteration with OP = (S − shift M)⁻¹ M, symmetric in the inner product of M. It has a three-term
/// recurrence, one pass of orthogonalisation against all earlier vectors, and thick restart [WS00]. The random start is
/// always the same. If several processes share the rows, it sums over processes.
LanczosPairs block_lanczos(const ShiftedOperator& op, const LanczosControl& control, LanczosBasis basis);

}  // namespace tisserand::reducer
