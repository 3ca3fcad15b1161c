// SPDX-License-Identifier: GPL-3.0-or-later
// Cells: output of meshers, before anything has a section or a material. part.yaml refers to cells by entities (edges,
// faces, volumes) and groups of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/place.hpp"

namespace tisserand::reducer {

/// Largest number of elements. A larger mesh is refused before it is made: its reduction would exceed the memory.
inline constexpr double most_elements = 1e7;

/// Node order as gmsh's elements of these types (its documentation, "Node ordering").
enum class CellShape : std::uint8_t {
  line2,
  line3,
  triangle3,
  triangle6,
  quadrilateral4,
  quadrilateral8,
  tetrahedron4,
  tetrahedron10,
  hexahedron8,
  hexahedron20,
  prism6,
  prism15
};

struct CellForm {
  int gmsh_type;
  int dimension;
  int nodes;
  int corners;
};
CellForm form_of(CellShape shape);
/// Shape of a gmsh element type; empty for types without a cell.
std::optional<CellShape> cell_shape(int gmsh_type);

struct Cell {
  CellShape shape = CellShape::line2;
  long id = 0;  ///< number in the file or in its entity
  std::array<int, 20> nodes{};
};
std::span<const int> nodes_of(const Cell& cell);
std::span<const int> corners_of(const Cell& cell);

/// Mean of the corners of a cell.
Eigen::Vector3d middle_of(const Cell& cell, const std::vector<Eigen::Vector3d>& position);

/// Key of a face: its corners ascending, −1 before those of a triangle.
using FaceKey = std::array<int, 4>;
FaceKey face_key(std::span<const int> corners);

/// Edge, face or volume with its cells: CellMesh::cells[dimension][first .. first + count).
struct Entity {
  int dimension = 0;
  int number = 0;     ///< number in the geometry or mesh file; 0: drawn by the part file
  std::string label;  ///< label in the CAD file; in the part file: name of the patch or its edge
  std::size_t first = 0;
  std::size_t count = 0;
};

/// A named group of entities of one dimension: a physical group, a set.
struct EntityGroup {
  std::string name;
  int dimension = 0;
  std::vector<int> entities;  ///< indices in CellMesh::entities
};

/// Data of the geometry kernel about an edge or face in addition to its mesh.
struct EntityGeometry {
  double size = 0.0;  ///< length or area; 0: unknown to the kernel
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> point;   ///< for a face, on its surface, also beyond its edges
  std::vector<Eigen::Vector3d> normal;  ///< at these points, of length 1
  std::vector<int> volumes;             ///< numbers of the volumes that the face bounds
};

struct CellMesh {
  std::vector<Eigen::Vector3d> position;
  std::vector<long> node_id;               ///< number of each node in the file
  std::array<std::vector<Cell>, 4> cells;  ///< index: dimension
  std::vector<Entity> entities;
  std::vector<EntityGroup> groups;
  std::vector<EntityGeometry> geometry;  ///< per entity; empty: not requested, or no geometry
  std::vector<std::string> warnings;
};

/// Name of an entity: "face 12", "face 12 ('top')", or the label of what the part file draws.
std::string name_of(const Entity& entity);
const char* dimension_word(int dimension);

/// Length, area or volume of a cell, and the share of each node in it: that of the sub-cells at the node, so all shares
/// are positive. A linear field's mean over the cell is its weighted mean over the nodes for simplices and
/// parallelograms with straight edges.
struct NodeShares {
  double size = 0.0;
  std::array<double, 20> share{};  ///< sum 1
};
NodeShares node_shares(const Cell& cell, const std::vector<Eigen::Vector3d>& position);

}  // namespace tisserand::reducer
