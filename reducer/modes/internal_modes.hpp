// SPDX-License-Identifier: GPL-3.0-or-later
// Internal (fixed-boundary) modes, [Car00] eq. (5), in a basis that does not depend on solver or node numbers.
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

/// The m internal vectors Φ of a reduction: fixed-boundary modes of THEORY (78), lowest first, then moment vectors.
/// For methods with modes of the free part they are the vectors of free_boundary_vectors() instead. n_B and n_I are
/// the numbers of boundary and interior coordinates.
struct InternalModes {
  Eigen::VectorXd lambda;         ///< m: ω², ascending, equal within a cluster
  Eigen::MatrixXd Phi;            ///< n_I x m; Φᵀ S_II Φ = Λ and, except for MacNeal's method, Φᵀ M_II Φ = 1
  Eigen::MatrixXd coupling;       ///< n_B x m: block M̄_BI = (M_BI + Ψᵀ M_II) Φ
  LeftOut left_out;               ///< terms of the omitted modes for truncation_errors()
  int moments = 0;                ///< number of moment vectors, which are the last columns of `Phi`
  std::optional<int> free_modes;  ///< number of modes of the free part that the method keeps; none for craig_bampton
  Eigen::MatrixXd boundary_mass;  ///< n_B x n_B, replaces BoundaryModes::M in MacNeal's method
  int requested = 0;
  int available = 0;                    ///< number of finite eigenvalues of (S_II, M_II)
  std::optional<double> first_dropped;  ///< ω² of the lowest omitted mode
  SolverReport solver;
  std::optional<int> counted;  ///< number of kept modes by Sylvester's law of inertia; none if not counted
  std::vector<int> pins;  ///< one held interior coordinate per mechanism; their motions are the first modes, λ = 0

  int loose() const { return count_of(pins); }
};

/// Partitioned part, its matrix blocks and the progress functions: input of internal_modes().
struct InternalProblem : PartitionedPart {
  const Blocks& blocks;
  const Factor& S_II;  ///< factor of S_II; for a mechanism, of the interior with its pins held
  std::string where;
  std::function<void(double)> share = [](double /*done*/) {};  ///< receives the completed share of a phase, 0 to 1
  /// Receives the name of a phase, see Pencil::begin.
  std::function<void(const std::string&)> begin = [](const std::string& /*phase*/) {};
  std::function<void(int)> seek = [](int /*modes*/) {};  ///< receives the number of modes before a search; may throw
};

/// A part and the results of its reduction, from which the certificate, the companion file and the recovery file are
/// made.
struct ReducedPart : InternalProblem {
  const BoundaryModes& boundary;
  const InternalModes& internal;
  const formats::Superelement& element;  ///< reduced matrices; boundary coordinates come first
};

/// Rank of M, which is the number of finite eigenvalues of (S, M) for a regular S. Massless coordinates occur with
/// lumped masses without rotary inertia. Up to 20 000 coordinates the rank is the size minus the number of null pivots
/// (below 1e-10) of M scaled to unit diagonal. For larger M, where nobody needs so many modes, it is the number of
/// coordinates with mass.
int finite_mode_count(const Matrix& M);

/// Throws the Error for a cut-off frequency that keeps no mode. `kind`: word for the modes in the message, "internal"
/// or "free". `lowest`: ω² of the first mode of that kind.
[[noreturn]] void fail_low_cutoff(const formats::ModeSelection& selection, const char* kind, double lowest);

/// Lower bound of the dropped eigenvalues if the first `kept` eigenvalues are kept. It is the next found eigenvalue,
/// or the last kept one if none was found beyond it. It is infinite if all are kept. `value`: found eigenvalues,
/// ascending, at least one. `available`: number of finite eigenvalues.
double least_dropped(const Eigen::VectorXd& value, Eigen::Index kept, Eigen::Index available);

/// Computes internal modes by number, by cut-off frequency, or for an accuracy. For an accuracy it takes all modes
/// below the frequency of the accuracy. Then it adds vectors until the bound of THEORY (91) is at most the requested
/// error: more modes, or moment vectors if fewer of these suffice and `moments` is not 0. Throws Error if more modes
/// are requested than exist, if the cut-off is below the first mode, or if 1000 modes do not meet the accuracy.
InternalModes internal_modes(const InternalProblem& problem, const BoundaryModes& boundary,
                             const formats::ModeSelection& selection);

/// Chooses the basis inside each cluster of equal eigenvalues, and the sign of each mode. In a cluster the basis
/// diagonalises the participation of the six rigid motions, with fixed unequal weights. If that is not unique, it
/// diagonalises a fixed function of place. Signs follow from the same participation, then from a function of place.
/// All modes of a cluster get their mean eigenvalue.
void fix_basis(const InternalProblem& problem, Eigen::VectorXd& lambda, Eigen::MatrixXd& Phi);

}  // namespace tisserand::reducer
