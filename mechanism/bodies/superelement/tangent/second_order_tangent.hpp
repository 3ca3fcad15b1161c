// SPDX-License-Identifier: GPL-3.0-or-later
// Step tangents of superelement bodies with stiffening or full inertia, in the coordinates (x₀, Θ₀, y) and in those of
// the nodes.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/work.hpp"
#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {

/// Allocates the work matrices of bodies with second-order terms.
SecondOrderWork make_second_order_work(const SuperelementBody& body);

/// Whether y_I is eliminated from the boundary part of a tangent. Elimination factors A_II.
enum class InternalCoordinates { kept, eliminated };

/// Computes the step tangent of inertia option F in work.A_BB, and the blocks that condense() and expand() need. It is
/// c_m Zᵀ M_η Z + c_k (Υᵀ K_y Υ + K_f) + c_c Υᵀ D Υ with Z = [A₀; U; Υ], THEORY (54). M_η is the second derivative of
/// the kinetic energy by (η, ẏ). Mass and stiffness are exact. Derivatives of inertia by velocities, and of inertia and
/// weight by positions, are omitted.
void full_inertia_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients,
                          InternalCoordinates internal, SuperelementScratch& scratch, SuperelementWork& work);

/// Adds the stiffness of stiffening, c_k (Υᵀ (K_y − S̄) Υ + K_f) of THEORY (54), to the tangent of the linear body: to
/// work.A_BB, A_BI and A_IB.
void add_stiffening_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients,
                            InternalCoordinates internal, SuperelementScratch& scratch, SuperelementWork& work);

/// Work matrices of add_frame_stiffness() (3 x nb each).
struct FrameStiffnessWork {
  Eigen::Matrix<double, 3, Eigen::Dynamic>& dm;
  Eigen::Matrix<double, 3, Eigen::Dynamic>& dc;
};

/// Whether a rotation of the node turns the floating frame.
inline bool turns_frame(const SuperelementBody& body, const SuperelementNode& node) {
  return body.frame != FrameAlgorithm::polar && node.alpha_rotation != 0.0;
}
/// Derivative of the rotation of the floating frame by that of the node: U (3 x 3), in the plane α (1 x 1).
template <int D>
auto frame_turn(const SuperelementNode& node, const LocalNode<double>& local) {
  if constexpr (D == 3)
    return Eigen::Matrix3d(local.U);
  else
    return TurnOf<2>(node.alpha_rotation);
}

/// Adds factor · K_f to A, the geometric stiffness of the frame that turns under the elastic forces f on y_B,
/// THEORY (21), (22). K_f δq = (δΥᵀ) f, at the state in `frozen`. It is for frames from rotations, not for
/// FrameAlgorithm::polar. With material increments K_f is not symmetric.
template <int D>
void add_frame_stiffness(const SuperelementBody& body, const SuperelementTangent& frozen, const Eigen::VectorXd& f,
                         double factor, FrameStiffnessWork work, Eigen::MatrixXd& A);

// Planar bodies (planar_tangent.cpp) have the same terms. They have so few coordinates that products with vectors and a
// dense coupling to internal coordinates are fastest.

/// Computes work.A_BB with y_I kept, and A_BI, A_IB of scratch.tangent, of a planar body for work.coefficients. The
/// state is stored in scratch.tangent. Terms of inertia option M are included. Stiffness and damping are those of
/// tangent(): work.K if the damping matrix is full.
void planar_tangent(const SuperelementBody& body, SuperelementScratch& scratch, SuperelementWork& work);

}  // namespace tisserand::mechanism
