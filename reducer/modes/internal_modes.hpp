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

/// Fixed-boundary modes of THEORY (78), lowest first, then moment vectors. Methods with modes of the free part have the
/// internal vectors of ritz_vectors.hpp.
struct InternalModes {
  Eigen::VectorXd lambda;         ///< m; ω², ascending; equal within a cluster
  Eigen::MatrixXd Phi;            ///< n_I x m, Φᵀ M_II Φ = 1 (not of MacNeal's method), Φᵀ S_II Φ = Λ
  Eigen::MatrixXd coupling;       ///< n_B x m: (M_BI + Ψᵀ M_II) Φ
  LeftOut left_out;               ///< terms for truncation_errors()
  int moments = 0;                ///< number of moment vectors, which are the last
  std::optional<int> free_modes;  ///< elastic modes of the free part that the method holds, if any
  Eigen::MatrixXd boundary_mass;  ///< n_B x n_B, replaces BoundaryModes::M in MacNeal's method
  int requested = 0;
  int available = 0;                    ///< finite eigenvalues of (S_II, M_II)
  std::optional<double> first_dropped;  ///< ω² of the lowest omitted mode
  SolverReport solver;
  std::optional<int> counted;  ///< kept modes as counted by inertia: all of them, or empty
  std::vector<int> pins;       ///< an internal coordinate per mechanism, whose motions come first, λ = 0

  int loose() const { return count_of(pins); }
};

/// Input of the internal modes.
struct InternalProblem : PartitionedPart {
  const Blocks& blocks;
  const Factor& S_II;  ///< if the part has a mechanism, of the inside held by pins
  std::string where;
  std::function<void(double)> share = [](double /*done*/) {};  ///< receives the share of a phase that is done
  std::function<void(const std::string&)> begin = [](const std::string& /*phase*/) {};  ///< Pencil::begin
  std::function<void(int)> seek = [](int /*modes*/) {};  ///< receives the number of modes before a search; may throw
};

/// A part and the results of its reduction: input of the certificate, the companion and the recovery file.
struct ReducedPart : InternalProblem {
  const BoundaryModes& boundary;
  const InternalModes& internal;
  const formats::Superelement& element;  ///< rows: boundary first
};

/// Rank of M: the number of finite eigenvalues, since S is regular. Lumped masses without rotary inertia leave
/// rotations massless. Up to 20 000 coordinates: by null pivots (below 1e-10) of M scaled to unit diagonal, which
/// element size and density do not make ill-conditioned. Above, where nobody needs so many modes: the number of
/// coordinates with mass.
int finite_mode_count(const Matrix& M);

/// Throws the Error for a cut-off that keeps no mode; `lowest`: ω² of the first mode of that kind.
[[noreturn]] void fail_low_cutoff(const formats::ModeSelection& selection, const char* kind, double lowest);

/// Lower bound of the dropped eigenvalues if the first `kept` of `value` (ascending, at least one; `available` are
/// finite) are kept: the next that was found, or the last that is kept. Infinite if all are kept.
double least_dropped(const Eigen::VectorXd& value, Eigen::Index kept, Eigen::Index available);

/// Internal modes by number, by cut-off frequency, or for an accuracy. An accuracy means all modes below its frequency,
/// then more vectors until the bound THEORY (91) meets the error: moment vectors first, unless `moments` is 0, then
/// modes. Throws Error if more modes are requested than exist, if the cut-off is below the first, or if 1000 modes do
/// not meet the accuracy.
InternalModes internal_modes(const InternalProblem& problem, const BoundaryModes& boundary,
                             const formats::ModeSelection& selection);

/// Fixes order and signs. Inside a cluster the basis diagonalises the participation of the six rigid motions with fixed
/// unequal weights, and if that is not unique, a fixed function of place. The same functions fix signs. Cluster members
/// get their mean eigenvalue.
void fix_basis(const InternalProblem& problem, Eigen::VectorXd& lambda, Eigen::MatrixXd& Phi);

}  // namespace tisserand::reducer
