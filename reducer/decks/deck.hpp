// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of a deck of another program: the mesh, and the names of its nodes and elements for part.yaml.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Treatment of cards that the reader does not support: refused by an Error with their names and counts, or ignored
/// with a warning.
enum class UnknownCards { refuse, ignore };

/// Options for reading a deck.
struct DeckOptions {
  UnknownCards unknown = UnknownCards::refuse;
  bool boundary = true;  ///< false: ASET and similar cards are not read, because the part file names the boundary
};

/// Elements of a named set, as indices in Mesh::beams, ::shells, ::solids and ::springs.
struct ElementSet {
  std::vector<int> beams, shells, solids, springs;
};

/// Mesh of a deck, with the names and numbers of its nodes and elements.
struct Deck {
  /// Mesh with all nodes, also unused ones; its boundary is that of ASET and BSET, or empty.
  Mesh mesh;
  std::map<long, int> node_of_id;  ///< key: number of the grid point or node, value: column of Mesh::position
  std::map<std::string, std::vector<int>> node_sets;  ///< nodes of each set; names in lower case
  std::map<std::string, ElementSet> element_sets;
};

/// Reads Nastran bulk data in small, large and free field, with INCLUDE. Throws one Error with all faults of the deck.
Deck read_nastran(const std::string& path, const DeckOptions& options);

/// Reads Abaqus and CalculiX input, with *INCLUDE. Throws one Error with all faults of the deck.
Deck read_abaqus(const std::string& path, const DeckOptions& options);

}  // namespace tisserand::reducer
