// SPDX-License-Identifier: GPL-3.0-or-later
// Second order of ties: work of the forces that ties transmit on rigid arms and averages that turn.
//
// Ties are equations c(x) = 0. For displacements w under loads g they transmit forces λ, S w + Cᵀ λ = g with the
// matrices of the mesh. V3 gains λ · c₂(d, d) with the second order c₂ of the equations:
// - a rigid arm r: with the displacement u and rotation ψ of a node that follows θ of its reference,
//   c₂ = −θ × (u − u_ref − ½ θ × r) and −½ θ × (ψ − θ) in the directions that are tied (axes turn with the reference);
// - a weighted mean (RBE3): the rotation of the reference is the one that fits the nodes best, also at second order:
//   with the centroid c of the nodes, arms r_i from it, v_i their displacements from its own, J = Σ w (r² 1 − r rᵀ) and
//   W = Σ w r rᵀ (both with rotations that are averaged: J + Σ w L² 1),
//   J ψ₂ = (Y ᵀ − tr Y) ψ + ½ ψ × W ψ + ½ Σ w L² ψ × θ_i, Y = Σ w v rᵀ;  u₂ = ψ₂ × r₀ + ½ ψ × (ψ × r₀).
// Without them offsets and spiders would not be invariant when the part turns. Equations that a mesh gives by
// coefficients only have no second order, because their meaning for finite motions is unknown.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/second_order/quadratic_forms.hpp"
#include "reducer/system/system.hpp"
#include "reducer/ties/elimination.hpp"

namespace tisserand::reducer {

/// Ties of a mesh with their equations and dependent coordinates.
struct TieForces {
  TieSystem ties;
  std::vector<int> equation;   ///< numbers of the equations that are not redundant
  std::vector<int> dependent;  ///< dependent coordinates x, one per equation
  std::vector<int> row_of;     ///< row of each x in `dependent`; −1: none

  bool empty() const { return equation.empty(); }
};

/// Ties of a mesh. `independent`: coordinates x that ties leave independent, with which `system` was built.
TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::vector<int>& independent,
                          const std::string& where);
/// Ties for a system that was built with its boundary independent.
TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::string& where);

/// Residual g − S w of the elements at the dependent coordinates (rows of TieForces::dependent, a column per
/// displacement). `displacements`: w on all x. `g`: loads on x of the last columns; the others have none.
Eigen::MatrixXd tie_residual(const Mesh& mesh, const Coordinates& coordinates, const TieForces& forces,
                             const Eigen::MatrixXd& displacements, const Eigen::MatrixXd& g);

/// λ of every equation (rows; redundant ones zero) from residuals g − S w at the dependent coordinates (rows of
/// TieForces::dependent): C_Dᵀ λ = g − S w.
Eigen::MatrixXd multipliers(const TieForces& forces, const Eigen::MatrixXd& residual);

/// Dependent coordinates (rows of TieForces::dependent) that solve c(x) = −constant with all others zero. `constant`
/// has a row per equation.
Eigen::MatrixXd dependents(const TieForces& forces, const Eigen::MatrixXd& constant);

/// Stresses and gradients of all spiders. `lambda`: multipliers(); `Phi`: displacements of all x for the coordinates.
std::vector<StrainBatch> tie_batches(const Mesh& mesh, const System& system, const TieForces& forces,
                                     const Eigen::MatrixXd& lambda, const Eigen::MatrixXd& Phi);

/// Second order of one leg of a rigid spider, or of one average, on the coordinates of its own nodes.
struct TieForm {
  int spider = 0;      ///< index in Mesh::spiders
  std::vector<int> x;  ///< coordinates of the mesh: columns of the gradients
  StrainBatch batch;   ///< a column of stress per column of `lambda`
};

/// Terms of tie_batches() for unit displacements of the mesh's coordinates.
std::vector<TieForm> tie_forms(const Mesh& mesh, const System& system, const TieForces& forces,
                               const Eigen::MatrixXd& lambda);

/// Names of ties without second order: equations, and spiders that average some directions only.
std::vector<std::string> without_second_order(const Mesh& mesh);

}  // namespace tisserand::reducer
