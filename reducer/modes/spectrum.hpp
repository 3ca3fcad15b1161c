// Lowest eigenpairs of S x = λ M x, S positive definite after a shift, M positive semidefinite; none missed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "reducer/modes/search.hpp"

namespace tisserand::reducer {

/// Whether eigenvalues are counted by one more factorisation.
enum class Count { always, if_cheap, never };

/// A kept pair whose residual stays above 1e-8.
struct UnsharpPair {
  double lambda = 0.0;
  double error = 0.0;  ///< bound of the relative distance of its frequency to an exact one
};

/// Lowest pairs, with the results of their checks.
struct Spectrum {
  EigenPairs pairs;            ///< at least `kept`, with the pairs behind the cut that were found
  int kept = 0;                ///< the requested number, raised to the end of the cluster that it would cut
  std::vector<EigenRun> runs;  ///< one after the other; the last found the last pairs
  Eigen::VectorXd residual;    ///< of all pairs: ‖S x − λ M x‖/((λ − shift) ‖M x‖)
  int refined = 0;             ///< kept pairs that took more than one step of inverse iteration
  std::vector<UnsharpPair> unsharp;
  std::optional<int> counted;  ///< eigenvalues below the cut by Sylvester's law of inertia; equals `kept`

  EigenSolver solver() const { return runs.back().type; }
};

/// The part of a report about a search.
struct SolverReport {
  std::string text;                ///< "SLEPc 3.18.2, block_lanczos (9 iterations)"; empty: nothing was searched
  double residual = 0.0;           ///< largest of the pairs kept
  std::vector<std::string> notes;  ///< whole sentences
};
SolverReport report_of(const Spectrum& spectrum);

/// Eigenvalues closer than 1e-6 relative form one cluster.
inline constexpr double cluster_tolerance = 1e-6;

/// Index behind the cluster that the pair `count` − 1 belongs to; `shift` is subtracted before values are compared.
int cluster_end(const Eigen::VectorXd& value, int count, double shift);

/// Number of eigenvalues of (S, M) below `value`: negative pivots of S − value M.
int count_below(const Matrix& S, const Matrix& M, double value);
/// count_below() as a separate phase of the progress.
int count_below(const Pencil& pencil, double value);

/// The number of eigenvalues up to the gap behind the first `kept` pairs (one at least), by inertia: `kept` unless some
/// are missing.
int count_kept(const Pencil& pencil, const EigenPairs& pairs, int kept);

/// The solver of the part file, or the one for a problem of this size. Throws Error if it cannot be used.
EigenSolver choose_solver(Eigen::Index size, int count, const formats::ModeSelection& asked);

/// Pairs that iterations seek beyond those asked for, to complete clusters and to know the next eigenvalue.
inline constexpr int sought_beyond = 2;

/// The `count` lowest pairs (count ≤ available, the number of finite eigenvalues); clusters are completed. They are
/// always counted if a cluster is as large as the block of the iteration, which then proves nothing.
/// Pairs with a residual above 1e-8 take up to three more steps of inverse iteration. Throws Error if pairs are still
/// missing after repeated searches, or if residuals stay above 1e-6.
Spectrum lowest_pairs(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify);

/// All-dense version for small matrices: the lowest `count` pairs of S x = λ M x, S − shift M positive definite.
EigenPairs dense_lowest(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, int count);

}  // namespace tisserand::reducer
