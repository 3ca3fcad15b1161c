// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of an element, joint or load on given nodes: the positions of its rows and columns.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Index of the modal node through which a node follows its body. −1: ground, or a node that owns its coordinates.
inline int modal_node(const Model& model, int node) { return node < 0 ? -1 : model.nodes[node].modal; }

/// Modal body of a modal node.
inline const ModalBody& modal_body_of(const Model& model, int modal) {
  return model.modal_bodies[model.modal_nodes[modal].body];
}

/// Appends the coordinates of a node to `coordinates`. A node with own coordinates has six, −1 where it owns none, and
/// the ground has six −1. A node that follows a modal body has the 6 + m of this body.
void append_carrier(const Model& model, int node, std::vector<int>& coordinates);

/// Entries of `global` at the coordinates of a carrier (a node that owns its coordinates). They are zero for the
/// ground.
template <int D>
CarrierVector<D> gather_carrier(const int* coordinates, const Eigen::VectorXd& global) {
  CarrierVector<D> local;
  for (int c = 0; c < local.size(); ++c) {
    const int coordinate = coordinates[Space<D>::columns[c]];
    local[c] = coordinate < 0 ? 0.0 : global[coordinate];
  }
  return local;
}
/// Adds `local` to the entries of `global` at the coordinates of a carrier (a node that owns its coordinates).
template <int D>
void scatter_carrier(const int* coordinates, const CarrierVector<D>& local, Eigen::VectorXd& global) {
  for (int c = 0; c < local.size(); ++c)
    if (const int at = coordinates[Space<D>::columns[c]]; at >= 0) global[at] += local[c];
}

/// Map of an element that acts on `nodes`: their coordinates one after the other. It lists the nodes as carriers if one
/// of them follows a modal body.
ElementMap carrier_map(const Model& model, const std::vector<int>& nodes);

}  // namespace tisserand::mechanism
