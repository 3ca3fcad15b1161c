// Internal (fixed-boundary) modes, [Car00] eq. (5), with a basis that does not depend on solver or node numbers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/math/count.hpp"
#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/spectrum.hpp"
#include "reducer/modes/truncation.hpp"

namespace tisserand::reducer {

/// Fixed-boundary modes of THEORY (78), lowest first, and behind them moment vectors; or, of methods with modes of the
/// free part, what those leave inside (ritz_vectors.hpp).
struct InternalModes {
  Eigen::VectorXd lambda;         ///< m; ω², ascending; equal within a cluster
  Eigen::MatrixXd Phi;            ///< n_I x m, Φᵀ M_II Φ = 1 (not of MacNeal's method), Φᵀ S_II Φ = Λ
  Eigen::MatrixXd coupling;       ///< n_B x m: (M_BI + Ψᵀ M_II) Φ
  LeftOut left_out;               ///< of truncation_errors()
  int moments = 0;                ///< moment vectors: the last ones
  std::optional<int> free_modes;  ///< of methods with them: elastic modes of the free part that are held
  Eigen::MatrixXd boundary_mass;  ///< n_B x n_B, of MacNeal's method, in place of BoundaryModes::M
  int requested = 0;
  int available = 0;                    ///< finite eigenvalues of (S_II, M_II)
  std::optional<double> first_dropped;  ///< ω² of the lowest mode left out
  SolverReport solver;
  std::optional<int> counted;  ///< of the modes kept, by inertia: all of them, or not counted
  std::vector<int> pins;       ///< internal coordinates, one of each mechanism: its motions come first, λ = 0

  int loose() const { return count_of(pins); }
};

/// Input of the internal modes.
struct InternalProblem : PartitionedPart {
  const Blocks& blocks;
  const Factor& S_II;  ///< of a part with a mechanism: of what its pins leave
  std::string where;
  std::function<void(double)> share = [](double /*done*/) {};  ///< hears how much of a phase is done
  std::function<void(const std::string&)> begin = [](const std::string& /*phase*/) {};  ///< Pencil::begin
  std::function<void(int)> seek = [](int /*modes*/) {};  ///< hears how many modes are about to be sought; may refuse
};

/// A part and the results of its reduction: input of the certificate, the companion and the recovery file.
struct ReducedPart : InternalProblem {
  const BoundaryModes& boundary;
  const InternalModes& internal;
  const formats::Superelement& element;  ///< rows: boundary first
};

/// Rank of M: the number of finite eigenvalues, since S is regular. Lumped masses without rotary inertia leave
/// rotations massless. Up to 20 000 coordinates by the null pivots (below 1e-10) of M scaled to unit diagonal, which
/// element size and density do not make ill-conditioned; above, where nobody asks for so many modes, the number of
/// coordinates with mass.
int finite_mode_count(const Matrix& M);

/// Throws the Error for a cut-off that keeps nothing; `lowest`: ω² of the first mode of that kind.
[[noreturn]] void fail_low_cutoff(const formats::ModeSelection& selection, const char* kind, double lowest);

/// Lower bound of the dropped eigenvalues if the first `kept` are kept of those found, `value` (ascending, at least
/// one), of `available` finite ones: the next that was found, or the last that is kept; infinite if all are kept.
double least_dropped(const Eigen::VectorXd& value, Eigen::Index kept, Eigen::Index available);

/// Internal modes by number, by cut-off frequency, or for an accuracy. The last means all modes below its frequency,
/// then more vectors until the bound THEORY (91) meets the error: moment vectors first, unless `moments` is 0, then
/// modes. Throws Error if more modes are asked for than exist, if the cut-off is below the first, or if 1000 modes do
/// not meet the accuracy.
InternalModes internal_modes(const InternalProblem& problem, const BoundaryModes& boundary,
                             const formats::ModeSelection& selection);

/// Fixes order and signs: inside a cluster the basis diagonalises the participation of the six rigid
/// motions with fixed unequal weights, and if that is not unique, a fixed function of place; signs by the same
/// functions. Cluster members share their mean eigenvalue.
void fix_basis(const InternalProblem& problem, Eigen::VectorXd& lambda, Eigen::MatrixXd& Phi);

}  // namespace tisserand::reducer
