// Distance of forces and constraints from balance, and the round-off that no iteration removes.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Largest distance of a node from the origin of the model, or its length if that is more: positions are rounded to ε
/// of it.
double reach_of(const Model& model, const State& state);

/// Forces on nodes that no iteration removes: the rounding of positions times the largest stiffness.
double force_round_off(const Model& model, const State& state);

/// Largest present force; moments count through the length, so that a scale of zero in one does not stall a test.
double force_size(const Model& model, const Evaluation& evaluation);

/// Largest force on a node that counts as zero: `share` of the present forces, or the round-off.
double allowed_force(const Model& model, const State& state, const Evaluation& evaluation, double share);

/// Row with the largest violation of a constraint or of its rate: lengths relative to the characteristic one, angles in
/// radians. The first NaN is the largest.
struct Violation {
  double value = 0.0;
  int row = -1;
};
/// Φ or Φ̇ in `rows`.
double violation_of(const Model& model, const Eigen::VectorXd& rows, int row);
Violation largest_violation(const Model& model, const Eigen::VectorXd& rows);
/// Largest violation Φ at the last evaluate(), of the rows that are solved for or of those that are left out. Rows left
/// out stay at round-off as long as they follow from the others. They open if the rank of the constraints has grown
/// since the rows were chosen, or if the others have become dependent.
enum class Rows { solved, left_out };
Violation largest_violation(const Model& model, const Evaluation& evaluation, Rows kind);

/// Whether these multipliers, as forces, are round-off of the forces of the scene. Without loads, as in free fall,
/// reactions do not become smaller. After evaluate().
bool is_round_off(const Model& model, const State& state, const Evaluation& evaluation,
                  const Eigen::Ref<const Eigen::VectorXd>& multipliers);

/// Internal forces of one superelement that no iteration removes: positions are rounded to ε length and turns to ε,
/// which changes the generalised strains of stiffening by up to Σ_k |l_ak| δ_k, and their forces on internal
/// coordinates by as much times |h_a| of THEORY (44). After evaluate(). Zero for linear bodies, whose internal
/// coordinates feel no boundary.
double internal_round_off(const Model& model, std::size_t superelement, const Evaluation& evaluation);

/// The largest of all superelements.
double internal_round_off(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
