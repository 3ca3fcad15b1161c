// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a scene before projection, and the constants of a model that are measured at the start.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// State with the poses and velocities of the scene. Sets in `model` the constants that are measured at this state:
/// angles and lengths at the start, scales of mass and stiffness.
State initial_state(const Construction& c, Model& model);

}  // namespace tisserand::mechanism
