// SPDX-License-Identifier: GPL-3.0-or-later
// Part loads: factors for superelements, whose bodies compute the forces, and resultants on rigid bodies.
#include "mechanism/equations/forces.hpp"

namespace tisserand::mechanism {
namespace {

/// Wrench of the load with the factor 1 on the node of a rigid body [force world; moment material].
Vector6d resultant(const PartLoad& load, const NodeMotion& node) {
  Vector6d force;
  force << node.R * load.force, load.moment;
  return force;
}

}  // namespace

void update_part_loads(const Model& model, const State& state, Evaluation& evaluation) {
  for (const PartLoad& load : model.part_loads)
    if (load.superelement >= 0) evaluation.superelements[load.superelement].forces.loads.factors.setZero();
  for (std::size_t i = 0; i < model.part_loads.size(); ++i) {
    const PartLoad& load = model.part_loads[i];
    double& value = evaluation.part_load_values[i];
    value = evaluation.load_factor * evaluation.part_load_functions[i](state.load_time());
    if (load.superelement >= 0)
      evaluation.superelements[load.superelement].forces.loads.factors[load.load_case] += value;
  }
}

void add_forces(const Model& model, const State& /*state*/, const Pool<PartLoad>& pool, Evaluation& evaluation) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const PartLoad& load = pool[i];
    if (load.superelement >= 0) continue;
    const NodeMotion& node = motion_of(evaluation, load.node);
    const Vector6d force = evaluation.part_load_values[i] * resultant(load, node);
    add_force(model, pool.maps[i], Vector6d(-force), evaluation);
    note_scale(force, evaluation);
    evaluation.load_power += force.head<3>().dot(node.xd) + force.tail<3>().dot(node.Omega);
  }
}

void add_tangents(const Model& /*model*/, const Pool<PartLoad>& pool, Evaluation& evaluation,
                  const TangentTarget& target) {
  Matrix6d A = Matrix6d::Zero();  // δ(R f) = −R f~ δΘ
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const PartLoad& load = pool[i];
    if (load.superelement >= 0) continue;
    const Eigen::Matrix3d& R = motion_of(evaluation, load.node).R;
    A.topRightCorner<3, 3>() =
        target.coefficients.stiffness * evaluation.part_load_values[i] * (R * skew<double>(load.force));
    scatter_matrix(pool.maps[i], A, target.factor, target.values);
  }
}

void update_direction(const Model& model, std::size_t i, Evaluation& evaluation) {
  const PartLoad& load = model.part_loads[i];
  PartLoadDirection& direction = evaluation.part_load_directions[i];
  if (load.superelement < 0)
    direction.boundary = resultant(load, motion_of(evaluation, load.node));
  else
    load_case_direction(body_of(model, load.superelement), load.load_case, evaluation.superelements[load.superelement],
                        direction.boundary, direction.internal);
}

}  // namespace tisserand::mechanism
