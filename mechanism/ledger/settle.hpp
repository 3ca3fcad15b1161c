// Where a body of another stiffness would stand in the same motion.
#pragma once

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Positions at which the model bears the accelerations and velocities of the state: r(q, v, v̇, λ) = 0, Φ = 0 by Newton
/// with ∂r/∂q + M/T², `period` T: what vibrates faster than T takes its quasi-static deformation, slower motion stays.
/// A state of a model with stiffening, whose nodes come nearer as a body bends, would otherwise compress a linear one.
/// The state as it was, where that does not converge.
State settled(const Model& model, const State& state, double period);

}  // namespace tisserand::mechanism
