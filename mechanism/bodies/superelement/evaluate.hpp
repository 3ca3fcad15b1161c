// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation of a superelement body: motion, residual, energy, coordinates of its file. Its tangents are in
// tangent.hpp.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/constants/body.hpp"
#include "mechanism/bodies/superelement/tangent/tangent.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Computes a symmetric weight of boundary motions with internal coordinates held: work.A_BB = c_m M_BB + c_k S_BB,
/// with translations turned to world axes. A rigid motion has only its mass in it. Requires update_kinematics().
void boundary_weight(const SuperelementBody& body, const TangentCoefficients& coefficients,
                     const SuperelementScratch& scratch, SuperelementWork& work);

/// Computes the floating frame and the local coordinates y, ẏ, ÿ of the body in scratch.motion. `y`, `yd`, `ydd`: m
/// canonical internal coordinates and their rates. `R0_reference`: R₀ of the latest evaluation as start of karcher and
/// polar, R_ref (R₀ of the latest accepted step) for the incremental frame, unused otherwise.
/// scratch.motion.frame_error shows whether an iterated frame converged (normally ≤ 1e-14 rad).
void update_kinematics(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const double* y,
                       const double* yd, const double* ydd, const Eigen::Matrix3d& R0_reference,
                       SuperelementScratch& scratch);

/// Computes the residual scratch.forces.r_B, r_I: G_iner + G_int + G_damp − gravity. r_B is the force that the rest of
/// the mechanism exerts on the boundary nodes. `gravity`: acceleration (world axes). Requires update_kinematics().
void residual(const SuperelementBody& body, SuperelementScratch& scratch, const Eigen::Vector3d& gravity);

/// Computes the generalised force of a load case with the factor 1 on the nodes (`boundary`) and on the internal
/// coordinates (`internal`). Requires residual().
void load_case_direction(const SuperelementBody& body, int load_case, const SuperelementScratch& scratch,
                         Eigen::VectorXd& boundary, Eigen::VectorXd& internal);

/// Kinetic, strain and gravity energy of a superelement.
struct SuperelementEnergy {
  double kinetic = 0.0;            ///< ½ ẏᵀ M̄ ẏ; options M and F: THEORY (34), (48)
  double strain = 0.0;             ///< ½ yᵀ S̄ y; with stiffening V of THEORY (43)
  double gravity_potential = 0.0;  ///< potential of gravity, −m g · x_cm
};

/// Deformation of a body at the start of a step, from which the mean damping power of the step is computed.
struct StepDeformation {
  Eigen::VectorXd y_B, y_I;
  Eigen::VectorXd linear, quadratic;  ///< (rows): l_a·y, g_a of THEORY (44); empty without stiffening
  Eigen::VectorXd rate_B, rate_I;     ///< buffers: Δy/step
};

/// Power that damping dissipates, ẏᵀ D ẏ ≥ 0, at the present rates of the nodes. Requires residual().
double damping_power(const SuperelementBody& body, const SuperelementScratch& scratch);

/// Power that damping dissipates at the mean rates of a step, Δy/step from the deformation `before`. Requires
/// residual().
double mean_damping_power(const SuperelementBody& body, const SuperelementScratch& scratch, double step,
                          StepDeformation& before);

/// Stores the present deformation in `kept`, for the next step. Requires residual().
void keep_deformation(const SuperelementBody& body, const SuperelementScratch& scratch, StepDeformation& kept);

/// Energies of the body at the present state. `gravity`: acceleration (world axes). Requires residual().
SuperelementEnergy energy(const SuperelementBody& body, const SuperelementScratch& scratch,
                          const Eigen::Vector3d& gravity);

/// Writes y in the coordinates and row order of the superelement file, lengths in units of the scene. `out` requires
/// the size file_coordinate_count(). Requires update_kinematics().
void file_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                      Eigen::Ref<Eigen::VectorXd> out);

/// Writes y + L⁺ g in the coordinates and row order of file_coordinates(). g is the second-order part of the
/// generalised strains L y + g. The linear strain of the result is that of the body, so that stress follows from it
/// (formats/RESULTS.md, /superelements/y_strain). Without stiffening the result is y. Requires residual().
void strain_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                        Eigen::Ref<Eigen::VectorXd> out);

/// Acceleration of the floating frame in axes of the part, which move with the frame. `felt` is the acceleration of the
/// origin less gravity.
struct FrameAcceleration {
  Eigen::Vector3d felt, angular_velocity, angular_acceleration;
};
/// Computes acceleration and angular velocity of the floating frame. `gravity`: acceleration (world axes). Requires
/// update_kinematics() with these `nodes`.
FrameAcceleration frame_acceleration_of(const SuperelementBody& body, SuperelementScratch& scratch,
                                        const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity);

/// Writes the rates of the values that file_coordinates() writes. Requires update_kinematics() with these `nodes`.
void file_rates(const SuperelementBody& body, SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                Eigen::Ref<Eigen::VectorXd> out);

/// Boundary coordinate i of the file, from the boundary coordinates `y_B` of the body. With rates in `y_B` it is a
/// rate.
inline double boundary_of_file(const SuperelementBody& body, const Eigen::VectorXd& y_B, std::size_t i) {
  const auto row = static_cast<Eigen::Index>(i);
  return body.planar ? body.file.lift.row(row).dot(y_B) : y_B[row];
}

/// Number of coordinates of the superelement file, boundary and internal: the size that file_coordinates() requires.
Eigen::Index file_coordinate_count(const SuperelementBody& body);

}  // namespace tisserand::mechanism
