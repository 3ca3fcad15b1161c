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

/// Body of a simulated scene, with data of its file. An unknown number is NaN. Positions are in the part frame, in
/// units of the scene.
struct SimulatedBody {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::string name;
  std::string kind;  ///< superelement, rigid, beam, virtual, modal
  /// content_id of its superelement, modal body or mirror image; empty for other bodies.
  std::string content_id;
  std::string file;  ///< path of its file as given to the run; empty: no file
  double mass = unknown;
  double gyration = unknown;  ///< radius of gyration r: mass × r² is a third of the inertia's trace
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Constant(unknown);
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< origin of the undeformed floating frame
};

/// Pose relative to a stored node, in the axes of this node, or relative to the world (ground).
struct SimulatedMarker {
  static constexpr int ground = -1, not_stored = -2;
  int node = not_stored;  ///< index in ResultsLayout::nodes, or `ground` or `not_stored`
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Joint, spring, bushing, load or tyre, with its markers. `kind`: for example "joint/revolute", "spring/line",
/// "bushing", "load/force/body", "tyre".
struct SimulatedLink {
  std::string name;
  std::string kind;
  std::array<SimulatedMarker, 2> ends;  ///< markers a and b; a load or tyre uses the first only (y: axle)
};

/// The simulated scene, as results files store it for pictures.
struct SimulatedScene {
  std::string analysis;  ///< kind of the analysis, for example "dynamics"
  std::string text;      ///< text of the scene (text_with_contents())
  std::string file;      ///< path of the scene; paths in the text are relative to its folder
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<SimulatedBody> bodies;
  std::vector<int> body_of_node;    ///< index of the body of each stored node; −1: none
  Eigen::Matrix3Xd node_reference;  ///< position of each stored node in the part frame of its body, undeformed
  std::vector<SimulatedLink> links;

  bool empty() const { return bodies.empty(); }
};

}  // namespace tisserand::formats
