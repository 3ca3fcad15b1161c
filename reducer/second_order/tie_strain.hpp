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

/// Equations of the ties of a mesh and their dependent coordinates, from which the forces of the ties follow.
struct TieForces {
  TieSystem ties;
  std::vector<int> equation;   ///< indices in TieSystem::equations of those that are not redundant
  std::vector<int> dependent;  ///< dependent coordinates of the mesh, one per equation
  std::vector<int> row_of;     ///< row of each coordinate of the mesh in `dependent`; −1: independent

  bool empty() const { return equation.empty(); }
};

/// Finds the equations and dependent coordinates of the ties of a mesh. `independent`: coordinates of the mesh that
/// ties leave independent, with which `system` was built. `where`: place for messages.
TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::vector<int>& independent,
                          const std::string& where);
/// Finds the ties of a mesh for a `system` that was built with its boundary coordinates independent.
TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::string& where);

/// Residual g − S w of the elements at the dependent coordinates (rows of TieForces::dependent x displacements), with
/// the stiffness S before ties. `displacements`: w on all coordinates of the mesh. `g`: loads that belong to the last
/// columns of `displacements`; the other columns have no loads.
Eigen::MatrixXd tie_residual(const Mesh& mesh, const Coordinates& coordinates, const TieForces& forces,
                             const Eigen::MatrixXd& displacements, const Eigen::MatrixXd& g);

/// Multipliers λ of all tie equations (equations x columns) from the force residuals g − S w at the dependent
/// coordinates: C_Dᵀ λ = g − S w. C_D is the part of the equations at the dependent coordinates. Redundant equations
/// get zero. `residual`: tie_residual() (rows of TieForces::dependent).
Eigen::MatrixXd multipliers(const TieForces& forces, const Eigen::MatrixXd& residual);

/// Values of the dependent coordinates (rows of TieForces::dependent) that solve the tie equations c(x) = −constant
/// while all other coordinates are zero. `constant`: one row per equation.
Eigen::MatrixXd dependents(const TieForces& forces, const Eigen::MatrixXd& constant);

/// Stresses and gradients of the second-order terms of all spiders. `lambda`: multipliers() of the displacements w,
/// which are the columns of stress. `Phi`: displacements of all coordinates of the mesh, whose columns are those of
/// the gradients.
std::vector<StrainBatch> tie_batches(const Mesh& mesh, const System& system, const TieForces& forces,
                                     const Eigen::MatrixXd& lambda, const Eigen::MatrixXd& Phi);

/// Second-order term of one leg of a rigid spider, or of one averaging spider, on the coordinates of its own nodes.
struct TieForm {
  int spider = 0;      ///< index in Mesh::spiders
  std::vector<int> x;  ///< coordinates of the mesh that are the columns of the gradients
  StrainBatch batch;   ///< stresses, one column per column of the multipliers, and gradients
};

/// Second-order terms of all spiders, as tie_batches() gives them, for unit displacements of the coordinates of their
/// nodes.
std::vector<TieForm> tie_forms(const Mesh& mesh, const System& system, const TieForces& forces,
                               const Eigen::MatrixXd& lambda);

/// Names of ties without second-order terms: equations, and spiders that average only some directions.
std::vector<std::string> without_second_order(const Mesh& mesh);

}  // namespace tisserand::reducer
