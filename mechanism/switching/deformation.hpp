// Deformation of a superelement seen from its floating frame, and the nodes that show it: what a switch keeps while it
// moves bodies onto their joints.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Boundary, then internal coordinates; axes of the frame.
struct Deformation {
  Eigen::VectorXd y;
  Eigen::VectorXd rate;  ///< [1/time]
};

/// The floating frame in motion, world axes but for Omega.
struct FrameMotion {
  Eigen::Vector3d x, xd;
  Eigen::Matrix3d R;
  Eigen::Vector3d Omega;  ///< in axes of the frame
};

/// Of a superelement where it was evaluated: ẏ = Υ q̇.
Deformation deformation_of(const Model& model, std::size_t superelement, const Evaluation& now);
FrameMotion frame_motion_of(const Model& model, std::size_t superelement, const Evaluation& now);

/// How the frame moves, and with which rates, where a body that is undeformed takes the deformation while its rigid
/// motion in the sense of `deformation` (of the mass, say) stays: (d, θ) of the deformation in the weights of the
/// frame, carried out as a finite motion. What is left of the deformation has none and is seen from the frame as it is;
/// displacements with a part that turns would stretch the body by half the square of the angle.
FrameMotion move_frame(const Model& model, std::size_t superelement, const Evaluation& undeformed,
                       Deformation& deformation);

/// Sets nodes and internal coordinates.
void place_deformed(const Model& model, std::size_t superelement, const Deformation& deformation,
                    const FrameMotion& frame, State& state);

}  // namespace tisserand::mechanism
