// SPDX-License-Identifier: GPL-3.0-or-later
// Selections by the names of groups in part.yaml, and the shares of their nodes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reducer/faces/face_facts.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"

namespace tisserand::reducer {

/// Selection by a name of part.yaml: entities of cells, elements of a set of a deck, or nodes.
struct Selection {
  std::vector<int> entities;  ///< indices in CellMesh::entities, each once
  ElementSet elements;        ///< elements of a deck
  std::vector<int> nodes;     ///< nodes that the group names individually
};

/// Selects by a name: a group of part.yaml, a patch or its edge, a physical group, a label of the CAD file, "face 3",
/// "all" (of `dimension`), or a set of a deck. `dimension`: 0 to 3, or -1 for any. Throws Error with the nearest name
/// if there is none.
Selection select(const MeshBuilder& builder, const std::string& name, int dimension, const User& user);

/// All names that select() knows, for messages and listings.
std::vector<std::string> group_names(const MeshBuilder& builder);

/// Nodes of a selection with their shares of its length, area or volume, sorted by node. The sum of the shares is the
/// whole. Nodes that are named individually share the faces, or else the edges, of elements between them. If there are
/// none, each node has the share 1.
std::vector<std::pair<int, double>> node_weights(const MeshBuilder& builder, const Selection& selection);

Cell shell_cell(const ShellElement& shell);

/// Faces of solids, or else shells, all of whose corners are among the nodes `named`.
FaceCells faces_between(const MeshBuilder& builder, const std::vector<int>& named);

/// Mean of the positions of the nodes of groups, weighted with the shares of node_weights().
Eigen::Vector3d centroid(const MeshBuilder& builder, const std::vector<std::string>& names, const User& user);

}  // namespace tisserand::reducer
