// The state of a scene before anything is projected, and the constants of a model that are values at the start.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Poses and velocities as the scene gives them. Sets in the model what is measured there: angles and lengths at the
/// start, scales of mass and stiffness.
State initial_state(const Construction& c, Model& model);

}  // namespace tisserand::mechanism
