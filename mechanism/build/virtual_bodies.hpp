// Elimination of virtual bodies: what fixed joints tie to one becomes followers of one carrier at constant offsets.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/markers.hpp"

namespace tisserand::mechanism {

/// What became of the virtual bodies, which are the nodes from `first` on of the table that was given.
struct TiedBodies {
  std::vector<Marker> pose;  ///< of each on its carrier (node < first); a root that stays: on itself, p = 0, R = 1
  std::vector<int> roots;    ///< virtual bodies (from 0) of groups without a carrier, one per group: they stay nodes
  std::vector<Tie> ties;     ///< of the joints that vanish, markers on the carrier
  std::set<std::string> vanished;  ///< their names
  std::vector<RigidArm> arms;      ///< of these joints
};

/// Groups virtual bodies that fixed joints tie together ([GA00] section 4). The carrier of a group is ground if it is
/// tied to it, else the first node with rotations, else one of its own bodies. Fixed joints of the group with further
/// nodes stay joints, now between these and the carrier: exact, without a choice of whose coordinates to drop. Poses
/// follow from the ties; `markers.start` of the virtual bodies is set to them.
///
/// Throws Error if nothing determines the orientation of a group (only nodes without rotations are tied to it), if a
/// pose of the scene is off its tie by more than `tolerance` (relative to model.length, or radians), if a loop of ties
/// stays open.
TiedBodies tie_virtual_bodies(const formats::Scene& scene, const Model& model, int first, MarkerTable& markers);

}  // namespace tisserand::mechanism
