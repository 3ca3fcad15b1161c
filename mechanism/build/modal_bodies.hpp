// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of a body and its nodes from a modal body file: units, choice of modes, damping.
#pragma once

#include <vector>

#include "formats/modal_body/modal_body.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/bodies/modal/node.hpp"

namespace tisserand::mechanism {

/// Modal body made from a file, with its nodes and the pose of its frame in the part frame.
struct BuiltModalBody {
  ModalBody body;  ///< modal body, not yet on the node of its frame
  std::vector<ModalNode> nodes;
  /// Origin of the body frame in the part frame, units of the scene.
  Eigen::Vector3d frame_position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame_rotation = Eigen::Matrix3d::Identity();
};

/// Builds a modal body with the lowest `modes` of the file, or with those below `cutoff` (keys of `spec`). `units`:
/// from the units of the file to those of the scene. Damping of the scene adds to that of the file. It acts on the
/// modes alone, so rigid motion is not damped. Throws Error for more modes or damping ratios than the file has.
BuiltModalBody build_modal_body(const formats::ModalBody& file, const formats::ModalBodySpec& spec,
                                const UnitConversion& units);

struct Construction;

/// Adds a note for each modal body whose first frequency is more than 2 % too high, because static flexibility is
/// missing. The frequency is that of the body held as its joints to ground hold it. Requires that all joints were
/// added. Not for planar scenes: motion out of the plane has no effect there.
void note_held_modes(Construction& c);

}  // namespace tisserand::mechanism
