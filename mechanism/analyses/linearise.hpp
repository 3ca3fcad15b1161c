// SPDX-License-Identifier: GPL-3.0-or-later
// Linearisation of a mechanism about a state: mass, damping and stiffness with all coordinates, and the constraints.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Matrices of M ξ'' + C ξ' + K ξ + Bᵀ δλ = 0, B ξ = 0 for small motions ξ of a mechanism about a state. ξ holds
/// [δx; δθ] per node (displacement and small rotation), then the internal coordinates: n velocity coordinates. B has
/// one row per active constraint. The axes of ξ turn with a constant angular velocity ω and coincide with the world
/// axes at the instant of the state.
///
/// The matrices follow from the exact tangents of r(q, v, v̇) for material rotation increments δΘ = Rᵀδθ, with
///   δẋ = ξ' + ω×ξ,       δẍ = ξ'' + 2 ω×ξ' + ω×(ω×ξ),
///   δΩ = Rᵀ(θ' + ω×θ),   δΩ̇ = Rᵀ(θ'' + 2 ω×θ' + ω×(ω×θ)) − Ω×Rᵀ(θ' + ω×θ).
/// The coefficients are constant, and modes are meaningful, if the state is steady in these axes: equilibrium (ω = 0),
/// common rotation of all bodies (ω is its rate), or symmetric bodies that spin about axes at rest there.
struct Linearisation {
  Eigen::MatrixXd M, C, K;  ///< mass, damping and stiffness matrices (n x n)
  Eigen::MatrixXd B;        ///< Jacobian of the active constraints (rows x n)
  Eigen::VectorXd r;        ///< residual (n) with Bᵀλ, THEORY (58); rotation rows in world axes
};

/// Linearises the mechanism at `state` with the state's v̇ and λ, and evaluates the model there. `omega`: angular
/// velocity of the axes. The matrices are dense. Throws Error if the number n of coordinates exceeds `most_linearised`.
Linearisation linearise(const Model& model, const State& state, const Eigen::Vector3d& omega, Evaluation& evaluation);

/// Largest number of velocity coordinates that linearise() accepts, since its matrices are dense.
constexpr int most_linearised = 4000;

/// Linearises only K, B and r at a state of rest; M and C stay empty.
Linearisation linearise_stiffness(const Model& model, const State& state, Evaluation& evaluation);

/// Converts small motions ξ of a Linearisation to an increment for retract(), with rotations in material axes. The
/// orientations are those of the last evaluate().
Eigen::VectorXd material_increment(const Model& model, const Evaluation& evaluation, Eigen::VectorXd xi);

/// Moves the state by ξ of a Linearisation, and adds `multipliers` to the state's multipliers. `multipliers`: one value
/// per active constraint row, in the order of the rows of B.
void move_by(const Model& model, const Eigen::VectorXd& xi, const Eigen::VectorXd& multipliers,
             const Evaluation& evaluation, State& state);

/// Jacobian B of the active constraints for material rotation increments. Evaluates `state`.
Eigen::MatrixXd active_jacobian(const Model& model, const State& state, Evaluation& evaluation);

/// Entries of `of_constraints` that belong to active constraint rows, in the order of the rows of B. `of_constraints`:
/// one value per constraint row.
Eigen::VectorXd active_part(const State& state, const Eigen::Ref<const Eigen::VectorXd>& of_constraints);

/// Adds `values` to the multipliers of the active constraints. `values`: one per active row, in the order of the rows
/// of B.
void add_to_multipliers(const Eigen::VectorXd& values, State& state);

}  // namespace tisserand::mechanism
