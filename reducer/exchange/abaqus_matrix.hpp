// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix text of Abaqus and, if it is the same, of CalculiX: linear user elements, and node-component lists.
#pragma once

#include <string>

#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// Files from which reduced matrices of Abaqus are read.
struct AbaqusSource {
  std::string path;  ///< file of both matrices, or of the stiffness only
  std::string mass;  ///< file of the mass matrix; empty if `path` has both
};

/// Reads the reduced matrices of Abaqus in one of two forms. The first is *USER ELEMENT, LINEAR with *MATRIX,
/// TYPE=STIFFNESS and TYPE=MASS (*SUBSTRUCTURE MATRIX OUTPUT, OUTPUT FILE=USER DEFINED). Its node numbers come from
/// the comment ** ELEMENT NODES or from *ELEMENT. The second has lines "node, component, node, component, value"
/// (*MATRIX OUTPUT, FORMAT=MATRIX INPUT) with components 1 to 6. `modal`: nodes whose rows are internal coordinates.
/// The result has places of nodes only if the deck has *NODE. Throws Error.
ReducedMatrices read_abaqus_matrices(const AbaqusSource& source, const std::set<long>& modal);

}  // namespace tisserand::reducer::exchange
