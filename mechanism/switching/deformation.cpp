// SPDX-License-Identifier: GPL-3.0-or-later
// Indices, deformations and welded parts of the deforming bodies.
#include "mechanism/switching/deformation.hpp"

#include <algorithm>

#include "mechanism/bodies/superelement/frame/kinematics.hpp"
#include "mechanism/doubts/held_body.hpp"

namespace tisserand::mechanism {

using Eigen::VectorXd;

const std::string& name_of(const Model& model, std::size_t index) {
  const int modal = modal_body_of(model, index);
  return modal < 0 ? model.superelements[index].name : model.modal_bodies[modal].name;
}

std::size_t deforming_body(const Model& model, const std::string& name) {
  std::size_t index = 0;
  while (index < deforming_bodies(model) && name_of(model, index) != name) ++index;
  return index;
}

Eigen::Index deformation_size(const Model& model, std::size_t index) {
  const int modal = modal_body_of(model, index);
  if (modal >= 0) return 6 + model.modal_bodies[modal].modes;
  return body_of(model, index).boundary_size + body_of(model, index).modes;
}

VectorXd y_of(const Model& model, std::size_t index, const Evaluation& now) {
  VectorXd y = VectorXd::Zero(deformation_size(model, index));
  if (const int modal = modal_body_of(model, index); modal >= 0)
    y.tail(y.size() - 6) = now.modal_bodies[modal].w;
  else
    y << now.superelements[index].motion.y_B, now.superelements[index].motion.y_I;
  return y;
}

Deformation deformation_of(const Model& model, std::size_t index, const Evaluation& now) {
  Deformation deformation{y_of(model, index, now), VectorXd::Zero(deformation_size(model, index))};
  if (const int modal = modal_body_of(model, index); modal >= 0) {
    deformation.rate.tail(deformation.rate.size() - 6) = now.modal_bodies[modal].wd;
    return deformation;
  }
  LocalMotion<double> motion = now.superelements[index].motion;
  deformation_rates(body_of(model, index), nodes_of(model, index, now), motion);
  deformation.rate << motion.deformation_rate_B, motion.rate_I;
  return deformation;
}

double largest_speed(const Model& model, const State& state) {
  double largest = 0.0;
  for (const Node& node : model.nodes)
    if (node.translation >= 0) largest = std::max(largest, state.v().segment<3>(node.translation).norm());
  return largest;
}

std::vector<int> welded_parts(const Model& model) {
  std::vector<int> part = welded_beams(model), owner(model.nodes.size(), -1);
  for (int i = 0; i < std::ssize(model.superelements); ++i)
    for (const int node : model.superelements[i].nodes) owner[node] = i;
  for (std::size_t i = part.size(); i < deforming_bodies(model); ++i) part.push_back(static_cast<int>(i));
  const auto before = count_of(model.superelements);
  for (const ModalNode& node : model.modal_nodes) owner[node.node] = before + node.body;
  for (const Joint& joint : model.joints) {
    const int a = joint.a.node < 0 ? -1 : owner[joint.a.node], b = joint.b.node < 0 ? -1 : owner[joint.b.node];
    if (joint.kind != JointKind::fixed || a < 0 || b < 0) continue;
    const int from = part[a], to = part[b];
    std::ranges::replace(part, from, to);
  }
  return part;
}

}  // namespace tisserand::mechanism
