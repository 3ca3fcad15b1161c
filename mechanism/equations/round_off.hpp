// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of forces and constraints from balance, and the round-off that no iteration removes.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Largest distance of a node from the origin of the model, at least the length of the model. Positions are rounded to
/// ε of it.
double reach_of(const Model& model, const State& state);

/// Forces on nodes that no iteration removes: round-off of positions times the largest stiffness.
double force_round_off(const Model& model, const State& state);

/// Largest present force. Moments enter divided by the length, so that a zero scale of one kind does not stall a test.
double force_size(const Model& model, const Evaluation& evaluation);

/// Largest force on a node that counts as zero: `share` of the present forces, or the round-off.
double allowed_force(const Model& model, const State& state, const Evaluation& evaluation, double share);

/// Largest violation of a constraint or of its rate, with its row: lengths relative to the characteristic one, angles
/// in radians. The first NaN is the largest.
struct Violation {
  double value = 0.0;
  int row = -1;
};
/// Violation of one row of Φ or Φ̇, in `rows`.
double violation_of(const Model& model, const Eigen::VectorXd& rows, int row);
Violation largest_violation(const Model& model, const Eigen::VectorXd& rows);
/// Largest violation Φ at the last evaluate(), of the active or of the inactive rows. Inactive rows stay at round-off
/// as long as they follow from the others. They open if the rank of the constraints has grown since the rows were
/// chosen, or if the others have become dependent.
enum class Rows { solved, left_out };
Violation largest_violation(const Model& model, const Evaluation& evaluation, Rows kind);

/// Whether these multipliers, as forces, are round-off of the forces of the scene. Without loads, as in free fall,
/// reactions do not become smaller. Needs evaluate().
bool is_round_off(const Model& model, const State& state, const Evaluation& evaluation,
                  const Eigen::Ref<const Eigen::VectorXd>& multipliers);

/// Internal forces of one superelement that no iteration removes. Positions are rounded to ε length and rotations to ε.
/// This changes the generalised strains of stiffening by up to Σ_k |l_ak| δ_k, and their forces on internal coordinates
/// by as much times |h_a| of THEORY (44). Needs evaluate(). Zero for linear bodies, whose internal coordinates do not
/// depend on the boundary.
double internal_round_off(const Model& model, std::size_t superelement, const Evaluation& evaluation);

/// Largest internal round-off of all superelements.
double internal_round_off(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
