// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of a deck of another program: the mesh, and the names of its nodes and elements for part.yaml.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Treatment of cards that the reader does not support: an error with their names and counts, or a warning.
enum class UnknownCards { refuse, ignore };

struct DeckOptions {
  UnknownCards unknown = UnknownCards::refuse;
  bool boundary = true;  ///< false: the part names its boundary, and ASET and similar cards are not read
};

/// Elements of a named set: rows of Mesh::beams, ::shells, ::solids and ::springs.
struct ElementSet {
  std::vector<int> beams, shells, solids, springs;
};

struct Deck {
  Mesh mesh;                       ///< with all nodes, also unused ones; boundary: ASET, BSET or empty
  std::map<long, int> node_of_id;  ///< key: grid or node number, value: column of Mesh::position
  std::map<std::string, std::vector<int>> node_sets;  ///< names in lower case
  std::map<std::string, ElementSet> element_sets;
};

/// Nastran bulk data in small, large and free field, with INCLUDE. Throws all Errors of the file together.
Deck read_nastran(const std::string& path, const DeckOptions& options);

/// Abaqus and CalculiX input, with *INCLUDE. Throws all Errors of the file together.
Deck read_abaqus(const std::string& path, const DeckOptions& options);

}  // namespace tisserand::reducer
