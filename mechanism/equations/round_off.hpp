// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of forces and constraints from balance, and the round-off that no iteration removes.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Largest absolute coordinate of a node, or the length of the model if that is larger. Positions have a round-off of ε
/// times this length.
double reach_of(const Model& model, const State& state);

/// Force on nodes that no iteration can remove: round-off of positions times the largest stiffness.
double force_round_off(const Model& model, const State& state);

/// Largest present force, in which moments count divided by the length of the model. So a zero scale of forces or of
/// moments does not stall a test.
double force_size(const Model& model, const Evaluation& evaluation);

/// Largest force on a node that counts as zero: `share` of the present forces, or the round-off of forces if that is
/// larger.
double allowed_force(const Model& model, const State& state, const Evaluation& evaluation, double share);

/// Largest violation of a constraint or of its rate, with its row. Lengths are relative to the length of the model,
/// angles in radians. The first NaN counts as the largest.
struct Violation {
  double value = 0.0;
  int row = -1;
};
/// Violation of one row in `rows`, which hold Φ or Φ̇: lengths relative to the length of the model, angles in radians.
double violation_of(const Model& model, const Eigen::VectorXd& rows, int row);
/// Largest violation in `rows`, which hold Φ or Φ̇ of all constraints.
Violation largest_violation(const Model& model, const Eigen::VectorXd& rows);
/// Kind of constraint rows: active rows (`solved`), or inactive rows (`left_out`), which depend on the active ones.
/// Inactive rows stay at round-off as long as they follow from the active ones. They open if the rank of the
/// constraints has grown since the rows were chosen, or if active rows have become dependent.
enum class Rows { solved, left_out };
/// Largest violation Φ at the last evaluate(), among the rows of one kind.
Violation largest_violation(const Model& model, const Evaluation& evaluation, Rows kind);

/// Whether `multipliers`, as forces, are no more than round-off of the forces of the scene. Without loads, as in free
/// fall, reactions do not become smaller. Requires evaluate().
bool is_round_off(const Model& model, const State& state, const Evaluation& evaluation,
                  const Eigen::Ref<const Eigen::VectorXd>& multipliers);

/// Internal forces of one superelement that no iteration can remove. Positions have a round-off of ε times their size,
/// rotations of ε. This round-off δ_k changes the generalised strains of stiffening by up to Σ_k |l_ak| δ_k. Forces on
/// internal coordinates change by as much times |h_a| of THEORY (44). The result is zero for linear bodies, whose
/// internal coordinates do not depend on the boundary. Requires evaluate().
double internal_round_off(const Model& model, std::size_t superelement, const Evaluation& evaluation);

/// Largest internal force of all superelements that no iteration can remove.
double internal_round_off(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
