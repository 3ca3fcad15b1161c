// Springs between nodes without rotations: what turns their axes with the part.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Ties the rotations of nodes that have none of their own (nodes of solids, references of averages of translations,
/// nodes that follow a rigid spider with their translations) to the motion of what they belong to, if a spring there
/// has axes that matter: unequal stiffnesses between coincident nodes, or across the line between distant ones. At
/// first order nothing changes, since such a spring resists no rotation; at second order its axes turn with the part.
void turn_springs(Mesh& mesh);

/// Names of springs whose axes matter, and stay as they are when the part turns, because nothing defines a rotation of
/// their nodes.
std::vector<std::string> springs_that_do_not_turn(const Mesh& mesh);

}  // namespace tisserand::reducer
