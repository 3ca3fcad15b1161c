// The functions through which the mechanism evaluates a superelement body: residual, tangent, elimination of y_I,
// energy.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/body.hpp"
#include "mechanism/bodies/superelement/internal_factor.hpp"
#include "mechanism/bodies/superelement/residual.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Matrices in the coordinates (x₀, Θ₀, y_B, y_I), of which N = nb + m are y; sized where the body has second-order
/// terms.
struct SecondOrderWork {
  Eigen::MatrixXd K;         ///< (6 + N)², lower triangle
  Eigen::MatrixXd bent;      ///< rows x N: L + h
  Eigen::MatrixXd X;         ///< N x 6
  Eigen::MatrixXd D;         ///< 6 x N: J₀⁻¹ `momentum`
  Eigen::MatrixXd momentum;  ///< 6 x N: ∂n₂/∂ẏ, yᵀ N_a and of rotations yᵀ W_jᵀ too
  Eigen::MatrixXd K_bb;      ///< (6 + nb)²: boundary part, internal coordinates eliminated
  Eigen::MatrixXd K_Ib;      ///< m x (6 + nb)
  Eigen::MatrixXd half;      ///< (6 + nb) x nb: K_bb Z
  Eigen::MatrixXd turned;    ///< nb x (6 + nb)
  Eigen::MatrixXd pulled;    ///< nb x nb: Zᵀ K_bb Z
  Eigen::MatrixXd A_IB;      ///< m x nb
  Eigen::MatrixXd thin_boundary, thin_nodes, thin_internal;  ///< (6 + nb) x 6, nb x 6, m x 6
  Eigen::Matrix<double, 3, Eigen::Dynamic> dm, dc;           ///< 3 x nb
};

/// Transposed rows of the centre of mass (center_tangent.hpp), nb x 3 each.
struct CenterWork {
  Eigen::Matrix<double, Eigen::Dynamic, 3> w;  ///< W Γᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> g;  ///< (Γ P)ᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> z;  ///< (Γ (Z − c_m P))ᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> J;
  Eigen::Matrix<double, Eigen::Dynamic, 3> F;  ///< (c_m J + c_c A_v)ᵀ
};

/// Constants of the elimination of y_I for the latest coefficients, and matrices to work in: one for all uses of a
/// body, so that they stay in the caches.
struct SuperelementWork {
  TangentCoefficients coefficients;  ///< for which D, Q, N hold
  bool constants_valid = false;
  InternalFactor internal;     ///< A_II: the diagonal D = c_m + c_c D_II + c_k S_II, or with a full matrix of damping
  Eigen::MatrixXd Q;           ///< nb x nb: M_BI D⁻¹ M_IB
  Eigen::MatrixXd N;           ///< nb x nb: M_BB − c_m Q
  Eigen::MatrixXd K;           ///< nb x nb: c_k S_BB + c_c D_BB, only where the damping has a full matrix
  Eigen::MatrixXd A_II;        ///< m x m: the same
  Eigen::MatrixXd eliminated;  ///< m x nb: A_II⁻¹ A_IB, only where the coupling is stored

  Eigen::MatrixXd A_BB;           ///< nb x nb, y_I eliminated: result of tangent()
  Eigen::VectorXd r_B_condensed;  ///< r_B − A_BI A_II⁻¹ r_I: result of condense()

  /// Scratch of the step tangent, nb x nb and nb x 3. The names are those of its formula (condensed_tangent in
  /// tangent.cpp).
  Eigen::MatrixXd Np, G1, G2;
  Eigen::Matrix<double, Eigen::Dynamic, 3> J, F, V1;
  CenterWork center;                ///< of inertia option M
  Eigen::MatrixXd planar_columns;   ///< nb x 16, of planar bodies
  Eigen::VectorXd column, turned;   ///< nb: of M_BI or Γᵀ, before and after a product
  Eigen::VectorXd internal_column;  ///< m

  SecondOrderWork second;
};

