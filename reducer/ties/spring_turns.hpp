// Springs between nodes without rotations: definition of rotations that turn their axes with the part.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Ties the rotations of nodes without rotations (of solids, references of averages of translations, followers of a
/// rigid spider in translations) to the motion around them if a spring there has axes that matter. These are unequal
/// stiffnesses between coincident nodes, or across the line between distant ones. First order does not change, since
/// such springs resist no rotation. At second order their axes turn with the part.
void turn_springs(Mesh& mesh);

/// Names of springs whose axes matter but do not turn with the part, because nothing defines a rotation of their nodes.
std::vector<std::string> springs_that_do_not_turn(const Mesh& mesh);

}  // namespace tisserand::reducer
