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

/// When to count eigenvalues by one more factorisation.
enum class Count { always, if_cheap, never };

/// Kept pair whose residual remains above 1e-8.
struct UnsharpPair {
  double lambda = 0.0;
  double error = 0.0;  ///< bound of the relative distance of its frequency to an exact one
};

/// Lowest pairs, with the results of their checks.
struct Spectrum {
  EigenPairs pairs;            ///< at least `kept`, with the found pairs after the cut
  int kept = 0;                ///< requested number, raised to the end of the cluster that it would cut
  std::vector<EigenRun> runs;  ///< in their order; the last one found the last pairs
  Eigen::VectorXd residual;    ///< of all pairs: ‖S x − λ M x‖/((λ − shift) ‖M x‖)
  int refined = 0;             ///< kept pairs that took more than one step of inverse iteration
  std::vector<UnsharpPair> unsharp;
  std::optional<int> counted;  ///< eigenvalues below the cut by Sylvester's law of inertia; equals `kept`

  EigenSolver solver() const { return runs.back().type; }
};

/// Report about a search.
struct SolverReport {
  std::string text;                ///< "SLEPc 3.18.2, block_lanczos (9 iterations)"; empty: no search
  double residual = 0.0;           ///< largest of the kept pairs
  std::vector<std::string> notes;  ///< whole sentences
};
SolverReport report_of(const Spectrum& spectrum);

/// Largest relative distance of eigenvalues in one cluster.
inline constexpr double cluster_tolerance = 1e-6;

/// Index after the cluster of the pair `count` − 1; `shift` is subtracted before values are compared.
int cluster_end(const Eigen::VectorXd& value, int count, double shift);

/// Number of eigenvalues of (S, M) below `value`: negative pivots of S − value M.
int count_below(const Matrix& S, const Matrix& M, double value);
/// count_below() as a separate phase of the progress.
int count_below(const Pencil& pencil, double value);

/// Number of eigenvalues up to the gap after the first `kept` pairs (at least one), by inertia. It equals `kept` unless
/// some are missing.
int count_kept(const Pencil& pencil, const EigenPairs& pairs, int kept);

/// Solver of the part file, or the one for a problem of this size. Throws Error if it cannot be used.
EigenSolver choose_solver(Eigen::Index size, int count, const formats::ModeSelection& asked);

/// Pairs that iterations seek in addition, to complete clusters and to find the next eigenvalue.
inline constexpr int sought_beyond = 2;

/// The `count` lowest pairs (count ≤ available, the number of finite eigenvalues), with complete clusters. If a cluster
/// is as large as the block of the iteration, which then proves nothing, they are always counted. Pairs with a residual
/// above 1e-8 get up to three more steps of inverse iteration. Throws Error if pairs are still missing after repeated
/// searches, or if residuals stay above 1e-6.
Spectrum lowest_pairs(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify);

/// Lowest `count` pairs of S x = λ M x for small dense matrices, S − shift M positive definite.
EigenPairs dense_lowest(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, int count);

}  // namespace tisserand::reducer
