// SPDX-License-Identifier: GPL-3.0-or-later
// Membrane stress that bending into double curvature traps: rows of the companion's strain without a linear part.
//
// The second-order strains of a deformation d load the elements with the nodal forces f_e = ∂V3/∂w. If every element
// could relax on its own, all of the energy ½ f_eᵀ K_e⁺ f_e would vanish. The shared displacements of the elements
// relax only ½ fᵀ K⁺ f of it, f = Σ f_e. The difference, THEORY (83), is never negative and is a form of degree four in
// d. It vanishes for plates of zero Gaussian curvature and for a part that only turns. Over pairs of shapes it is a
// Gram matrix, whose eigenvectors are rows ½ dᵀ Λ_b d of the sum of squares V = ½ Σ e².
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/internal_modes.hpp"
#include "reducer/second_order/tie_strain.hpp"

namespace tisserand::reducer {

/// Gram matrix of the stress that pairs k ≤ l of shapes trap, ordered by pairs [energy per product of four amplitudes].
/// d = Σ z_k d_k has the energy ⅛ Σ m_kl z_k z_l gram(kl, mn) m_mn z_m z_n, m = 1 for k = l, else 2.
struct TrappedEnergy {
  Eigen::MatrixXd gram;
  Eigen::VectorXd own;  ///< diagonal if every element relaxed on its own: the scale of round-off
};

/// Gram matrix for `shapes`: displacements of all x. Memory: coordinates x pairs. Rigid motions trap nothing.
TrappedEnergy trapped_energy(const InternalProblem& problem, const BoundaryModes& boundary, const TieForces& ties,
                             const Eigen::MatrixXd& shapes);

/// Λ_b (n x n, symmetric, Λ_b R = 0) [√energy / (y_k y_l)], largest first, of all pairs of the `shapes` lowest elastic
/// modes of the free reduced body. `Phi`: displacements of all x for the coordinates of the superelement. Memory:
/// coordinates of the mesh x shapes (shapes + 1)/2.
std::vector<Eigen::MatrixXd> trapped_stress(const ReducedPart& part, const TieForces& ties, const Eigen::MatrixXd& Phi,
                                            int shapes);

}  // namespace tisserand::reducer
