// What increments of the coordinates do to positions and to constraints.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// x += d, Q <- Q exp(dΘ/2), w += d, y += d from the positions of `from`; the only update of positions in the program.
void retract(const Model& model, const State& from, const Eigen::Ref<const Eigen::VectorXd>& d, State& to);

/// B T(displacement of the step) d for the Jacobian of the last evaluate(), d in boundary coordinates.
void apply_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows);

/// result <- Bᵀ μ in boundary coordinates (material turns) for the Jacobian of the last evaluate().
void apply_transposed_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& mu,
                               Eigen::VectorXd& result);

}  // namespace tisserand::mechanism
