// SPDX-License-Identifier: GPL-3.0-or-later
// Least kinetic energy of the carried motion, divided among the deforming bodies.
#include "mechanism/switching/carried_inertia.hpp"

#include <algorithm>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/switching/deformation.hpp"

namespace tisserand::mechanism {

using Eigen::VectorXd;

CarriedInertia::CarriedInertia(const Model& running, const Model& whole)
    : running_(running), whole_(whole), now_(running), matrix_(running) {}

void CarriedInertia::set(const State& running, double step) {
  evaluate(running_, running, now_);
  matrix_.forget();  // a run from a checkpoint begins here
  usable_ = running_.sizes.constraints > 0 && running_.sizes.constraints == whole_.sizes.constraints &&
            matrix_.factor(running_, running, {{1.0, 0.0, step * step}, TangentKind::step, {}}, now_).regular;
}

void CarriedInertia::add_velocity(std::size_t index, const VectorXd& rate, const Evaluation& now, VectorXd& v) const {
  if (const int modal = modal_body_of(whole_, index); modal >= 0) {
    const ModalBody& body = whole_.modal_bodies[modal];
    const Node& frame = whole_.nodes[body.node];
    v.segment<3>(frame.translation) += now.modal_bodies[modal].A * rate.head<3>();
    v.segment<3>(frame.rotation) += rate.segment<3>(3);
    v.segment(whole_.sizes.first_modal() + body.offset, body.modes) += rate.tail(body.modes);
    return;
  }
  const SuperelementBody& body = body_of(whole_, index);
  const Eigen::Matrix3d& R0 = now.superelements[index].motion.R0;
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const SuperelementNode& local = body.node[j];
    const Node& node = whole_.nodes[whole_.superelements[index].nodes[j]];
    if (local.has_translation()) v.segment<3>(node.translation) += R0 * rate.segment<3>(local.translation_row);
    if (local.has_rotation()) v.segment<3>(node.rotation) += rate.segment<3>(local.rotation_row);
  }
}

std::vector<double> CarriedInertia::energies(const std::vector<VectorXd>& rates, const Evaluation& whole) {
  std::vector<double> list(rates.size(), 0.0);
  if (!usable_) return list;
  VectorXd v = VectorXd::Zero(whole_.sizes.velocities()), rows(whole_.sizes.constraints);
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (rates[i].size() > 0) add_velocity(i, rates[i], whole, v);
  apply_jacobian(whole_, whole, v, rows);
  matrix_.solve_projection(running_, -rows, now_);
  VectorXd force(v.size());
  apply_transposed_jacobian(whole_, whole, matrix_.projection_multipliers, force);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (rates[i].size() == 0) continue;
    v.setZero();
    add_velocity(i, rates[i], whole, v);
    list[i] = std::max(0.0, 0.5 * force.dot(v));
  }
  return list;
}

}  // namespace tisserand::mechanism
