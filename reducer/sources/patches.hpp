// SPDX-License-Identifier: GPL-3.0-or-later
// Plates, discs, cylinders and extrusions of part.yaml as cells: mapped meshes whose coincident nodes are merged.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/mesh/cells.hpp"
#include "reducer/sources/node_grid.hpp"

namespace tisserand::reducer {

struct PatchMesh {
  CellMesh cells;                  ///< entities: each patch as a face with its name, then its edges ("deck/edge1")
  MergedNodes nodes{1.0};          ///< nodes at the same place (within 1e-6 of the shortest edge) are merged
  std::vector<std::string> label;  ///< label of each node: "deck[2,5]"
};

PatchMesh mesh_patches(const formats::Part& part);

/// Input of check_conformity: the nodes of all patches and beams, and the node sequences of beams.
struct OwnLines {
  const std::vector<Eigen::Vector3d>& position;
  const std::vector<std::string>& label;
  const std::vector<std::vector<int>>& beams;
};

/// Throws Error if a node lies on a foreign edge without being its node: a node of a patch or beam on another patch's
/// element, or one of a patch on a beam. Objects that touch need equal divisions. Cells' nodes are rows of `lines`.
void check_conformity(const formats::Part& part, const CellMesh& patches, const OwnLines& lines);

}  // namespace tisserand::reducer
