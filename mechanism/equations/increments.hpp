// SPDX-License-Identifier: GPL-3.0-or-later
// Effect of increments of the coordinates on positions and constraints.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Sets x += d, Q <- Q exp(dΘ/2), w += d, y += d from the positions of `from`. Only this function updates positions.
void retract(const Model& model, const State& from, const Eigen::Ref<const Eigen::VectorXd>& d, State& to);

/// Computes B T(displacement of the step) d with the Jacobian of the last evaluate(), d in boundary coordinates.
void apply_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows);

/// Computes result = Bᵀ μ in boundary coordinates (material rotations) with the Jacobian of the last evaluate().
void apply_transposed_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& mu,
                               Eigen::VectorXd& result);

}  // namespace tisserand::mechanism
