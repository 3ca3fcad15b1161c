// Linearisation of a mechanism about a state: mass, damping and stiffness with all coordinates, and the constraints.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// M ξ'' + C ξ' + K ξ + Bᵀ δλ = 0, B ξ = 0 for small motions ξ in axes that turn with a constant angular velocity ω
/// and coincide with the world's at the instant of the state: per node [δx; δθ] (displacement and small turn), then the
/// internal coordinates. n velocity coordinates, one row of B per active constraint.
///
/// From the exact tangents of r(q, v, v̇) for material rotation increments δΘ = Rᵀδθ, with
///   δẋ = ξ' + ω×ξ,       δẍ = ξ'' + 2 ω×ξ' + ω×(ω×ξ),
///   δΩ = Rᵀ(θ' + ω×θ),   δΩ̇ = Rᵀ(θ'' + 2 ω×θ' + ω×(ω×θ)) − Ω×Rᵀ(θ' + ω×θ).
/// Coefficients are constant, and modes mean something, if the state is steady in these axes: equilibrium (ω = 0),
/// everything turning as one (ω its angular velocity), symmetric bodies spinning about axes that rest there.
struct Linearisation {
  Eigen::MatrixXd M, C, K;  ///< n x n
  Eigen::MatrixXd B;        ///< active constraints x n
  Eigen::VectorXd r;        ///< n: residual with Bᵀλ, rotation rows in world axes
};

/// At `state` with its v̇ and λ; evaluates first. Dense: throws Error if n exceeds `most_linearised`.
Linearisation linearise(const Model& model, const State& state, const Eigen::Vector3d& omega, Evaluation& evaluation);

constexpr int most_linearised = 4000;

/// K, B and r alone, of a state at rest (M and C stay empty).
Linearisation linearise_stiffness(const Model& model, const State& state, Evaluation& evaluation);

/// ξ as an increment of retract(): turns in material axes, at the last evaluate().
Eigen::VectorXd material_increment(const Model& model, const Evaluation& evaluation, Eigen::VectorXd xi);

/// Moves the state by ξ, and its multipliers by those of the active rows.
void move_by(const Model& model, const Eigen::VectorXd& xi, const Eigen::VectorXd& multipliers,
             const Evaluation& evaluation, State& state);

/// B of the active constraints for material rotation increments, at `state`, which it evaluates.
Eigen::MatrixXd active_jacobian(const Model& model, const State& state, Evaluation& evaluation);

/// The entries of active constraints, in the order of the rows of B.
Eigen::VectorXd active_part(const State& state, const Eigen::Ref<const Eigen::VectorXd>& of_constraints);

/// Adds values in the order of the rows of B to the multipliers of active constraints.
void add_to_multipliers(const Eigen::VectorXd& values, State& state);

}  // namespace tisserand::mechanism
