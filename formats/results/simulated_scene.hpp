// SPDX-License-Identifier: GPL-3.0-or-later
// The simulated scene, as far as pictures of a run need it: its text, its bodies, and the positions of joints and
// springs.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tisserand::formats {

/// Body with data of its file (not-a-number: unknown). Positions are in the part frame, units of the scene.
struct SimulatedBody {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::string name;
  std::string kind;        ///< superelement, rigid, beam, virtual, modal
  std::string content_id;  ///< content_id of its superelement, modal body or mirror image, or empty
  std::string file;        ///< path of its file as the run had it, or empty
  double mass = unknown;
  double gyration = unknown;  ///< radius of gyration: mass × its square is a third of the inertia's trace
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Constant(unknown);
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< origin of the undeformed floating frame
};

/// Pose relative to a stored node, in the axes of the node, or to the world (ground).
struct SimulatedMarker {
  static constexpr int ground = -1, not_stored = -2;
  int node = not_stored;  ///< index in ResultsLayout::nodes, or one of the two above
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Joint, spring, bushing, load or tyre. `kind`: "joint/revolute", "spring/line", "bushing", "load/force/body", "tyre".
struct SimulatedLink {
  std::string name;
  std::string kind;
  std::array<SimulatedMarker, 2> ends;  ///< a and b; a load or tyre (axle: y) uses the first only
};

struct SimulatedScene {
  std::string analysis;  ///< type of the analysis in the scene: "dynamics"
  std::string text;      ///< Scene::text
  std::string file;      ///< path of the scene; paths in the text are relative to its folder
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<SimulatedBody> bodies;
  std::vector<int> body_of_node;    ///< body of each stored node, −1: none
  Eigen::Matrix3Xd node_reference;  ///< position of each stored node in the part frame of its body, undeformed
  std::vector<SimulatedLink> links;

  bool empty() const { return bodies.empty(); }
};

}  // namespace tisserand::formats
