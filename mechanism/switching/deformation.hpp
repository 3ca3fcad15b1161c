// Deformation of a body seen from its floating frame, and the coordinates that show it: what a switch keeps while it
// moves bodies onto their joints.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Bodies that deform are counted superelements first, then modal bodies.
inline std::size_t deforming_bodies(const Model& model) {
  return model.superelements.size() + model.modal_bodies.size();
}
/// Of such a body; -1: it is a superelement.
inline int modal_body_of(const Model& model, std::size_t index) {
  const std::size_t before = model.superelements.size();
  return index < before ? -1 : static_cast<int>(index - before);
}
const std::string& name_of(const Model& model, std::size_t index);
/// deforming_bodies() if there is none of that name.
std::size_t deforming_body(const Model& model, const std::string& name);
/// Numbers of a deformation.
Eigen::Index deformation_size(const Model& model, std::size_t index);

/// In axes of the frame. Of superelements boundary, then internal coordinates; of modal bodies the motion of the frame
/// [d; θ] that goes with the deformation, then w.
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

/// The y alone.
Eigen::VectorXd y_of(const Model& model, std::size_t index, const Evaluation& now);
/// Of a body where it was evaluated: ẏ = Υ q̇; of modal bodies without motion of the frame.
Deformation deformation_of(const Model& model, std::size_t index, const Evaluation& now);
FrameMotion frame_motion_of(const Model& model, std::size_t index, const Evaluation& now);

/// How the frame moves, and with which rates, where a body that is undeformed takes the deformation while its rigid
/// motion in the sense of `deformation` (of the mass, say) stays: (d, θ) of the deformation, of superelements in the
/// weights of the frame, carried out as a finite motion. What is left of the deformation has none and is seen from the
/// frame as it is; displacements with a part that turns would stretch the body by half the square of the angle.
FrameMotion move_frame(const Model& model, std::size_t index, const Evaluation& undeformed, Deformation& deformation);

/// Whether what no node shows rests: internal coordinates of superelements, if there are any, and modes.
bool rests_inside(const Model& model, std::size_t index, const State& state);
/// Largest speed of a node that has translations.
double largest_speed(const Model& model, const State& state);

/// Sets nodes, internal and modal coordinates; what is left of the motion of a frame in a deformation is not used.
void place_deformed(const Model& model, std::size_t index, const Deformation& deformation, const FrameMotion& frame,
                    State& state);

}  // namespace tisserand::mechanism
