// The state of one model as a state of another model of the same scene, in which a body is flexible or rigid.
#pragma once

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Whether a state of one model is a state of the other as it stands: same nodes, coordinates and constraints.
bool share_states(const Model& a, const Model& b);

/// Places keep their motion, bodies that are flexible in both their deformation. A body that becomes rigid takes the
/// pose of its floating frame and the linear and angular momentum that its mass matrix has in axes of the frame; one
/// that becomes flexible begins undeformed. Accelerations and multipliers are zero: a start solves for them, and puts
/// positions and velocities onto the constraints (mechanism/analyses/start.hpp).
State transfer(const Model& from, const State& state, const Model& to);

}  // namespace tisserand::mechanism
