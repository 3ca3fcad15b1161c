// SPDX-License-Identifier: GPL-3.0-or-later
// Roads and tyres of a scene on nodes that have the coordinates for them.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Adds all roads of the scene, then all tyres. Requires that the joints of the wheels were added. Errors are collected
/// in `c`: a node without rotations, an axle that is not that of the wheel's revolute joint, a start deep in the road
/// or off the road.
void add_tyres(Construction& c);

}  // namespace tisserand::mechanism
