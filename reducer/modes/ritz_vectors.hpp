// SPDX-License-Identifier: GPL-3.0-or-later
// Internal vectors other than fixed-boundary modes: moment vectors in addition to these, and the internal part of free
// modes (Rubin, MacNeal).
#pragma once

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/modes/truncation.hpp"

namespace tisserand::reducer {

/// Space of internal vectors (boundary held), leading vectors first, with their coupling to the boundary. `values(p)`
/// gives the Ritz vectors of its leading p, left_out() their LeftOut.
class RitzSpace {
 public:
  /// Makes `raw` (n_I x p) orthogonal to `Phi` (n_I x m, M_II-orthonormal fixed-boundary modes) in M_II, then
  /// orthonormal in S_II in this order. Directions that others span to 1e-10 are dropped. Costs one block of solutions.
  RitzSpace(const InternalProblem& problem, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi,
            Eigen::MatrixXd raw);

  Eigen::Index size() const { return W_.cols(); }

  /// Ritz values Θ, ascending, and coefficients Z (p x p) of the vectors W Z with (WZ)ᵀ M_II W Z = 1.
  struct Values {
    Eigen::VectorXd theta;
    Eigen::MatrixXd Z;
  };
  Values values(Eigen::Index p) const;
  Eigen::MatrixXd vectors(const Values& values) const { return W_.leftCols(values.Z.rows()) * values.Z; }
  LeftOut left_out(const Values& values, const Eigen::MatrixXd& G, double first_dropped) const;

 private:
  Eigen::MatrixXd W_;         ///< n_I x p, Wᵀ S_II W = 1
  Eigen::MatrixXd mass_;      ///< Wᵀ M_II W
  Eigen::MatrixXd coupling_;  ///< n_B x p: Xᵀ W
  Eigen::MatrixXd second_;    ///< n_B x p: Xᵀ S_II⁻¹ M_II W
  Eigen::MatrixXd third_;     ///< Wᵀ M_II S_II⁻¹ M_II W
};

/// Moment vectors, sorted by the effect of their omission on frequencies, largest first.
struct MomentSpace {
  RitzSpace space;
  Eigen::VectorXd order;  ///< 1/γ of each, ascending: equal ones form groups

  /// `count`, raised to the end of a group of equal ones that it would cut.
  Eigen::Index whole(Eigen::Index count) const;
};

/// Moment vectors: columns of S_II⁻¹ X, X = M_IB + M_II Ψ, without the share of the kept modes `Phi`, the response of
/// the inside to accelerations of the boundary. They are combined by G y = γ (M_B + S_B/λ) y, γ descending. γ bounds
/// the effect of one's omission on the frequency of a boundary motion of unit mass with a strain energy up to `lambda`.
MomentSpace moment_space(const InternalProblem& problem, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi,
                         const Eigen::MatrixXd& G, double lambda);

/// Internal vectors by modes of the free part, [Mac71], [Rub75], [CC77]. `selection` counts elastic modes v of the free
/// part. With the static modes of the boundary and the inertia relief of the six rigid accelerations, the space holds
/// them and the residual flexibility exactly. Internal vectors: v_I − Ψ v_B and S_II⁻¹ X R_B, Rayleigh-Ritz. Rubin (and
/// Craig-Chang) takes the whole mass, MacNeal that of rigid motions and kept modes, M̄ = M v vᵀ M.
InternalModes free_boundary_vectors(const InternalProblem& problem, const BoundaryModes& boundary,
                                    const formats::ModeSelection& selection);

}  // namespace tisserand::reducer
