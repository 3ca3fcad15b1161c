// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix text of Abaqus and, if it is the same, of CalculiX: linear user elements, and node-component lists.
#pragma once

#include <string>

#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

struct AbaqusSource {
  std::string path;  ///< file of both matrices, or of the stiffness
  std::string mass;  ///< may be empty if `path` contains both
};

/// Reads either *USER ELEMENT, LINEAR with *MATRIX, TYPE=STIFFNESS and TYPE=MASS (*SUBSTRUCTURE MATRIX OUTPUT, OUTPUT
/// FILE=USER DEFINED; node numbers from the comment ** ELEMENT NODES or from *ELEMENT), or lines "node, component,
/// node, component, value" (*MATRIX OUTPUT, FORMAT=MATRIX INPUT). Components 1 to 6. Places are empty, except for *NODE
/// in the same deck. Throws Error.
ReducedMatrices read_abaqus_matrices(const AbaqusSource& source, const std::set<long>& modal);

}  // namespace tisserand::reducer::exchange
