// How far forces and constraints are from balance, and what rounding leaves of them: below it no iteration brings them.
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

/// Largest force on a node that counts as none: `share` of the present forces, or what rounding leaves.
double allowed_force(const Model& model, const State& state, const Evaluation& evaluation, double share);

/// Row of a constraint, or of its rate, that is most open: lengths relative to the characteristic one, angles in
/// radians. The first NaN is the largest.
struct Violation {
  double value = 0.0;
  int row = -1;
};
/// Φ or Φ̇ in `rows`.
double violation_of(const Model& model, const Eigen::VectorXd& rows, int row);
Violation largest_violation(const Model& model, const Eigen::VectorXd& rows);
/// Φ of the last evaluate(), of the rows that are solved for or of those that are left out. The latter stay at
/// round-off as long as they follow from the others: they open where the rank of the constraints is higher than when
/// rows were chosen, or where the others have become dependent.
enum class Rows { solved, left_out };
Violation largest_violation(const Model& model, const Evaluation& evaluation, Rows kind);

/// Whether these multipliers, as forces, are no more than rounding leaves of the forces of the scene: where nothing
/// presses, as in free fall, reactions are never less. After evaluate().
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
