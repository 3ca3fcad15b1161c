// SPDX-License-Identifier: GPL-3.0-or-later
// The falling chain of rigid_chain() by the plain Runge-Kutta method of order 4 on accelerations of the
// articulated-body recursion: what any method with constraints has to compare with where nothing is stiff.
#pragma once

#include <Eigen/Core>

namespace tisserand::benchmarks {

/// Position of the tip of the last of `links` rods at `end`, after that many equal steps.
Eigen::Vector3d runge_kutta_chain(int links, double end, int steps);

}  // namespace tisserand::benchmarks
