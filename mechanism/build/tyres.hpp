// Roads and tyres of a scene on nodes that can bear them.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// All roads, then all tyres, whose joints are there. Throws Error (collected in `c`): a node without rotations, an
/// axle that is not that of the wheel's revolute joint, a start deep in the road or without it.
void add_tyres(Construction& c);

}  // namespace tisserand::mechanism
