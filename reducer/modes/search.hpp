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

/// Eigenproblem S x = λ M x with the factor of S − shift M. Requires a shift below the spectrum.
struct Pencil {
  const Matrix& S;
  const Matrix& M;
  const Factor& factor;
  double shift = 0.0;
  std::function<void(double)> share = [](double /*done*/) {};  ///< receives the approximate completed share, 0 to 1
  /// Receives the name of a phase: "count" before eigenvalues are counted, "internal modes" after the count.
  std::function<void(const std::string&)> begin = [](const std::string& /*phase*/) {};
};

/// Method and number of iterations of one call of EPSSolve.
struct EigenRun {
  EigenSolver type = EigenSolver::lapack;
  int iterations = 0;
};

/// Result of a search for eigenpairs, with its accuracy and the runs of the solver.
struct SearchResult {
  EigenPairs pairs;  ///< found pairs, ascending
  /// Residuals from iterate_once(); absent if the solver did not take that step.
  std::optional<Eigen::VectorXd> residual;
  std::vector<EigenRun> runs;
};

/// Searches for the `wanted` lowest pairs M-orthogonal to the columns of `known`, by block_lanczos or krylov_schur.
/// Requires xᵀ M x = 1 for each column of `known`, which may have none. Further converged pairs are returned too. If
/// block_lanczos breaks down or does not converge, krylov_schur replaces it. If the factor is spread over processes,
/// the vectors are spread too during the search.
SearchResult search(const Pencil& pencil, EigenSolver type, int wanted, const Eigen::MatrixXd& known);

/// Part of search() that the other processes run while the first process calls search().
void help_to_search(const Mumps& factor);

/// Computes all pairs of a small pencil by LAPACK, ascending. Pairs whose 1/(λ − shift) is round-off of that of the
/// first pair are omitted.
SearchResult search_all(const Pencil& pencil);

/// Operator of the pencil for iterate_once(), with all rows in this process.
ShiftedOperator shifted_operator(const Pencil& pencil);

}  // namespace tisserand::reducer
