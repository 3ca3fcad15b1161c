// What rounding leaves of forces: below it no iteration brings them.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Largest distance of a node from the origin of the model, or its length if that is more: positions are rounded to ε of it.
double reach_of(const Model& model, const State& state);

/// Forces on nodes that no iteration removes: the rounding of positions times the largest stiffness.
double force_round_off(const Model& model, const State& state);

/// Whether these multipliers, as forces, are no more than rounding leaves of the forces of the scene: where nothing
/// presses, as in free fall, reactions are never less. After evaluate().
bool is_round_off(const Model& model, const State& state, const Evaluation& evaluation,
                  const Eigen::Ref<const Eigen::VectorXd>& multipliers);

/// Internal forces of one superelement that no iteration removes: positions are rounded to ε length and turns to ε,
/// which changes the generalised strains of stiffening by up to Σ_k |l_ak| δ_k, and their forces on internal
/// coordinates by as much times |h_a| ([SO] 3). After evaluate(). Zero for linear bodies, whose internal coordinates
/// feel no boundary.
double internal_round_off(const Model& model, std::size_t superelement, const Evaluation& evaluation);

/// The largest of all superelements.
double internal_round_off(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
