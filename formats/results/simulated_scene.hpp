// What was simulated, as far as pictures of a run need it: the scene as text, its bodies, and where joints and springs
// sit.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tisserand::formats {

/// A body and what its file says of it; not-a-number: unknown. Positions are in the part frame, lengths of the scene.
struct SimulatedBody {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::string name;
  std::string kind;        ///< superelement, rigid, beam, virtual, modal
  std::string content_id;  ///< of its superelement or modal body file (of a mirrored one that of the image), or empty
  std::string file;        ///< its path as the run had it, or empty
  double mass = unknown;
  double gyration = unknown;  ///< radius: its square times the mass is a third of the trace of the inertia
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Constant(unknown);
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the undeformed floating frame
};

/// A pose on a stored node: position and orientation in its axes; on ground in the world.
struct SimulatedMarker {
  static constexpr int ground = -1, not_stored = -2;
  int node = not_stored;  ///< of ResultsLayout::nodes, or one of the two above
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// A joint, spring, bushing, load or tyre, by its word: "joint/revolute", "spring/line", "bushing", "load/force/body",
/// "tyre".
struct SimulatedLink {
  std::string name;
  std::string kind;
  std::array<SimulatedMarker, 2> ends;  ///< a and b; of a load and a tyre (axle: y) the first
};

struct SimulatedScene {
  std::string analysis;  ///< word of the scene: "dynamics"
  std::string text;      ///< Scene::text
  std::string file;      ///< of the scene; files in the text count from its folder
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<SimulatedBody> bodies;
  std::vector<int> body_of_node;    ///< of each stored node, −1: none
  Eigen::Matrix3Xd node_reference;  ///< of each stored node, in the part frame of its body, undeformed
  std::vector<SimulatedLink> links;

  bool empty() const { return bodies.empty(); }
};

}  // namespace tisserand::formats
