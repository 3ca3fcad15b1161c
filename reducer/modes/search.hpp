// SPDX-License-Identifier: GPL-3.0-or-later
// One search by SLEPc for the lowest pairs of a pencil, in this process or in all that share its factor.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reducer/algebra/factor.hpp"
#include "reducer/modes/eps.hpp"

namespace tisserand::reducer {

/// S, M and the factor of S − shift M, with shift below the spectrum.
struct Pencil {
  const Matrix& S;
  const Matrix& M;
  const Factor& factor;
  double shift = 0.0;
  std::function<void(double)> share = [](double /*done*/) {};  ///< receives the approximate share that is done
  /// Receives the phase: "count" before eigenvalues are counted, "internal modes" after it.
  std::function<void(const std::string&)> begin = [](const std::string& /*phase*/) {};
};

/// Type and iterations of a call of EPSSolve.
struct EigenRun {
  EigenSolver type = EigenSolver::lapack;
  int iterations = 0;
};

struct SearchResult {
  EigenPairs pairs;                         ///< ascending
  std::optional<Eigen::VectorXd> residual;  ///< from iterate_once(), if the solver took that step
  std::vector<EigenRun> runs;
};

/// The `wanted` lowest pairs orthogonal to `known` (xᵀ M x = 1; may be empty), and others that converged, by
/// block_lanczos or krylov_schur. If block_lanczos breaks down or does not converge, krylov_schur replaces it. If the
/// factor is spread over ranks, so are the vectors during the search.
SearchResult search(const Pencil& pencil, EigenSolver type, int wanted, const Eigen::MatrixXd& known);

/// Work of the followers during a search.
void help_to_search(const Mumps& factor);

/// All pairs of a small pencil by LAPACK, ascending, without those whose 1/(λ − shift) is round-off relative to that of
/// the first.
SearchResult search_all(const Pencil& pencil);

/// Operator of the pencil for iterate_once(), with all rows on this process.
ShiftedOperator shifted_operator(const Pencil& pencil);

}  // namespace tisserand::reducer
