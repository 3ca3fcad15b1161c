// Where things of part.yaml are attached: places that become one node, and groups of faces, edges, volumes and nodes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

/// name: a point, or a spider (its reference node). position: coordinates, a node of its own. node: a number of the
/// mesh file. near: the node of the mesh file nearest to a position. centroid: of a group (area, length or volume), a
/// node of its own.
enum class PlaceKind { name, position, node, near, centroid };

/// A place that becomes one node.
struct Place {
  Place() = default;
  Place(const char* point) : name(point) {}
  Place(std::string point) : name(std::move(point)) {}

  PlaceKind kind = PlaceKind::name;
  std::string name;  ///< point or spider; centroid: group, empty: what the spider is on
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position, near
  long node = 0;
  std::optional<double> tolerance;  ///< near: largest distance; absent: see PART.md
};

/// What a group consists of; the numbers are the dimensions.
enum class Dimension { node = 0, edge = 1, face = 2, volume = 3 };

/// All faces (edges, volumes, nodes) that lie whole inside a box with sides along the axes.
struct BoxSelection {
  Eigen::Vector3d low, high;
};

/// Those on the wall of a circular cylinder between two points of its axis: bores.
struct CylinderSelection {
  Eigen::Vector3d from, to;
  double radius = 0.0;
};

/// A group that part.yaml defines: the union of what its keys select.
struct GroupDefinition {
  std::string name;
  Dimension of = Dimension::face;
  std::vector<long> numbers;        ///< of entities of a geometry or nodes of a mesh file
  std::vector<std::string> groups;  ///< other groups, physical groups, sets, labels
  std::optional<BoxSelection> box;
  std::optional<CylinderSelection> cylinder;
  std::optional<Eigen::Vector3d> near;  ///< the one that is nearest
  std::optional<double> tolerance;      ///< of box, cylinder, near; absent: see PART.md
  std::string where;
};

}  // namespace tisserand::formats
