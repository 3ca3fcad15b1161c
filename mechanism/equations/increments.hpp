// SPDX-License-Identifier: GPL-3.0-or-later
// Effect of increments of the coordinates on positions and constraints.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Adds an increment d of the coordinates to the positions of `from` and stores the result in `to`: x + d, Q exp(dΘ/2),
/// w + d, y + d. d has all velocity coordinates. Only this function updates positions.
void retract(const Model& model, const State& from, const Eigen::Ref<const Eigen::VectorXd>& d, State& to);

/// Computes `rows` = B T(θ) d, the change of Φ by an increment d of boundary coordinates, with the Jacobian of the last
/// evaluate(). θ are the rotation vectors of the step, of which d holds increments.
void apply_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows);

/// Computes `result` = Bᵀ μ in boundary coordinates (material rotations), with the Jacobian of the last evaluate().
void apply_transposed_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& mu,
                               Eigen::VectorXd& result);

}  // namespace tisserand::mechanism
