// SPDX-License-Identifier: GPL-3.0-or-later
// Roads and tyres of a scene on nodes that have the coordinates for them.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Adds all roads, then all tyres; requires their joints. Throws Error (collected in `c`) for a node without rotations,
/// an axle that is not that of the wheel's revolute joint, a start deep in the road or without it.
void add_tyres(Construction& c);

}  // namespace tisserand::mechanism
