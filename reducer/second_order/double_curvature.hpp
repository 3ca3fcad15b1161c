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

/// Energy of the membrane stress that pairs k ≤ l of shapes trap, as a Gram matrix with a row and a column per pair
/// [energy per product of four amplitudes]. A deformation d = Σ z_k d_k has the energy ⅛ Σ m_kl z_k z_l gram(kl, mn)
/// m_mn z_m z_n over pairs kl and mn, with m = 1 for equal indices, else 2.
struct TrappedEnergy {
  Eigen::MatrixXd gram;
  /// Diagonal of the Gram matrix if every element relaxed on its own, which is the scale of round-off.
  Eigen::VectorXd own;
};

/// Computes the energy that pairs of `shapes` trap, THEORY (83). `shapes`: displacements of all coordinates of the
/// mesh (coordinates x shapes). Rigid motions trap nothing. The memory is one column of all coordinates per pair.
TrappedEnergy trapped_energy(const InternalProblem& problem, const BoundaryModes& boundary, const TieForces& ties,
                             const Eigen::MatrixXd& shapes);

/// Matrices Λ_b (n x n, symmetric, Λ_b R = 0 for rigid motions R) of the trapped membrane stress, THEORY (83) [√energy
/// per product of two coordinates]. They come from all pairs of the `shapes` lowest elastic modes of the free reduced
/// body, largest first. `Phi`: displacements of all coordinates of the mesh for the n of the superelement. The memory
/// is shapes (shapes + 1)/2 columns of all coordinates of the mesh.
std::vector<Eigen::MatrixXd> trapped_stress(const ReducedPart& part, const TieForces& ties, const Eigen::MatrixXd& Phi,
                                            int shapes);

}  // namespace tisserand::reducer
