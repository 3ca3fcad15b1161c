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

/// Rigid arm between a place that a joint names and the position of the joint, if the scene does not request it.
struct RigidArm {
  std::string joint;
  std::string place;
  double length = 0.0;  ///< along directions that the joint constrains
};

struct MarkerTable {
  std::map<std::string, Marker> places;
  std::set<std::string> frames;   ///< places that are the frame of a body, not one of its nodes
  std::vector<NodeMotion> start;  ///< motion of each node at the start
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Model::origin; markers do not contain it

  /// Marker that a scene names, with its own offset. Throws Error that suggests the nearest name.
  Marker find(const formats::MarkerSpec& spec) const;
  NodeMotion motion(int node) const { return node < 0 ? NodeMotion{} : start[node]; }
  Eigen::Vector3d position(const Marker& marker) const { return marker_position(marker, motion(marker.node)); }
};

/// Gives the markers a and b of a pair one world pose at the start where the scene leaves them open. Position: that of
/// the pair, else that of b, or of a if b is ground or only a has a position. Axes: the pair's `axis`, else those of
/// the marker with an orientation, else the world axes.
void place_markers(const MarkerTable& markers, const formats::MarkerPairSpec& spec, Marker& a, Marker& b);

/// Data of a marker that an element needs: its position, a direction of its axes, or all of them.
struct MarkerUse {
  bool position = true;
  bool axes = false;
  bool other_way_round = false;  ///< axes: those of the other marker suffice if a and b are exchanged
};
inline constexpr MarkerUse use_position{true, false}, use_axes{false, true}, use_position_and_axes{true, true};

/// Throws Error if the node of the marker lacks translations or rotations that the use needs. Markers off the node need
/// rotations too.
void check_marker(const Model& model, const std::string& subject, MarkerUse use, const formats::MarkerSpec& place,
                  const Marker& marker);

/// Appends the rigid arms of a joint with placed markers, from the places that it names to its position. An arm does
/// not count if `position` of the marker, or that of the joint or of the other marker for the frame of a body, gives
/// it. `length`: size of the scene; less than 1e-6 of it is the round-off of files with seven digits.
void add_rigid_arms(const MarkerTable& markers, const formats::JointSpec& spec, const Joint& joint, double length,
                    std::vector<RigidArm>& arms);

/// One sentence with the ten longest arms; empty without arms.
std::string rigid_arms_text(std::vector<RigidArm> arms, const Units& units);

}  // namespace tisserand::mechanism
