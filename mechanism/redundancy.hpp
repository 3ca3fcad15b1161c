// Reactions of overconstrained mechanisms: of all multipliers that cause the same motion, those of least norm.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/model.hpp"
#include "mechanism/state.hpp"
#include "mechanism/workspace.hpp"

namespace tisserand::mechanism {

/// Whether some constraint row is implied by others, so that the multipliers are not unique.
bool is_overconstrained(const State& state);

/// λ with the same Bᵀλ and least Σ |f|² + |m|²/L² over all joints and couplings: f, m the wrench that each exerts on
/// its body B at the origin of its marker, L the characteristic length of the scene. At the state of the last
/// evaluate(). Up to 400 constraints by a complete orthogonal decomposition, above by conjugate gradients on the normal
/// equations (started at zero they converge to the solution of least norm).
Eigen::VectorXd least_norm_multipliers(const Model& model, const Workspace& workspace, const Eigen::VectorXd& lambda);

/// Joints and couplings, by name, whose reactions could be changed without changing the motion. At the state of the
/// last evaluate().
std::vector<std::string> joints_without_unique_reaction(const Model& model, const Workspace& workspace);

}  // namespace tisserand::mechanism
