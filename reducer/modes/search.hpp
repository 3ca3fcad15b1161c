// One search of SLEPc for the lowest pairs of a pencil, on this process or over all that share its factor.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reducer/algebra/factor.hpp"
#include "reducer/modes/eps.hpp"

namespace tisserand::reducer {

/// S, M and the factor of S − shift M, shift below the spectrum.
struct Pencil {
  const Matrix& S;
  const Matrix& M;
  const Factor& factor;
  double shift = 0.0;
  std::function<void(double)> share = [](double /*done*/) {};  ///< hears how much of a search is done, about
  /// Hears "count" before eigenvalues are counted, "internal modes" after it.
  std::function<void(const std::string&)> begin = [](const std::string& /*phase*/) {};
};

/// A call of EPSSolve.
struct EigenRun {
  EigenSolver type = EigenSolver::lapack;
  int iterations = 0;
};

struct SearchResult {
  EigenPairs pairs;                         ///< ascending
  std::optional<Eigen::VectorXd> residual;  ///< of iterate_once(), if the solver has taken that step
  std::vector<EigenRun> runs;
};

/// The `wanted` lowest pairs orthogonal to `known` (xᵀ M x = 1; there may be none), and those that converged with them,
/// by block_lanczos or krylov_schur; by krylov_schur also where block_lanczos breaks down or does not converge. If the
/// factor lies on several ranks, so do the vectors while it runs.
SearchResult search(const Pencil& pencil, EigenSolver type, int wanted, const Eigen::MatrixXd& known);

/// Work of the followers during a search.
void help_to_search(const Mumps& factor);

/// All pairs of a small pencil by LAPACK, ascending, without those whose 1/(λ − shift) is round-off of that of the
/// first.
SearchResult search_all(const Pencil& pencil);

/// The pencil as iterate_once() takes it, whole on this process.
ShiftedOperator shifted_operator(const Pencil& pencil);

}  // namespace tisserand::reducer
