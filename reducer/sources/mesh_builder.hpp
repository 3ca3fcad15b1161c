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

/// State of the mesh. Nodes are rows of cells.position and label; mesh.position is set at the end.
struct MeshBuilder {
  explicit MeshBuilder(const formats::Part& source) : part(source) {}

  const formats::Part& part;
  Mesh mesh;
  CellMesh cells;                  ///< cells of the patches, then of the mesh file
  std::vector<std::string> label;  ///< label of every node
  MergedNodes patch_nodes{1.0};
  int first_file_node = 0;  ///< nodes of the mesh file: [first, last)
  int last_file_node = 0;
  bool file_is_deck = false;
  bool describes_faces = false;                       ///< fills cells.geometry for a geometry
  bool needs_boundary = true;                         ///< false: the part is only viewed
  std::unordered_map<long, int> node_of_id;           ///< in the mesh file
  std::map<std::string, std::vector<int>> node_sets;  ///< sets of a deck, names in lower case
  std::map<std::string, ElementSet> element_sets;
  std::vector<std::string> property_of_entity;  ///< name of the user of each entity, or empty
  std::unordered_map<std::string, int> point_node;
  std::unordered_map<std::string, int> spider_node;
  std::vector<std::vector<int>> beam_nodes;  ///< along each line of part.beams; empty for beams on groups
  std::vector<int> used;                     ///< 1: used by elements
  std::set<int> merged;                      ///< nodes that others have replaced

  int add_node(const Eigen::Vector3d& x, std::string name);
  const Eigen::Vector3d& position(int node) const { return cells.position[node]; }
};

// Steps in this order:
void add_patches(MeshBuilder& builder);          ///< sources/own_geometry.cpp
void add_points(MeshBuilder& builder);           ///< points of part.yaml at which something ends
void add_mesh_file(MeshBuilder& builder);        ///< sources/file_source.cpp
void add_group_elements(MeshBuilder& builder);   ///< sources/group_elements.cpp: shells, solids, beams on groups
void add_spider_nodes(MeshBuilder& builder);     ///< sources/attachments.cpp
void add_beams(MeshBuilder& builder);            ///< sources/own_geometry.cpp
void add_attachments(MeshBuilder& builder);      ///< springs, masses, spiders, boundary
void add_loads(MeshBuilder& builder);            ///< sources/loads.cpp: supports and load cases
void tell_unjoined_beams(MeshBuilder& builder);  ///< sources/unjoined.cpp: warnings
/// Warns of nodes of the mesh file at one place that nothing ties, or merges them.
void join_coincident_nodes(MeshBuilder& builder);
void tell_hanging_nodes(MeshBuilder& builder);   ///< sources/hanging.cpp: a warning
void finish(MeshBuilder& builder);               ///< sets positions and removes unused nodes

/// Marks the nodes of all elements in builder.used.
void mark_used_nodes(MeshBuilder& builder);

/// Section, material and theory of a beam line; the length is not set.
BeamElementData beam_data(const formats::Part& part, const formats::BeamLine& line);

/// Element between two nodes, with the line's offsets at its own ends (`first` and `last`: whether they are the
/// line's), its angle and orientation. Throws Error if the orientation is parallel to it.
struct BeamPlace {
  int first_node = 0;
  int second_node = 0;
  double from = 0.0;  ///< share of the line's length
  double to = 1.0;
  int number = 1;  ///< for messages
};
BeamElement beam_element(const MeshBuilder& builder, const formats::BeamLine& line, const BeamPlace& place,
                         const Eigen::Vector3d& orientation);

}  // namespace tisserand::reducer
