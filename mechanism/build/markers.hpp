// Places of a scene by name, with the motion of their nodes at the start.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/frames/marker.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// A joint that stands away from a place which it names, without the scene having said so: a rigid arm bridges it.
struct RigidArm {
  std::string joint;
  std::string place;
  double length = 0.0;  ///< along directions that the joint holds
};

struct MarkerTable {
  std::map<std::string, Marker> places;
  std::set<std::string> frames;   ///< places that are the frame of a body, not a node of it
  std::vector<NodeMotion> start;  ///< of each node
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Model::origin: positions of the scene have it, markers do not

  /// The marker that a scene names, with its own offset. Throws Error with the nearest name.
  Marker find(const formats::MarkerSpec& spec) const;
  NodeMotion motion(int node) const { return node < 0 ? NodeMotion{} : start[node]; }
  Eigen::Vector3d position(const Marker& marker) const { return marker_position(marker, motion(marker.node)); }
};

/// Gives the markers a and b of a pair, as found by name, one pose in the world at the start where the scene leaves
/// them open: its `position`, else that of b, or of a if b is ground or if only a has a position; its `axis`, else the
/// axes of the marker that has an orientation, or those of the world.
void place_markers(const MarkerTable& markers, const formats::MarkerPairSpec& spec, Marker& a, Marker& b);

/// What acts on a marker needs its place, a direction of its axes, or all of them.
struct MarkerUse {
  bool position = true;
  bool axes = false;
  bool other_way_round = false;  ///< axes: those of the other marker would do if a and b were exchanged
};
inline constexpr MarkerUse use_position{true, false}, use_axes{false, true}, use_position_and_axes{true, true};

/// Throws Error unless the node of the marker has the translations and rotations that the use needs; rotations also
/// where the marker is away from it.
void check_marker(const Model& model, const std::string& subject, MarkerUse use, const formats::MarkerSpec& place,
                  const Marker& marker);

/// The rigid arms of a joint whose markers were placed, from the places that it names to where it stands: those which
/// neither `position` of a marker says, nor that of the joint or of the other marker where the place is the frame of a
/// body. `length`: size of the scene; less than 1e-6 of it is the round-off of files with seven digits.
void add_rigid_arms(const MarkerTable& markers, const formats::JointSpec& spec, const Joint& joint, double length,
                    std::vector<RigidArm>& arms);

/// One sentence with the ten longest; none without arms.
std::string rigid_arms_text(std::vector<RigidArm> arms, const Units& units);

}  // namespace tisserand::mechanism
