// SPDX-License-Identifier: GPL-3.0-or-later
// Connection of a beam to its nodes: released end forces and rigid arms.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "reducer/elements/beam/general.hpp"

namespace tisserand::reducer {

/// Condenses the released coordinates (bit k: the k-th end force is zero): u_r = −S_rr⁺ S_rk u_k exactly, and the mass
/// by the same transformation. Their rows and columns become zero. Returns the number of motions of released
/// coordinates without stiffness (S_rr singular: both ends of an axial or torsional coordinate, ...). Such a release is
/// an error; the matrices are then those of the pseudoinverse.
int release_ends(std::uint16_t released, BeamMatrices& matrices);

/// T of release_ends(): motion of the ends, released coordinates included, from that of the ends of the arms.
struct Released {
  Matrix12 T = Matrix12::Identity();
  int loose = 0;
};
Released release(std::uint16_t released, const Matrix12& stiffness);

/// Transforms a matrix from the ends of the beam to its nodes: u_end = u_node + θ × arm. Arms lead from node to end, in
/// the axes of the matrix.
void move_to_nodes(const Eigen::Vector3d& first_arm, const Eigen::Vector3d& second_arm, Matrix12& matrix);

}  // namespace tisserand::reducer
