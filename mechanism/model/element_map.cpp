// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of elements from the coordinates of their nodes.
#include "mechanism/model/element_map.hpp"

#include <algorithm>

#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {

void append_carrier(const Model& model, int node, std::vector<int>& coordinates) {
  const int modal = modal_node(model, node);
  const int owner = modal < 0 ? node : modal_body_of(model, modal).node;
  for (int k = 0; k < 6; ++k) coordinates.push_back(owner < 0 ? -1 : coordinate_of(model, model.nodes[owner], k));
  if (modal < 0) return;
  const ModalBody& body = modal_body_of(model, modal);
  for (int k = 0; k < body.modes; ++k) coordinates.push_back(model.sizes.first_modal() + body.offset + k);
}

ElementMap carrier_map(const Model& model, const std::vector<int>& nodes) {
  ElementMap map;
  for (const int node : nodes) append_carrier(model, node, map.coordinates);
  const bool dependent =
      std::any_of(nodes.begin(), nodes.end(), [&](int node) { return modal_node(model, node) >= 0; });
  if (dependent) map.carriers = nodes;
  return map;
}

}  // namespace tisserand::mechanism
