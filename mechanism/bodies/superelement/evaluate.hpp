// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation of a superelement body: motion, residual, energy, coordinates of its file. Its tangents are in
// tangent.hpp.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/constants/body.hpp"
#include "mechanism/bodies/superelement/tangent/tangent.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Computes work.A_BB = c_m M_BB + c_k S_BB turned with the frame, after update_kinematics(). This is a symmetric
/// weight of boundary motions with internal coordinates held, in which rigid motions have their mass alone.
void boundary_weight(const SuperelementBody& body, const TangentCoefficients& coefficients,
                     const SuperelementScratch& scratch, SuperelementWork& work);

/// Computes frame, y, ẏ, ÿ of the body. R0_reference: karcher and polar start from it (the latest R₀), the incremental
/// frame uses it as R_ref (R₀ at the end of the latest accepted step), pair and single_node ignore it. y, yd, ydd: m
/// canonical internal coordinates and rates. scratch.motion.frame_error shows whether an iterated frame converged
/// (normally ≤ 1e-14 rad).
void update_kinematics(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const double* y,
                       const double* yd, const double* ydd, const Eigen::Matrix3d& R0_reference,
                       SuperelementScratch& scratch);

/// Computes scratch.forces.r_B, r_I: G_iner + G_int + G_damp − gravity, after update_kinematics(). r_B is the force
/// that the rest of the mechanism exerts on the boundary nodes. gravity: acceleration in world axes.
void residual(const SuperelementBody& body, SuperelementScratch& scratch, const Eigen::Vector3d& gravity);

/// Generalised force of a load case with the factor 1 on the nodes and on the internal coordinates, after residual().
void load_case_direction(const SuperelementBody& body, int load_case, const SuperelementScratch& scratch,
                         Eigen::VectorXd& boundary, Eigen::VectorXd& internal);

struct SuperelementEnergy {
  double kinetic = 0.0;            ///< ½ ẏᵀ M̄ ẏ
  double strain = 0.0;             ///< ½ yᵀ S̄ y
  double gravity_potential = 0.0;  ///< −m g · x_cm
};

/// Deformation of a body at the start of a step, from which the mean damping power of the step is computed.
struct StepDeformation {
  Eigen::VectorXd y_B, y_I;
  Eigen::VectorXd linear, quadratic;  ///< rows: l_a·y and g_a of the generalised strains; empty without stiffening
  Eigen::VectorXd rate_B, rate_I;     ///< buffers: Δy/step
};

/// Dissipated power ẏᵀ D ẏ ≥ 0 at the rates of the nodes. Needs residual().
double damping_power(const SuperelementBody& body, const SuperelementScratch& scratch);

/// Damping power at the mean rates of a step, Δy/step. Needs residual().
double mean_damping_power(const SuperelementBody& body, const SuperelementScratch& scratch, double step,
                          StepDeformation& before);

/// Stores the deformation at the end of a step. Needs residual().
void keep_deformation(const SuperelementBody& body, const SuperelementScratch& scratch, StepDeformation& kept);

/// Energies of the body. Needs residual().
SuperelementEnergy energy(const SuperelementBody& body, const SuperelementScratch& scratch,
                          const Eigen::Vector3d& gravity);

/// Writes y in the coordinates and row order of the file (lengths in units of the scene). out: boundary_size + internal
/// coordinates of the file. Needs update_kinematics().
void file_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                      Eigen::Ref<Eigen::VectorXd> out);

/// Writes y + L⁺ g in the same coordinates and order, with g the second-order part of the generalised strains L y + g.
/// Their linear strain is that of the body, so that stress follows from them (formats/RESULTS.md,
/// /superelements/y_strain). Without stiffening the result is y. Needs residual().
void strain_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                        Eigen::Ref<Eigen::VectorXd> out);

/// Acceleration of the origin of the floating frame less gravity (world axes), and angular velocity and acceleration of
/// the frame, in axes of the part.
struct FrameAcceleration {
  Eigen::Vector3d felt, angular_velocity, angular_acceleration;
};
/// Computes the frame acceleration after update_kinematics() with the same nodes.
FrameAcceleration frame_acceleration_of(const SuperelementBody& body, SuperelementScratch& scratch,
                                        const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity);

/// Writes the rates of file_coordinates(). Needs update_kinematics() with the same nodes.
void file_rates(const SuperelementBody& body, SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                Eigen::Ref<Eigen::VectorXd> out);

/// Row i of the boundary coordinates of the file, from boundary coordinates or their rates.
inline double boundary_of_file(const SuperelementBody& body, const Eigen::VectorXd& y_B, std::size_t i) {
  const auto row = static_cast<Eigen::Index>(i);
  return body.planar ? body.file.lift.row(row).dot(y_B) : y_B[row];
}

/// Number of coordinates of the file, the size of `out` above.
Eigen::Index file_coordinate_count(const SuperelementBody& body);

}  // namespace tisserand::mechanism
