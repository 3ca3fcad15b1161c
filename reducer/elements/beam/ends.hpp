// How a beam is tied to its nodes: released end forces and rigid arms.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "reducer/elements/beam/general.hpp"

namespace tisserand::reducer {

/// Condenses the released coordinates (bit k: the k-th end force is zero): u_r = −S_rr⁺ S_rk u_k exactly, and the mass
/// by the same transformation. Their rows and columns become zero. Returns the number of motions of released
/// coordinates that nothing resists (S_rr singular: both ends of an axial or torsional coordinate, ...): such a release
/// is an error; the matrices are then those of the pseudoinverse.
int release_ends(std::uint16_t released, BeamMatrices& matrices);

/// The motion of the ends, released coordinates included, from that of what they hold on to: T of release_ends().
struct Released {
  Matrix12 T = Matrix12::Identity();
  int loose = 0;
};
Released release(std::uint16_t released, const Matrix12& stiffness);

/// From the ends of the beam to its nodes: u_end = u_node + θ × arm, with arms from node to end in the axes of the
/// matrices.
void move_to_nodes(const Eigen::Vector3d& first_arm, const Eigen::Vector3d& second_arm, Matrix12& matrix);

}  // namespace tisserand::reducer