/// The state at which the latest tangent of one use was formed: what condense() and expand() need.
struct SuperelementTangent {
  TangentCoefficients coefficients;
  InternalFactor internal;  ///< of A_II
  Eigen::Matrix3d R0;
  Eigen::Vector3d Omega0;
  std::vector<LocalNode<double>> node;
  Eigen::Matrix<double, 3, Eigen::Dynamic> U;  ///< 3 x nb, U P⁻¹: columns in axes of the frame; not of planar bodies

  bool dense_coupling =
      false;  ///< A_BI and A_IB are stored (exact tangent, inertia M, full damping) instead of W M_BI and M_IB Z
  Eigen::MatrixXd A_BI;  ///< nb x m
  Eigen::MatrixXd A_IB;  ///< m x nb
};

/// Scratch of one use, sized once.
struct SuperelementScratch {
  LocalMotion<double> motion;         ///< current x₀, R₀, Ω₀, y (update_kinematics)
  Eigen::Matrix3d R0_reference;       ///< as given to update_kinematics
  SuperelementForces<double> forces;  ///< r_B, r_I (residual)
  SuperelementTangent tangent;
};

SuperelementScratch make_scratch(const SuperelementBody& body);
SuperelementWork make_work(const SuperelementBody& body);

/// work.A_BB = c_m M_BB + c_k S_BB turned with the frame, after update_kinematics(): a symmetric weight of boundary
/// motions with internal coordinates held, in which rigid ones have their mass alone.
void boundary_weight(const SuperelementBody& body, const TangentCoefficients& coefficients,
                     const SuperelementScratch& scratch, SuperelementWork& work);

/// Frame, y, ẏ, ÿ of the body. R0_reference: karcher and polar start from it (the latest R₀), the incremental frame
/// uses it as R_ref (R₀ at the end of the latest accepted step); pair and single_node ignore it. y, yd, ydd: m
/// canonical internal coordinates and rates. scratch.motion.frame_error tells whether an iterated frame converged (≤
/// 1e-14 rad normally).
void update_kinematics(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const double* y,
                       const double* yd, const double* ydd, const Eigen::Matrix3d& R0_reference,
                       SuperelementScratch& scratch);

/// scratch.forces.r_B, r_I: G_iner + G_int + G_damp − gravity, after update_kinematics(). r_B is what the boundary
/// nodes receive from the rest of the mechanism. gravity: acceleration in world axes.
void residual(const SuperelementBody& body, SuperelementScratch& scratch, const Eigen::Vector3d& gravity);

/// Step tangent after residual(): work.A_BB = A_BB − W Q Z with the boundary part of
///   c_m Pᵀ M̄ P + c_c (C₁ + C₂ + C₃ + Υᵀ D Υ) + c_k Υᵀ S̄ Υ          ([Car00] (31), (49)-(51), (61)-(63), corrected)
/// (the derivatives of Υ, of U and of the weight are left out), and what condense() and expand() need. The elimination
/// of y_I is exact: C has no I-I block, so D = A_II is a constant diagonal and Q = M_BI D⁻¹ M_IB is kept while the
/// coefficients stay. Where the damping has a full matrix, D is the constant full matrix A_II, and A_BI = W M_BI + c_c
/// Υᵀ D_BI, A_IB = M_IB Z + c_c D_IB Υ are stored.
void tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
             SuperelementWork& work);

/// The step tangent with the internal coordinates kept: work.A_BB, and A_BI, A_IB of the tangent, whose sizes the
/// caller has set; all linear in the coefficients. A_II is c_m + c_c D_II + c_k S_II, and of bodies with second-order
/// terms the lower triangle of the last m rows of work.second.K. condense() and expand() are not for it.
void kept_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
                  SuperelementWork& work);

/// Like tangent() with the exact combination c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q by dual numbers. Allocates.
void exact_tangent(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                   const TangentCoefficients& coefficients, SuperelementScratch& scratch, SuperelementWork& work);

