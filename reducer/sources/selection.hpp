// What the names of groups in part.yaml select, and how nodes share its area.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reducer/faces/face_facts.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"

namespace tisserand::reducer {

/// Entities of cells, elements of a deck's set, or nodes.
struct Selection {
  std::vector<int> entities;  ///< rows of CellMesh::entities, each once
  ElementSet elements;        ///< of a deck
  std::vector<int> nodes;     ///< nodes that are named themselves
};

/// By name: a group of part.yaml, a patch or its edge, a physical group, a label of the CAD file, "face 3", "all" (of
/// `dimension`), or a set of a deck. dimension 0-3, or -1: whatever the name means. Throws Error with the nearest name.
Selection select(const MeshBuilder& builder, const std::string& name, int dimension, const User& user);

/// All names that select() knows, for messages and listings.
std::vector<std::string> group_names(const MeshBuilder& builder);

/// Nodes and their shares of length, area or volume (sum: the whole). Nodes that are named themselves share the faces,
/// or else the edges, of elements that lie between them; if there are none, each has 1. Sorted by node.
std::vector<std::pair<int, double>> node_weights(const MeshBuilder& builder, const Selection& selection);

Cell shell_cell(const ShellElement& shell);

/// Faces of solids, or else shells, all of whose corners are named.
FaceCells faces_between(const MeshBuilder& builder, const std::vector<int>& named);

/// Weighted mean of the nodes of groups.
Eigen::Vector3d centroid(const MeshBuilder& builder, const std::vector<std::string>& names, const User& user);

}  // namespace tisserand::reducer
