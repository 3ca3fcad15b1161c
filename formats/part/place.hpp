// SPDX-License-Identifier: GPL-3.0-or-later
// Attachment of items of part.yaml: places that become one node, and groups of faces, edges, volumes and nodes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

/// Kind of a place. name: point, or spider (its reference node). position: new node at coordinates. node: number in the
/// mesh file. near: node of the mesh file nearest to a position. centroid: new node at the centroid of a group (by
/// area, length or volume).
enum class PlaceKind { name, position, node, near, centroid };

/// A place that becomes one node.
struct Place {
  Place() = default;
  Place(const char* point) : name(point) {}
  Place(std::string point) : name(std::move(point)) {}

  PlaceKind kind = PlaceKind::name;
  std::string name;  ///< point or spider; for a centroid: group, empty: that of the spider
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position, near
  long node = 0;
  std::optional<double> tolerance;  ///< near: largest distance; absent: see PART.md
};

/// Entities that a group consists of. The numbers are their dimensions.
enum class Dimension { node = 0, edge = 1, face = 2, volume = 3 };

/// Selection of all entities that lie completely inside a box with sides along the axes.
struct BoxSelection {
  Eigen::Vector3d low, high;
};

/// Selection of all entities on the wall of a circular cylinder between two points of its axis, for bores.
struct CylinderSelection {
  Eigen::Vector3d from, to;
  double radius = 0.0;
};

/// Group defined in part.yaml: union of the selections of its keys.
struct GroupDefinition {
  std::string name;
  Dimension of = Dimension::face;
  std::vector<long> numbers;        ///< entities of a geometry or nodes of a mesh file
  std::vector<std::string> groups;  ///< other groups, physical groups, sets, labels
  std::optional<BoxSelection> box;
  std::optional<CylinderSelection> cylinder;
  std::optional<Eigen::Vector3d> near;  ///< position whose nearest entity is selected
  std::optional<double> tolerance;      ///< for box, cylinder, near; absent: see PART.md
  std::string where;
};

}  // namespace tisserand::formats