/// work.r_B_condensed = r_B − A_BI A_II⁻¹ r_I with the blocks of the latest tangent of this use.
void condense(const SuperelementBody& body, const SuperelementScratch& scratch, SuperelementWork& work);

/// dy_I = −A_II⁻¹ (r_I + A_IB dq_B): the internal part of the solution of A d = −r.
void expand(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
            SuperelementWork& work);

/// dy_I = −A_II⁻¹ A_IB dq_B: the same without a residual.
void expand_motion(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
                   SuperelementWork& work);

/// The exact tangent with y_I not eliminated, (nb + m)²; after residual(). Allocates.
void whole_exact_tangent(const SuperelementBody& body, const SuperelementScratch& scratch,
                         const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const TangentCoefficients& coefficients, Eigen::MatrixXd& A);

/// Generalised force of a load case with the factor 1 on the nodes and on the internal coordinates, after residual().
void load_case_direction(const SuperelementBody& body, int load_case, const SuperelementScratch& scratch,
                         Eigen::VectorXd& boundary, Eigen::VectorXd& internal);

struct SuperelementEnergy {
  double kinetic = 0.0;            ///< ½ ẏᵀ M̄ ẏ
  double strain = 0.0;             ///< ½ yᵀ S̄ y
  double gravity_potential = 0.0;  ///< −m g · x_cm
};

/// What a body has at one state, for the mean power of damping over a step that begins there.
struct StepDeformation {
  Eigen::VectorXd y_B, y_I;
  Eigen::VectorXd linear, quadratic;  ///< rows: l_a·y and g_a of the generalised strains; empty without stiffening
  Eigen::VectorXd rate_B, rate_I;     ///< buffers: Δy/step
};

/// ẏᵀ D ẏ ≥ 0, dissipated, at the rates of the nodes. After residual().
double damping_power(const SuperelementBody& body, const SuperelementScratch& scratch);

/// The same at the mean rates of a step, Δy/step. After residual().
double mean_damping_power(const SuperelementBody& body, const SuperelementScratch& scratch, double step,
                          StepDeformation& before);

/// After residual().
void keep_deformation(const SuperelementBody& body, const SuperelementScratch& scratch, StepDeformation& kept);

/// After residual().
SuperelementEnergy energy(const SuperelementBody& body, const SuperelementScratch& scratch,
                          const Eigen::Vector3d& gravity);

/// y in the coordinates and the order of rows of the file (lengths in units of the scene). out: boundary_size +
/// internal coordinates of the file. After update_kinematics().
void file_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                      Eigen::Ref<Eigen::VectorXd> out);

/// y + L⁺ g in the same coordinates and order, with g the second-order part of the generalised strains L y + g: what
/// has the strain of the body linearly, so that stress follows from it (formats/RESULTS.md, /superelements/y_strain). y
/// itself without stiffening. After residual().
void strain_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                        Eigen::Ref<Eigen::VectorXd> out);

/// Acceleration of the origin of the floating frame less gravity (world axes), its angular velocity and angular
/// acceleration: axes of the part.
struct FrameAcceleration {
  Eigen::Vector3d felt, angular_velocity, angular_acceleration;
};
/// After update_kinematics() with the same nodes.
FrameAcceleration frame_acceleration_of(const SuperelementBody& body, SuperelementScratch& scratch,
                                        const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity);

/// Rates of file_coordinates(). After update_kinematics() with the same nodes.
void file_rates(const SuperelementBody& body, SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                Eigen::Ref<Eigen::VectorXd> out);

/// Row i of the boundary coordinates of the file, for boundary coordinates or their rates.
inline double boundary_of_file(const SuperelementBody& body, const Eigen::VectorXd& y_B, std::size_t i) {
  const auto row = static_cast<Eigen::Index>(i);
  return body.planar ? body.file.lift.row(row).dot(y_B) : y_B[row];
}

/// Number of coordinates of the file, the size of `out` above.
Eigen::Index file_coordinate_count(const SuperelementBody& body);

}  // namespace tisserand::mechanism
