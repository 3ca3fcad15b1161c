// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of a body and its nodes from a modal body file: units, choice of modes, damping.
#pragma once

#include <vector>

#include "formats/modal_body/modal_body.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/bodies/modal/node.hpp"

namespace tisserand::mechanism {

struct BuiltModalBody {
  ModalBody body;  ///< without the node of its frame
  std::vector<ModalNode> nodes;
  Eigen::Vector3d frame_position = Eigen::Vector3d::Zero();  ///< body frame in the part frame, scene units
  Eigen::Matrix3d frame_rotation = Eigen::Matrix3d::Identity();
};

/// Builds a modal body with the lowest `modes`, or those below `cutoff`. Damping of the scene adds to that of the file.
/// It acts on the modes alone, so rigid motion is not damped. Throws Error for more modes or ratios than the file has.
BuiltModalBody build_modal_body(const formats::ModalBody& file, const formats::ModalBodySpec& spec,
                                const UnitConversion& units);

struct Construction;

/// Notes each modal body whose first frequency, held as joints to ground hold it, is over 2 % too high because static
/// flexibility is missing. Requires all joints. Not for planar scenes: motion out of the plane has no effect there.
void note_held_modes(Construction& c);

}  // namespace tisserand::mechanism
