// SPDX-License-Identifier: GPL-3.0-or-later
// Hooks of the body types.
#include "mechanism/model/bodies.hpp"

#include "mechanism/model/element_map.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Name of the beam of a node: "rod/3" -> "rod".
std::string beam_name(const Model& model, int node) {
  const std::string& name = model.nodes[node].name;
  return name.substr(0, name.rfind('/'));
}

}  // namespace

std::vector<int> attached_nodes(const Model&, const SuperelementUse& use) { return use.nodes; }
std::vector<int> attached_nodes(const Model&, const BeamElement2& beam) {
  return {beam.nodes.begin(), beam.nodes.end()};
}
std::vector<int> attached_nodes(const Model&, const BeamElement3& beam) {
  return {beam.nodes.begin(), beam.nodes.end()};
}
std::vector<int> attached_nodes(const Model&, const RigidBody& body) { return {body.node}; }
std::vector<int> attached_nodes(const Model& model, const ModalBody& body) {
  std::vector<int> nodes{body.node};
  for (const ModalNode& node : model.modal_nodes)
    if (&model.modal_bodies[node.body] == &body) nodes.push_back(node.node);
  return nodes;
}

double mass_of(const Model& model, const SuperelementUse& use) { return model.superelement_bodies[use.body].mass; }

std::string name_of(const Model&, const SuperelementUse& use) { return use.name; }
std::string name_of(const Model& model, const BeamElement2& beam) { return beam_name(model, beam.nodes[0]); }
std::string name_of(const Model& model, const BeamElement3& beam) { return beam_name(model, beam.nodes[0]); }
std::string name_of(const Model&, const RigidBody& body) { return body.name; }
std::string name_of(const Model&, const ModalBody& body) { return body.name; }

bool is_damped(const Model& model, const SuperelementUse& use) {
  return model.superelement_bodies[use.body].damping.active;
}
bool is_damped(const Model&, const ModalBody& body) { return !body.damping.isZero(0.0); }

ElementMap body_map(const Model& model, const SuperelementUse& use) {
  const SuperelementBody& body = model.superelement_bodies[use.body];
  ElementMap map;
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const Node& node = model.nodes[use.nodes[j]];
    for (int k = 0; k < translations_of(model) && body.node[j].has_translation(); ++k)
      map.coordinates.push_back(node.translation + k);
    for (int k = 0; k < rotations_of(model) && body.node[j].has_rotation(); ++k)
      map.coordinates.push_back(node.rotation + k);
  }
  return map;
}
ElementMap body_map(const Model& model, const BeamElement2& beam) {
  return carrier_map(model, {beam.nodes.begin(), beam.nodes.end()});
}
ElementMap body_map(const Model& model, const BeamElement3& beam) {
  return carrier_map(model, {beam.nodes.begin(), beam.nodes.end()});
}
ElementMap body_map(const Model& model, const RigidBody& body) { return carrier_map(model, {body.node}); }
ElementMap body_map(const Model& model, const ModalBody& body) {
  ElementMap map = carrier_map(model, {body.node});
  for (int k = 0; k < body.modes; ++k) map.coordinates.push_back(model.sizes.first_modal() + body.offset + k);
  return map;
}

}  // namespace tisserand::mechanism
