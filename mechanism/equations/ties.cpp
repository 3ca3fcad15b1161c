// SPDX-License-Identifier: GPL-3.0-or-later
// Wrenches that the vanished fixed joints of eliminated virtual bodies transmit.
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

/// Adds the wrenches on both ends, [force world; moment about the node, its axes], to their followers.
void add_pair(const Marker& a, const Marker& b, const Row12& force, Evaluation& evaluation) {
  if (a.follower >= 0) evaluation.tie_wrenches[a.follower] += force.head<6>().transpose();
  if (b.follower >= 0) evaluation.tie_wrenches[b.follower] += force.tail<6>().transpose();
}

}  // namespace

void evaluate_ties(const Model& model, const State& state, const double* lambda, Evaluation& evaluation) {
  std::vector<Vector6d>& wrenches = evaluation.tie_wrenches;
  for (Vector6d& wrench : wrenches) wrench.setZero();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    Row12 force = Row12::Zero();
    for (int k = 0; k < joint.size(); ++k) force -= lambda[joint.row + k] * evaluation.joints[i].B.row(k);
    add_pair(joint.a, joint.b, force, evaluation);
  }
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Row12 force = (-lambda[coupling.row] * term.factor) * evaluation.coordinates[at].G;
      add_pair(model.coordinates[at].a, model.coordinates[at].b, force, evaluation);
    }
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const auto at = static_cast<std::size_t>(model.springs[i].coordinate);
    const CoordinateTerms& c = evaluation.coordinates[at];
    const double applied = applied_force(model, i, state.load_time(), evaluation);
    const Row12 force = spring_force(model.springs[i], c.value, c.rate, applied).Q * c.G;
    add_pair(model.coordinates[at].a, model.coordinates[at].b, force, evaluation);
  }
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Joint& joint = model.joints[model.frictions[i].joint];
    add_pair(joint.a, joint.b, -evaluation.frictions[i].force.transpose(), evaluation);
  }
  for (std::size_t i = 0; i < model.bushings.size(); ++i)
    add_pair(model.bushings[i].a, model.bushings[i].b, -evaluation.bushings[i].force.transpose(), evaluation);
  for (std::size_t i = 0; i < model.tyres.size(); ++i)
    if (const int follower = model.tyres[i].wheel.follower; follower >= 0)
      wrenches[follower] -= evaluation.tyres[i].residual;
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    if (const Load& load = model.loads[i]; load.at.follower >= 0)
      wrenches[load.at.follower] += load_force(load, motion_of(evaluation, load.at.node), evaluation.load_values[i]);
  for (std::size_t i = wrenches.size(); i-- > 0;)
    if (const Tie& tie = model.ties[i]; !tie.is_loop && tie.parent >= 0) wrenches[tie.parent] += wrenches[i];
  for (Vector6d& wrench : wrenches) wrench = -wrench;
}

JointReaction tie_reaction(const Model& model, std::size_t i, const Evaluation& evaluation) {
  const Tie& tie = model.ties[i];
  const NodeMotion& carrier = motion_of(evaluation, tie.a.node);
  // The wrench on B is that on the follower, or its opposite. A multiplier's wrench is minus its pulled-back row.
  const double sign = tie.child == Tie::Side::b ? -1.0 : 1.0;
  Row12 row = Row12::Zero();
  row.tail<6>() = sign * evaluation.tie_wrenches[i].transpose();
  return reaction_of(row, {tie.a, tie.b, carrier, carrier});
}

}  // namespace tisserand::mechanism
