// What a deck of another program gives: the mesh and the names by which part.yaml can refer to its nodes and elements.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// What to do with cards that the reader does not understand: an error with their names and counts, or a warning.
enum class UnknownCards { refuse, ignore };

struct DeckOptions {
  UnknownCards unknown = UnknownCards::refuse;
  bool boundary = true;  ///< false: the part names its boundary, and ASET and its like are not read
};

/// The elements of a named set: rows of Mesh::beams, ::shells, ::solids and ::springs.
struct ElementSet {
  std::vector<int> beams, shells, solids, springs;
};

struct Deck {
  Mesh mesh;  ///< with all nodes, also those that nothing of the deck uses; boundary: ASET, BSET or nothing
  std::map<long, int> node_of_id;                     ///< grid or node number -> column of Mesh::position
  std::map<std::string, std::vector<int>> node_sets;  ///< names in lower case
  std::map<std::string, ElementSet> element_sets;
};

/// Nastran bulk data in small, large and free field, with INCLUDE. Throws all Errors of the file together.
Deck read_nastran(const std::string& path, const DeckOptions& options);

/// Abaqus and CalculiX input, with *INCLUDE. Throws all Errors of the file together.
Deck read_abaqus(const std::string& path, const DeckOptions& options);

}  // namespace tisserand::reducer
