// SPDX-License-Identifier: GPL-3.0-or-later
// Springs between nodes without rotations: definition of rotations that turn their axes with the part.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Ties the rotations of nodes without rotations to the motion around them, if a spring there has axes that matter. The
/// nodes are those of solids, references of averages of translations, and followers of a rigid spider in translations.
/// The springs have unequal stiffnesses between coincident nodes, or across the line between distant ones. First order
/// does not change; at second order their axes turn with the part.
void turn_springs(Mesh& mesh);

/// Names of springs whose axes matter but do not turn with the part, because nothing defines a rotation of their nodes.
std::vector<std::string> springs_that_do_not_turn(const Mesh& mesh);

}  // namespace tisserand::reducer
