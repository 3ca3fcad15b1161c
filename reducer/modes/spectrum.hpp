// SPDX-License-Identifier: GPL-3.0-or-later
// Lowest eigenpairs of S x = λ M x without a gap, S positive definite after a shift, M positive semidefinite.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "reducer/modes/search.hpp"

namespace tisserand::reducer {

/// When lowest_pairs() counts eigenvalues, which costs one more factorisation.
enum class Count { always, if_cheap, never };

/// Kept eigenpair whose residual stays above 1e-8.
struct UnsharpPair {
  double lambda = 0.0;
  double error = 0.0;  ///< bound of the relative distance of this frequency to an exact one
};

/// Lowest eigenpairs of a pencil, with the results of their checks.
struct Spectrum {
  EigenPairs pairs;  ///< found pairs, ascending; those after the first `kept` are beyond the cut
  /// Number of kept pairs: the requested one, raised to the end of the cluster that it would cut.
  int kept = 0;
  std::vector<EigenRun> runs;  ///< calls of the solver in their order; the last one found the last pairs
  Eigen::VectorXd residual;    ///< ‖S x − λ M x‖/((λ − shift) ‖M x‖) of all pairs
  int refined = 0;             ///< number of kept pairs that took more than one step of inverse iteration
  std::vector<UnsharpPair> unsharp;
  /// Number of eigenvalues below the cut by Sylvester's law of inertia, equal to `kept`; none if not counted.
  std::optional<int> counted;

  EigenSolver solver() const { return runs.back().type; }
};

/// Solver, largest residual and notes of a search, for the certificate.
struct SolverReport {
  std::string text;                ///< "SLEPc 3.18.2, block_lanczos (9 iterations)"; empty: no search
  double residual = 0.0;           ///< largest residual of the kept pairs
  std::vector<std::string> notes;  ///< notes for the user in whole sentences
};
SolverReport report_of(const Spectrum& spectrum);

/// Largest relative distance of neighbouring eigenvalues of one cluster.
inline constexpr double cluster_tolerance = 1e-6;

/// Index after the last eigenvalue of the cluster that contains value[count − 1]. `value`: eigenvalues, ascending.
/// `shift` is subtracted from values before they are compared.
int cluster_end(const Eigen::VectorXd& value, int count, double shift);

/// Number of eigenvalues of (S, M) below `value`: the number of negative pivots of S − value M.
int count_below(const Matrix& S, const Matrix& M, double value);
/// Number of eigenvalues of the pencil below `value`, counted as a separate phase of the progress (Pencil::begin).
int count_below(const Pencil& pencil, double value);

/// Number of eigenvalues below the gap after the first `kept` (at least one) of `pairs`, by Sylvester's law of
/// inertia. It equals `kept` unless a search missed some.
int count_kept(const Pencil& pencil, const EigenPairs& pairs, int kept);

/// Solver that the part file names, or the one for a problem of `size` coordinates and `count` pairs. Throws Error if
/// the named solver cannot be used.
EigenSolver choose_solver(Eigen::Index size, int count, const formats::ModeSelection& asked);

/// Number of pairs that iterations seek in addition to the requested ones, to complete clusters and to find the next
/// eigenvalue.
inline constexpr int sought_beyond = 2;

/// Computes the `count` lowest pairs, with complete clusters. `available`: number of finite eigenvalues, at least
/// `count`. `verify`: when to count eigenvalues. They are always counted if a cluster has as many pairs as the block
/// of the iteration has columns, because the iteration might then miss some. Pairs with a residual above 1e-8 get up
/// to three more steps of inverse iteration. Throws Error if pairs are still missing after repeated searches, or if
/// residuals stay above 1e-6.
Spectrum lowest_pairs(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify);

/// Computes the `count` lowest pairs of S x = λ M x for small dense matrices. Requires a positive definite S − shift
/// M.
EigenPairs dense_lowest(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, int count);

}  // namespace tisserand::reducer
