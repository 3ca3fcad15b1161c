// SPDX-License-Identifier: GPL-3.0-or-later
// Block Lanczos iteration for the lowest eigenpairs of large pencils. It solves for eight or sixteen right-hand sides
// at a time, so that the factor is read once for all. eps_block_lanczos.cpp makes it a type of SLEPc's EPS.
#pragma once

#include <functional>

#include "reducer/modes/inverse_iteration.hpp"

namespace tisserand::reducer {

/// Number of columns of a block: 16 if many pairs are wanted, else 8. It is also the largest number of eigenvectors of
/// one eigenvalue that the iteration finds with certainty. Blocks of 16 need a fifth more basis columns in all than
/// blocks of 8, but orthogonalisation reads the basis half as often.
int lanczos_block(int wanted);

/// Number of columns of the basis for `wanted` eigenpairs and blocks of `block` columns.
int lanczos_columns(int wanted, int block);

/// Array of the caller in which the iteration stores its basis (rows: coordinates of this process).
struct LanczosBasis {
  Eigen::Ref<Eigen::MatrixXd> array;  ///< columns: constraints, then the basis, which begins with the initial vectors
  /// Number of constraints: M-orthonormal vectors to which the basis stays M-orthogonal.
  int constraints = 0;
  int initial = 0;  ///< number of initial vectors, stored in the columns after the constraints
};

/// Settings of block_lanczos() and its calls back to the caller.
struct LanczosControl {
  int wanted = 0;
  int block = 0;
  double tolerance = 0.0;
  int most_steps = 0;  ///< number of blocks from which on Ritz pairs are computed after every block
  /// Returns the error estimates of Ritz values `mu`, μ = 1/(λ − shift), whose residuals ‖OP x − μ x‖_M are `residual`
  /// (OP: operator of block_lanczos()). A pair with an estimate of at most `tolerance` has converged.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& mu, const Eigen::VectorXd& residual)> errors;
  /// Returns whether to stop. It receives the number of blocks so far, the number of converged pairs, all Ritz values
  /// μ, and their error estimates.
  std::function<bool(int steps, int converged, const Eigen::VectorXd& mu, const Eigen::VectorXd& error)> ends;
};

/// Results of block_lanczos(). The eigenvectors replace the leading basis columns, after the constraints, of
/// LanczosBasis::array.
struct LanczosPairs {
  Eigen::VectorXd mu;      ///< μ = 1/(λ − shift) of the converged pairs, largest first
  int steps = 0;           ///< number of blocks for which the operator was solved
  bool broke_down = true;  ///< true: the basis cannot grow, because its space is invariant or has hardly any mass
};

/// Block Lanczos iteration with the operator OP = (S − shift M)⁻¹ M, symmetric in the inner product of M. It has a
/// three-term recurrence, one pass of orthogonalisation against all earlier vectors, and thick restart [WS00]. The
/// random start vectors are the same in every call. If several processes share the rows, all of them must call it.
LanczosPairs block_lanczos(const ShiftedOperator& op, const LanczosControl& control, LanczosBasis basis);

}  // namespace tisserand::reducer
