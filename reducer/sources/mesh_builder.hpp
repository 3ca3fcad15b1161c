// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh under construction: common data of build_mesh() and its steps.
#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/decks/deck.hpp"
#include "reducer/mesh/cells.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/sources/patches.hpp"

namespace tisserand::reducer {

/// Mesh under construction, which build_mesh() passes through its steps. Nodes are rows of cells.position and label;
/// mesh.position is set at the end.
struct MeshBuilder {
  explicit MeshBuilder(const formats::Part& source) : part(source) {}

  const formats::Part& part;
  Mesh mesh;
  CellMesh cells;                  ///< cells of the patches, then of the mesh file
  std::vector<std::string> label;  ///< label of every node
  MergedNodes patch_nodes{1.0};
  int first_file_node = 0;  ///< the nodes of the mesh file are those from this number up to last_file_node − 1
  int last_file_node = 0;
  bool file_is_deck = false;
  bool describes_faces = false;                       ///< true: fills cells.geometry for a geometry
  bool needs_boundary = true;                         ///< false: the part is only viewed
  std::unordered_map<long, int> node_of_id;           ///< node of each number in the mesh file
  std::map<std::string, std::vector<int>> node_sets;  ///< node sets of a deck, names in lower case
  std::map<std::string, ElementSet> element_sets;
  std::vector<std::string> property_of_entity;  ///< name of the user of each entity, or empty
  std::unordered_map<std::string, int> point_node;
  std::unordered_map<std::string, int> spider_node;
  std::vector<std::vector<int>> beam_nodes;  ///< nodes along each line of part.beams; empty for beams on groups
  std::vector<int> used;                     ///< 1 for nodes that elements use
  std::set<int> merged;                      ///< nodes that others have replaced

  int add_node(const Eigen::Vector3d& x, std::string name);
  const Eigen::Vector3d& position(int node) const { return cells.position[node]; }
};

// Steps in this order:
void add_patches(MeshBuilder& builder);            ///< sources/own_geometry.cpp
void add_points(MeshBuilder& builder);             ///< points of part.yaml at which something ends
void add_mesh_file(MeshBuilder& builder);          ///< sources/file_source.cpp
void add_group_elements(MeshBuilder& builder);     ///< sources/group_elements.cpp: shells, solids, beams on groups
void add_spider_nodes(MeshBuilder& builder);       ///< sources/attachments.cpp
void add_beams(MeshBuilder& builder);              ///< sources/own_geometry.cpp
void add_attachments(MeshBuilder& builder);        ///< springs, masses, spiders, boundary
void add_loads(MeshBuilder& builder);              ///< sources/loads.cpp: supports and load cases
void report_unjoined_beams(MeshBuilder& builder);  ///< sources/unjoined.cpp: warnings
/// Merges nodes of the mesh file at one place that nothing ties to each other if the part file requests it; otherwise
/// warns about them.
void join_coincident_nodes(MeshBuilder& builder);
void report_hanging_nodes(MeshBuilder& builder);  ///< sources/hanging.cpp: a warning
void finish(MeshBuilder& builder);                ///< sets positions and removes unused nodes

/// Marks the nodes of all elements in builder.used.
void mark_used_nodes(MeshBuilder& builder);

/// Section, material and theory of a beam line. The length is not set.
BeamElementData beam_data(const formats::Part& part, const formats::BeamLine& line);

/// Piece of a beam line that becomes one element: its two nodes, and its range on the line.
struct BeamPlace {
  int first_node = 0;
  int second_node = 0;
  double from = 0.0;  ///< share of the length of the line at the first node of the element
  double to = 1.0;
  int number = 1;  ///< number of the element for messages
};
/// Makes the beam element at `place` on `line`, with the angle of the line. It has the offset of an end of the line if
/// it lies at this end. Throws Error if `orientation` is parallel to the element.
BeamElement beam_element(const MeshBuilder& builder, const formats::BeamLine& line, const BeamPlace& place,
                         const Eigen::Vector3d& orientation);

}  // namespace tisserand::reducer
