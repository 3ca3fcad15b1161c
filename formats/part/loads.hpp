// SPDX-License-Identifier: GPL-3.0-or-later
// Loads and supports of part.yaml, which `reducer solve` uses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/place.hpp"

namespace tisserand::formats {

/// Support: a place or the nodes of groups, fixed in some directions of the part frame.
struct Support {
  std::string name;
  Place at;                     ///< used if `on` is empty: point, spider or boundary node by name, or a node
  std::vector<std::string> on;  ///< groups
  unsigned components = 0;      ///< fixed directions: bit 0-2 translations x, y, z; bit 3-5 rotations
  bool where_present = false;   ///< whether rotations are fixed only at nodes that have them (`all`, `symmetry`)
  std::optional<int> symmetry;  ///< axis (0, 1, 2) normal to a plane that must contain the nodes
  std::string where;
};

/// Force and moment at a place, in part axes.
struct PlaceLoad {
  std::string name;
  Place at;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  std::string where;
};

/// Pressure on a group of faces [force/area]. A positive value pushes against the normal of shells, and into solids.
struct PressureLoad {
  std::string on;  ///< group of faces
  double pressure = 0.0;
  std::string where;
};

/// Line load on a beam or on edges [force/length], in part axes.
struct LineLoad {
  std::string on;  ///< a beam of the part, or a group of edges
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  std::string where;
};

/// Load case of a part: the sum of its loads.
struct PartLoadCase {
  std::string name;
  std::vector<PlaceLoad> forces;
  std::vector<PressureLoad> pressures;
  std::vector<LineLoad> line_loads;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration; the force is mass times gravity
  std::string where;
};

}  // namespace tisserand::formats
