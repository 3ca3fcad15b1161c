// SPDX-License-Identifier: GPL-3.0-or-later
// The iteration matrix of a whole model as a dense matrix, and central differences of its residual to hold it against.
#pragma once

#include <Eigen/Core>

#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

/// Moves positions by up to `turn` and gives random velocities, accelerations and multipliers up to `size`.
void randomise(Simulation& run, unsigned seed, double turn, double size);

/// [A Bᵀ; B 0] at the last evaluate(), A unscaled; of `state` if it was another than that of the run.
Eigen::MatrixXd dense_matrix(Simulation& run, const mechanism::TangentRequest& request);
Eigen::MatrixXd dense_matrix(Simulation& run, const mechanism::State& state, const mechanism::TangentRequest& request);

/// [A ∂r/∂λ; B 0] with A unscaled; mass or stiffness must take part, which it is scaled with.
Eigen::MatrixXd iteration_matrix(Simulation& run, const mechanism::TangentCoefficients& c);

/// ∂r/∂v.
Eigen::MatrixXd damping_matrix(Simulation& run);

enum class Argument { position, velocity, multiplier };

/// ∂r/∂(positions, velocities or multipliers) by central differences with `h`.
Eigen::MatrixXd residual_difference(Simulation& run, Argument argument, double h);

}  // namespace tisserand::test_support
