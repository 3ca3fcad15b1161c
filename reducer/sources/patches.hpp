// SPDX-License-Identifier: GPL-3.0-or-later
// Plates, discs, cylinders and extrusions of part.yaml as cells: mapped meshes whose coincident nodes are merged.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/mesh/cells.hpp"
#include "reducer/sources/node_grid.hpp"

namespace tisserand::reducer {

/// Mesh of the patches of a part, with merged and labelled nodes.
struct PatchMesh {
  /// Cells; its entities are the patches as faces with their names, then the edges ("deck/edge1").
  CellMesh cells;
  MergedNodes nodes{1.0};          ///< nodes, merged if they are at the same place (within 1e-6 of the shortest edge)
  std::vector<std::string> label;  ///< label of each node, such as "deck[2,5]"
};

PatchMesh mesh_patches(const formats::Part& part);

/// Positions and labels of the nodes of all patches and beams, and the sequences of nodes of beams: input of
/// check_conformity().
struct OwnLines {
  const std::vector<Eigen::Vector3d>& position;
  const std::vector<std::string>& label;
  const std::vector<std::vector<int>>& beams;
};

/// Throws Error if a node lies on an edge of another object without being a node of this edge. It may be a node of a
/// patch or beam on an element of another patch, or a node of a patch on a beam. Objects that touch need equal
/// divisions. The nodes of `patches` are rows of `lines.position`.
void check_conformity(const formats::Part& part, const CellMesh& patches, const OwnLines& lines);

}  // namespace tisserand::reducer
