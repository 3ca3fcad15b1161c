// SPDX-License-Identifier: GPL-3.0-or-later
// Elimination of virtual bodies: all that fixed joints tie to one follows one carrier at constant offsets.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/markers.hpp"

namespace tisserand::mechanism {

/// Result of the elimination of virtual bodies. They are the nodes from index `first` on of the given table.
struct TiedBodies {
  /// Pose of each virtual body on its carrier (node < first). A root that stays a node is its own carrier, with p = 0
  /// and R = 1.
  std::vector<Marker> pose;
  /// Indices (from 0) of virtual bodies that stay nodes, one for each group without a carrier.
  std::vector<int> roots;
  std::vector<Tie> ties;           ///< ties of the joints that disappear, with markers on the carrier
  std::set<std::string> vanished;  ///< names of the joints that disappear
  std::vector<RigidArm> arms;      ///< rigid arms of the joints that disappear
};

/// Groups virtual bodies that fixed joints tie together ([GA00] section 4), and finds one carrier for each group. The
/// carrier is ground if the group is tied to ground, else the first node with rotations that is tied to it, else one of
/// the bodies of the group. Fixed joints of the group with further nodes remain joints between these nodes and the
/// carrier. The elimination is exact and needs no choice of coordinates to drop. Poses follow from the ties. Sets
/// `markers.start` of the virtual bodies to these poses.
///
/// Throws Error if nothing determines the orientation of a group, because only nodes without rotations are tied to it.
/// It also throws if a pose of the scene deviates from its tie by more than `initial_tolerance` of the scene
/// (relative to model.length, or radians), and if a loop of ties stays open.
TiedBodies tie_virtual_bodies(const formats::Scene& scene, const Model& model, int first, MarkerTable& markers);

}  // namespace tisserand::mechanism
