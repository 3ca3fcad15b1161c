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

/// Largest number of elements. A larger mesh is refused before it is made, because its reduction would exceed the
/// memory.
inline constexpr double most_elements = 1e7;

/// Shapes of cells. The order of the nodes is that of the gmsh elements of these types (gmsh documentation, "Node
/// ordering").
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

/// Element type in gmsh, dimension and numbers of nodes and corners of a cell shape.
struct CellForm {
  int gmsh_type;
  int dimension;
  int nodes;
  int corners;
};
CellForm form_of(CellShape shape);
/// Shape of the cells of a gmsh element type. Returns nothing for types that no cell has.
std::optional<CellShape> cell_shape(int gmsh_type);

/// Cell of a mesh: shape, number and nodes.
struct Cell {
  CellShape shape = CellShape::line2;
  long id = 0;  ///< number of the cell in the file or in its entity
  std::array<int, 20> nodes{};
};
std::span<const int> nodes_of(const Cell& cell);
std::span<const int> corners_of(const Cell& cell);

/// Mean position of the corners of a cell.
Eigen::Vector3d middle_of(const Cell& cell, const std::vector<Eigen::Vector3d>& position);

/// Key of a face, equal for equal sets of corners: the nodes of its corners, ascending. A triangle has −1 before them.
using FaceKey = std::array<int, 4>;
FaceKey face_key(std::span<const int> corners);

/// Edge, face or volume with its cells, which are the `count` cells from `first` on in CellMesh::cells[dimension].
struct Entity {
  int dimension = 0;
  int number = 0;     ///< number of the entity in the geometry or mesh file; 0: drawn by the part file
  std::string label;  ///< label in the CAD file; in the part file: name of the patch or its edge
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Named group of entities of one dimension: a physical group, or a set.
struct EntityGroup {
  std::string name;
  int dimension = 0;
  std::vector<int> entities;  ///< indices in CellMesh::entities
};

/// Geometry of an edge or face by the geometry kernel: size, centre, surface points with normals, and neighbour
/// volumes.
struct EntityGeometry {
  double size = 0.0;  ///< length or area of the entity; 0: unknown to the kernel
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> point;   ///< points on the surface of a face, also beyond its edges; empty for an edge
  std::vector<Eigen::Vector3d> normal;  ///< normals of the surface at `point`, of length 1
  std::vector<int> volumes;             ///< numbers of the volumes that the face bounds
};

/// Mesh as a file or gmsh gives it: nodes, cells, entities and groups, without properties.
struct CellMesh {
  std::vector<Eigen::Vector3d> position;
  std::vector<long> node_id;               ///< number of each node in the file
  std::array<std::vector<Cell>, 4> cells;  ///< cells of each dimension 0 to 3
  std::vector<Entity> entities;
  std::vector<EntityGroup> groups;
  std::vector<EntityGeometry> geometry;  ///< geometry of each entity; empty: not requested, or the file has no geometry
  std::vector<std::string> warnings;
};

/// Name of an entity for messages: "face 12", "face 12 ('top')", or the label of what the part file draws.
std::string name_of(const Entity& entity);
const char* dimension_word(int dimension);

/// Size of a cell (length, area or volume), and the share of each node in it. The cell is cut into sub-cells, and the
/// share of a node is that of the sub-cells at the node, so all shares are positive. For simplices and parallelograms
/// with straight edges, the mean of a linear field over the cell is the sum of its nodal values times the shares.
struct NodeShares {
  double size = 0.0;
  std::array<double, 20> share{};  ///< share of each node; the sum is 1
};
NodeShares node_shares(const Cell& cell, const std::vector<Eigen::Vector3d>& position);

}  // namespace tisserand::reducer
