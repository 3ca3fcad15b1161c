// From a modal body file to the constants of a body and its nodes: units, choice of modes, damping.
#pragma once

#include <vector>

#include "formats/modal_body/modal_body.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/bodies/modal/node.hpp"

namespace tisserand::mechanism {

struct BuiltModalBody {
  ModalBody body;  ///< without its frame's node
  std::vector<ModalNode> nodes;
  Eigen::Vector3d frame_position = Eigen::Vector3d::Zero();  ///< of the body frame in the part frame, scene units
  Eigen::Matrix3d frame_rotation = Eigen::Matrix3d::Identity();
};

/// Keeps the lowest `modes`, or those below `cutoff`; damping of the scene adds to that of the file, on the modes
/// alone: rigid motion is not damped. Throws Error for more modes or ratios than the file has.
BuiltModalBody build_modal_body(const formats::ModalBody& file, const formats::ModalBodySpec& spec,
                                const UnitConversion& units);

struct Construction;

/// Notes each modal body whose first frequency, with held what joints to ground hold, is too high by more than 2 % for
/// want of static flexibility. After all joints; not of planar scenes, where motion out of the plane does not matter.
void note_held_modes(Construction& c);

}  // namespace tisserand::mechanism
