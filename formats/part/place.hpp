// SPDX-License-Identifier: GPL-3.0-or-later
// Attachment of items of part.yaml: places that become one node, and groups of faces, edges, volumes and nodes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

/// Ways to define a place. name: point, or spider (its reference node). position: new node at coordinates. node: number
/// of a node of the mesh file. near: the node of the mesh file nearest to a position. centroid: new node at the
/// centroid of a group, weighted by area, length or volume.
enum class PlaceKind { name, position, node, near, centroid };

/// Place that becomes one node of the model.
struct Place {
  Place() = default;
  Place(const char* point) : name(point) {}
  Place(std::string point) : name(std::move(point)) {}

  PlaceKind kind = PlaceKind::name;
  std::string name;  ///< point or spider; for a centroid: group (empty: group of the spider)
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< for kinds position and near
  long node = 0;
  std::optional<double> tolerance;  ///< near: largest distance; absent: see PART.md
};

/// Kinds of entities that a group consists of. Each value is the entity's dimension.
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

/// Group defined in part.yaml: the union of its selections `numbers`, `groups`, `box`, `cylinder` and `near`.
struct GroupDefinition {
  std::string name;
  Dimension of = Dimension::face;
  std::vector<long> numbers;        ///< numbers of entities of a geometry, or of nodes of a mesh file
  std::vector<std::string> groups;  ///< names of other groups, physical groups, sets or labels
  std::optional<BoxSelection> box;
  std::optional<CylinderSelection> cylinder;
  std::optional<Eigen::Vector3d> near;  ///< position whose nearest entity is selected
  std::optional<double> tolerance;      ///< for box, cylinder, near; absent: see PART.md
  std::string where;
};

}  // namespace tisserand::formats
