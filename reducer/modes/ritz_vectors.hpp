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

/// Space of interior motions with the boundary held, spanned by vectors W in order of their importance. values(p)
/// gives the Ritz vectors of the leading p vectors. left_out() gives the terms of THEORY (87) for what these Ritz
/// vectors leave out.
class RitzSpace {
 public:
  /// Builds W (n_I x p) from the columns of `raw` (n_I x any number). They are made M_II-orthogonal to `Phi` (n_I x
  /// m), then S_II-orthonormal in their order. Requires M_II-orthonormal fixed-boundary modes in `Phi`. Columns that
  /// depend on earlier ones, to 1e-10 of their square, are dropped. Costs one block of solutions with S_II.
  RitzSpace(const InternalProblem& problem, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi,
            Eigen::MatrixXd raw);

  Eigen::Index size() const { return W_.cols(); }

  /// Ritz values Θ, ascending, and coefficients Z (p x p) of the Ritz vectors W Z, with (W Z)ᵀ M_II W Z = 1.
  struct Values {
    Eigen::VectorXd theta;
    Eigen::MatrixXd Z;
  };
  Values values(Eigen::Index p) const;
  Eigen::MatrixXd vectors(const Values& values) const { return W_.leftCols(values.Z.rows()) * values.Z; }
  LeftOut left_out(const Values& values, const Eigen::MatrixXd& G, double first_dropped) const;

 private:
  Eigen::MatrixXd W_;         ///< n_I x p: vectors with Wᵀ S_II W = 1
  Eigen::MatrixXd mass_;      ///< p x p: Wᵀ M_II W
  Eigen::MatrixXd coupling_;  ///< n_B x p: Xᵀ W, X = M_IB + M_II Ψ
  Eigen::MatrixXd second_;    ///< n_B x p: Xᵀ S_II⁻¹ M_II W
  Eigen::MatrixXd third_;     ///< p x p: Wᵀ M_II S_II⁻¹ M_II W
};

/// Moment vectors, sorted by how much their omission would change frequencies, largest effect first.
struct MomentSpace {
  RitzSpace space;
  Eigen::VectorXd order;  ///< 1/γ of each vector (see moment_space()), ascending; equal values form a group

  /// Number `count` of leading vectors, raised to the end of a group of equal ones that it would cut.
  Eigen::Index whole(Eigen::Index count) const;
};

/// Moment vectors: quasi-static answers of the interior to accelerations of the boundary. They are combinations S_II⁻¹
/// X y of the columns of S_II⁻¹ X, X = M_IB + M_II Ψ, made orthogonal to the kept modes `Phi`. The y solve G y = γ
/// (M_B + S_B/λ) y, γ descending, with M_B and S_B of BoundaryModes and λ = `lambda`. γ bounds the effect of omitting
/// a vector on the frequency of a boundary motion of unit mass whose strain energy is at most λ. `G`: LeftOut::G (n_B
/// x n_B).
MomentSpace moment_space(const InternalProblem& problem, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi,
                         const Eigen::MatrixXd& G, double lambda);

/// Internal vectors from modes of the free part, by the methods of [Mac71], [Rub75] and [CC77]. `selection` gives the
/// number of elastic modes v of the free part, or a cut-off frequency. The vectors span v_I − Ψ v_B and the inertia
/// relief S_II⁻¹ X R_B of the six rigid accelerations. They are the Rayleigh-Ritz vectors of this space. With the
/// boundary modes the space holds the modes v and the residual flexibility exactly. Rubin's and Craig-Chang's methods
/// take the whole mass. MacNeal's takes M̄ = M v vᵀ M with rigid motions and kept modes in v.
InternalModes free_boundary_vectors(const InternalProblem& problem, const BoundaryModes& boundary,
                                    const formats::ModeSelection& selection);

}  // namespace tisserand::reducer
