// Places of a scene by name, with the motion of their nodes at the start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/frames/marker.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

struct MarkerTable {
  std::map<std::string, Marker> places;
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

/// Throws Error unless the node of the marker has translations, and rotations if the marker is away from it or `turns`:
/// whether the axes of the marker matter.
enum class MarkerUse { position, position_and_axes };
void check_marker(const Model& model, const std::string& subject, MarkerUse use, const formats::MarkerSpec& place,
                  const Marker& marker);

}  // namespace tisserand::mechanism
