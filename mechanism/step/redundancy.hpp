// Reactions of overconstrained mechanisms: of all multipliers that cause the same motion, those of least norm.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Whether some constraint row is implied by others, so that the multipliers are not unique.
bool is_overconstrained(const State& state);

/// Largest violation of the rows that are left out (lengths relative to the characteristic one) at the last evaluate().
/// It stays at round-off as long as they follow from the others: it grows where the rank of the constraints is higher
/// than when they were chosen, or where the others have become dependent.
double largest_violation_left_out(const Model& model, const Evaluation& evaluation);

/// Chooses the rows that are solved for anew at the state, by a rank-revealing QR. Returns whether they changed.
/// Multipliers keep their values, also those of rows that are left out from now on: what these exert is made up for by
/// the others in the next solution.
bool choose_active_rows(const Model& model, State& state, Evaluation& evaluation);

/// λ with the same Bᵀλ and least Σ |f|² + |m|²/L² over all joints and couplings: f, m the wrench that each exerts on
/// its body B at the origin of its marker, L the characteristic length of the scene. At the state of the last
/// evaluate(). Up to 400 constraints by a complete orthogonal decomposition, above by conjugate gradients on the normal
/// equations (started at zero they converge to the solution of least norm).
Eigen::VectorXd least_norm_multipliers(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& lambda);

/// Joints and couplings, by name, whose reactions could be changed without changing the motion. At the state of the
/// last evaluate().
std::vector<std::string> joints_without_unique_reaction(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
