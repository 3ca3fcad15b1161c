// SPDX-License-Identifier: GPL-3.0-or-later
// Springs between nodes without rotations: definition of rotations that turn their axes with the part.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Gives rotations to nodes without rotations if a spring there has axes that matter, and ties them to the motion
/// around the node. Such nodes belong to solids, are references of averages of translations, or follow a rigid spider
/// in translations. Such springs have unequal stiffnesses between coincident nodes, or across the line between distant
/// nodes. At first order nothing changes. At second order the axes of the springs turn with the part.
void turn_springs(Mesh& mesh);

/// Names of the springs whose axes matter but do not turn with the part, because nothing defines a rotation of their
/// nodes.
std::vector<std::string> springs_that_do_not_turn(const Mesh& mesh);

}  // namespace tisserand::reducer
