// SPDX-License-Identifier: GPL-3.0-or-later
// Named places of a scene, with the motion of their nodes at the start.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/frames/marker.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Rigid arm between a place that a joint names and the position of the joint, which arises although the scene does not
/// request it.
struct RigidArm {
  std::string joint;
  std::string place;
  double length = 0.0;  ///< length of the arm along directions that the joint constrains
};

/// Table of the places that a scene can name, with the motion of the nodes at the start.
struct MarkerTable {
  std::map<std::string, Marker> places;
  std::set<std::string> frames;   ///< names of places that are the frame of a body, not one of its nodes
  std::vector<NodeMotion> start;  ///< motion of each node at the start
  /// Origin Model::origin, relative to which all positions of markers are stored.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  /// Marker at the place that `spec` names, with the position and orientation of `spec`. Throws Error that suggests the
  /// nearest name.
  Marker find(const formats::MarkerSpec& spec) const;
  NodeMotion motion(int node) const { return node < 0 ? NodeMotion{} : start[node]; }
  Eigen::Vector3d position(const Marker& marker) const { return marker_position(marker, motion(marker.node)); }
};

/// Gives both markers of a pair the same world pose at the start, as far as the scene leaves their poses open.
/// Position: that of the pair, else that of b. It is that of a if b is ground or only a has a position. Axes: the
/// pair's `axis`, else those of the marker with an orientation, else the world axes.
void place_markers(const MarkerTable& markers, const formats::MarkerPairSpec& spec, Marker& a, Marker& b);

/// Data of a marker that an element uses: its position, a direction of its axes, or both.
struct MarkerUse {
  bool position = true;
  bool axes = false;
  /// With `axes`: whether it suffices that the other marker has axes, because a and b can be exchanged.
  bool other_way_round = false;
};
inline constexpr MarkerUse use_position{true, false}, use_axes{false, true}, use_position_and_axes{true, true};

/// Throws Error if the node of the marker lacks translations or rotations that `use` requires. A marker at a distance
/// from its node requires rotations too. `subject`: element that uses the marker, for the message.
void check_marker(const Model& model, const std::string& subject, MarkerUse use, const formats::MarkerSpec& place,
                  const Marker& marker);

/// Appends to `arms` the rigid arms of a joint with placed markers. Each arm leads from a place that the joint names to
/// the position of the joint. There is no arm if the marker has a `position` of its own. At the frame of a body there
/// is also none if the joint or the other marker has a `position`. `length`: size of the scene. Arms below 1e-6 of it
/// are the round-off of files with seven digits, and do not count.
void add_rigid_arms(const MarkerTable& markers, const formats::JointSpec& spec, const Joint& joint, double length,
                    std::vector<RigidArm>& arms);

/// Sentence that names the ten longest arms; empty without arms.
std::string rigid_arms_text(std::vector<RigidArm> arms, const Units& units);

}  // namespace tisserand::mechanism
