// Checks of the mesh before anything is assembled: shapes of elements, and springs too stiff for round-off.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Asks every element for faults of its shape. Throws one Error with the first ten and their number; returns warnings.
std::vector<std::string> check_shapes(const Mesh& mesh, const std::string& where);

/// Elements whose shape check_shapes() refuses: beams, then shells, then solids are counted.
std::vector<int> faulty_elements(const Mesh& mesh);

/// Springs 1e8 times as stiff as the stiffest of up to a thousand elements of each kind: the part is lost in their
/// digits.
std::vector<std::string> stiff_spring_doubts(const Mesh& mesh);

}  // namespace tisserand::reducer
