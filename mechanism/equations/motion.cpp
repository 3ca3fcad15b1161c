// SPDX-License-Identifier: GPL-3.0-or-later
// Stage motion: motion of nodes and modes at a state.
#include "mechanism/equations/terms.hpp"

#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

void update_modal_node(const Model& model, std::size_t i, Evaluation& evaluation) {
  const ModalNode& node = model.modal_nodes[i];
  const auto body = static_cast<std::size_t>(node.body);
  const ModalScratch& scratch = evaluation.modal_bodies[body];
  const NodeMotion& frame = motion_of(evaluation, model.modal_bodies[body].node);
  in_space(model.planar && node.x.z() == 0.0, [&]<int D>() {
    update_node<D>(node, scratch, frame, evaluation.motion[node.node], evaluation.modal_nodes[i]);
  });
}

}  // namespace

void update_motion(const Model& model, const State& state, Evaluation& evaluation) {
  const auto x = state.x();
  const auto Q = state.Q();
  const auto v = state.v();
  const auto vdot = state.vdot();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.modal >= 0) continue;
    NodeMotion& motion = evaluation.motion[i];
    const auto column = static_cast<Eigen::Index>(i);
    motion.x = x.col(column);
    if (model.planar) {  // components out of the plane keep their initial values
      const double w = Q(0, column), z = Q(3, column);
      motion.R(0, 0) = motion.R(1, 1) = 1.0 - 2.0 * z * z;
      motion.R(0, 1) = -(motion.R(1, 0) = 2.0 * w * z);
      if (node.translation >= 0) {
        motion.xd.head<2>() = v.segment<2>(node.translation);
        motion.xdd.head<2>() = vdot.segment<2>(node.translation);
      }
      if (node.rotation >= 0) {
        motion.Omega.z() = v[node.rotation];
        motion.Omegad.z() = vdot[node.rotation];
      }
      continue;
    }
    motion.R = Eigen::Quaterniond(Q(0, column), Q(1, column), Q(2, column), Q(3, column)).toRotationMatrix();
    if (node.translation >= 0) {
      motion.xd = translation_at(model, v, node.translation);
      motion.xdd = translation_at(model, vdot, node.translation);
    }
    if (node.rotation >= 0) {
      motion.Omega = rotation_at(model, v, node.rotation);
      motion.Omegad = rotation_at(model, vdot, node.rotation);
    }
  }
  for (std::size_t i = 0; i < model.tyres.size(); ++i)
    if (const Tyre& tyre = model.tyres[i]; tyre.relaxes()) {
      const int at = model.sizes.first_modal() + tyre.lag;
      evaluation.treads[i] = {state.w().segment<2>(tyre.lag), v.segment<2>(at), vdot.segment<2>(at)};
    }
}

/// Updates frames, modes and the active nodes of modal bodies.
void update_modal_bodies(const Model& model, const State& state, Evaluation& evaluation) {
  for (Vector6d& force : evaluation.modal_forces) force.setZero();  // forces there are added with all forces
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const int first = model.sizes.first_modal() + body.offset;
    const NodeMotion& frame = motion_of(evaluation, body.node);
    const ModalCoordinates modes{state.w().data() + body.offset, state.v().data() + first, state.vdot().data() + first};
    const Eigen::Vector3d gravity = evaluation.load_factor * body.gravity;
    update_kinematics(body, frame, modes, gravity, evaluation.modal_bodies[i]);
  }
  for (std::size_t i = 0; i < model.modal_nodes.size(); ++i)
    if (model.modal_nodes[i].active) update_modal_node(model, i, evaluation);
}

void update_modal_nodes(const Model& model, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.modal_nodes.size(); ++i)
    if (!model.modal_nodes[i].active) update_modal_node(model, i, evaluation);
}

}  // namespace tisserand::mechanism
