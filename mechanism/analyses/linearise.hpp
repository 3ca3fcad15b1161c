// SPDX-License-Identifier: GPL-3.0-or-later
// Linearisation of a mechanism about a state: mass, damping and stiffness with all coordinates, and the constraints.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Matrices of M ξ'' + C ξ' + K ξ + Bᵀ δλ = 0, B ξ = 0 for small motions ξ. The axes turn with a constant angular
/// velocity ω and coincide with the world axes at this instant. ξ holds [δx; δθ] per node (displacement and small
/// rotation), then the internal coordinates: n velocity coordinates. B has one row per active constraint.
///
/// They follow from the exact tangents of r(q, v, v̇) for material rotation increments δΘ = Rᵀδθ, with
///   δẋ = ξ' + ω×ξ,       δẍ = ξ'' + 2 ω×ξ' + ω×(ω×ξ),
///   δΩ = Rᵀ(θ' + ω×θ),   δΩ̇ = Rᵀ(θ'' + 2 ω×θ' + ω×(ω×θ)) − Ω×Rᵀ(θ' + ω×θ).
/// The coefficients are constant, and modes are meaningful, if the state is steady in these axes: equilibrium (ω = 0),
/// common rotation of all bodies (ω is its rate), or symmetric bodies that spin about axes at rest there.
struct Linearisation {
  Eigen::MatrixXd M, C, K;  ///< n x n
  Eigen::MatrixXd B;        ///< active constraints x n
  Eigen::VectorXd r;        ///< n: residual with Bᵀλ, rotation rows in world axes
};

/// Linearises at `state` with its v̇ and λ; evaluates first. Dense: throws Error if n exceeds `most_linearised`.
Linearisation linearise(const Model& model, const State& state, const Eigen::Vector3d& omega, Evaluation& evaluation);

constexpr int most_linearised = 4000;

/// Linearises K, B and r alone at a state of rest (M and C stay empty).
Linearisation linearise_stiffness(const Model& model, const State& state, Evaluation& evaluation);

/// Converts ξ to an increment of retract(), with rotations in material axes, at the last evaluate().
Eigen::VectorXd material_increment(const Model& model, const Evaluation& evaluation, Eigen::VectorXd xi);

/// Moves the state by ξ, and adds `multipliers` (in the order of the active rows) to its multipliers.
void move_by(const Model& model, const Eigen::VectorXd& xi, const Eigen::VectorXd& multipliers,
             const Evaluation& evaluation, State& state);

/// Jacobian B of the active constraints for material rotation increments. Evaluates `state`.
Eigen::MatrixXd active_jacobian(const Model& model, const State& state, Evaluation& evaluation);

/// Entries of the active constraints, in the order of the rows of B.
Eigen::VectorXd active_part(const State& state, const Eigen::Ref<const Eigen::VectorXd>& of_constraints);

/// Adds values in the order of the rows of B to the multipliers of active constraints.
void add_to_multipliers(const Eigen::VectorXd& values, State& state);

}  // namespace tisserand::mechanism
