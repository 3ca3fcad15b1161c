// SPDX-License-Identifier: GPL-3.0-or-later
// A superelement with its companion, computed by the definitions of COMPANION.md from a network of springs.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "tests/support/bodies/second_order_arrays.hpp"

namespace tisserand::test_support {

/// Point masses and springs as of spring_network(): nodes with translations alone, every pair joined by a spring, whose
/// geometric stiffness under the force F is (F/l)(1 − e eᵀ). `weights`: of the boundary nodes, sum 1. A load case
/// "push" has the full vector 0.1, 0.2, ... and its second order.
SecondOrderBody second_order_network(const FullModel& model, const std::vector<Keep>& keep, int modes,
                                     const Eigen::VectorXd& weights);

/// The network of the tests: four corners kept, of the twelve internal modes the first `modes`.
SecondOrderBody second_order_network(int modes, const Eigen::Vector4d& weights);

/// Adds a load case from its forces on all coordinates of the network of the tests.
void add_load_case(const std::string& name, const Eigen::VectorXd& load, SecondOrderBody& body);

/// Adds a row Λ = S̄²/|S̄|, which rigid motions do not stretch.
void add_trapped_stress(SecondOrderBody& body);

/// spring_network() seen in the mirror diag(axes).
FullModel mirrored_network(const Eigen::Vector3d& axes);

}  // namespace tisserand::test_support
