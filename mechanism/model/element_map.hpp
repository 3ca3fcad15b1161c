// The coordinates that an element, joint or load on given nodes has: where its rows and columns go.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Index of the modal node that carries, −1 for ground and nodes that own their coordinates.
inline int modal_node(const Model& model, int node) { return node < 0 ? -1 : model.nodes[node].modal; }

/// The modal body that a modal node belongs to.
inline const ModalBody& modal_body_of(const Model& model, int modal) {
  return model.modal_bodies[model.modal_nodes[modal].body];
}

/// Appends the coordinates of a node: six (−1 where it owns none; ground: all −1), or 6 + m of the body it follows.
void append_carrier(const Model& model, int node, std::vector<int>& coordinates);

/// The map of an element on `nodes`: their coordinates one after the other, and the nodes if one follows a modal body.
ElementMap carrier_map(const Model& model, const std::vector<int>& nodes);

}  // namespace tisserand::mechanism
