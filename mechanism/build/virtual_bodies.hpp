// SPDX-License-Identifier: GPL-3.0-or-later
// Elimination of virtual bodies: all that fixed joints tie to one follows one carrier at constant offsets.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/markers.hpp"

namespace tisserand::mechanism {

/// Result for the virtual bodies, which are the nodes from `first` on of the given table.
struct TiedBodies {
  std::vector<Marker> pose;  ///< pose on its carrier (node < first); a root that stays: on itself, p = 0, R = 1
  std::vector<int> roots;    ///< virtual bodies (from 0) of groups without a carrier, one per group: they stay nodes
  std::vector<Tie> ties;     ///< ties of the joints that vanish, markers on the carrier
  std::set<std::string> vanished;  ///< names of these joints
  std::vector<RigidArm> arms;      ///< rigid arms of these joints
};

/// Groups virtual bodies that fixed joints tie together ([GA00] section 4). The carrier of a group is ground if it is
/// tied to it, else the first node with rotations, else one of its own bodies. Fixed joints of the group with further
/// nodes remain joints between these and the carrier. This is exact and needs no choice of coordinates to drop. Poses
/// follow from the ties, and `markers.start` of the virtual bodies is set to them.
///
/// Throws Error if nothing determines the orientation of a group, because only nodes without rotations are tied to it.
/// Throws Error also if a pose of the scene is off its tie by more than `tolerance` (relative to model.length, or
/// radians), and if a loop of ties stays open.
TiedBodies tie_virtual_bodies(const formats::Scene& scene, const Model& model, int first, MarkerTable& markers);

}  // namespace tisserand::mechanism
