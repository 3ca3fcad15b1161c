// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the centre of mass of a superelement body, and their products in the step tangent of inertia option M.
#include "mechanism/bodies/superelement/tangent/center_tangent.hpp"

#include <cstddef>

#include "mechanism/bodies/superelement/tangent/coupling.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Adds (F U)ᵀ to out.
void add_frame_rotation(const SuperelementBody& body, const LocalMotion<double>& motion, const Matrix3d& F,
                        Columns& out) {
  if (body.frame == FrameAlgorithm::polar) {
    for (const int j : body.translation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      out.middleRows<3>(body.node[i].translation_row) += (F * motion.node[i].U_x).transpose();
    }
  } else {
    for (const int j : body.rotation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      out.middleRows<3>(body.node[i].rotation_row) += (F * motion.node[i].U).transpose();
    }
  }
}

/// Coefficients of δΘ₀: κ in J = Γ_B [R₀ᵀ; T⁻¹]/m + κ U, which is zero without deformation; κ̇; and Γ V.
struct FrameRotation {
  Matrix3d kappa, rate, GV = Matrix3d::Zero();
};

FrameRotation start_of_frame_rotation(const LocalMotion<double>& motion) {
  FrameRotation shares;
  shares.kappa = -skew<double>(motion.center);
  shares.rate = -skew<double>(motion.center_rate);
  return shares;
}

/// Adds the rows of a node's translation to g, z, J, F, and its share in the coefficients of δΘ₀.
void add_translation(const SuperelementBody& body, const LocalMotion<double>& motion, std::size_t i, double damping,
                     CenterWork& out, FrameRotation& shares) {
  const int row = body.node[i].translation_row;
  const Matrix3d G = body.Gamma_B.middleCols<3>(row), O0 = skew<double>(motion.Omega0);
  shares.kappa += G * skew<double>(motion.node[i].xh) / body.mass;
  shares.rate += G * skew<double>(Vector3d(motion.deformation_rate_B.segment<3>(row))) / body.mass;
  shares.GV += G * skew<double>(motion.node[i].xd);
  out.g.middleRows<3>(row) = motion.R0 * G.transpose();
  out.z.middleRows<3>(row) = damping * motion.R0 * O0 * G.transpose();
  out.J.middleRows<3>(row) = out.g.middleRows<3>(row) / body.mass;
  out.F.middleRows<3>(row) = (2.0 * damping / body.mass) * motion.R0 * (O0 * G - G * O0).transpose();
}

/// Adds the rows of a node's rotation likewise.
void add_rotation(const SuperelementBody& body, const LocalMotion<double>& motion, std::size_t i, double damping,
                  CenterWork& out, FrameRotation& shares) {
  const int row = body.node[i].rotation_row;
  const LocalNode<double>& local = motion.node[i];
  const Matrix3d G = body.Gamma_B.middleCols<3>(row), O0 = skew<double>(motion.Omega0);
  const Matrix3d Tinv_rate =
      inverse_tangent_rate<double>(local.psi, Vector3d(motion.deformation_rate_B.segment<3>(row)));
  shares.kappa -= G * local.Tinv.transpose() / body.mass;
  shares.rate -= G * Tinv_rate.transpose() / body.mass;
  out.g.middleRows<3>(row) = G.transpose();
  out.J.middleRows<3>(row) = (G * local.Tinv).transpose() / body.mass;
  out.F.middleRows<3>(row) = (2.0 * damping / body.mass) * (O0 * G * local.Tinv + G * Tinv_rate).transpose();
}

/// Sets all columns except w.
void set_columns(const SuperelementBody& body, const LocalMotion<double>& motion, const TangentCoefficients& c,
                 CenterWork& out) {
  for (Columns* columns : {&out.g, &out.z, &out.J, &out.F}) columns->setZero();
  FrameRotation shares = start_of_frame_rotation(motion);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    if (body.node[i].has_translation()) add_translation(body, motion, i, c.damping, out, shares);
    if (body.node[i].has_rotation()) add_rotation(body, motion, i, c.damping, out, shares);
  }
  add_frame_rotation(body, motion, c.damping * shares.GV, out.z);
  add_frame_rotation(body, motion, shares.kappa, out.J);
  add_frame_rotation(body, motion, 2.0 * c.damping * (shares.rate + skew<double>(motion.Omega0) * shares.kappa), out.F);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    if (!body.node[i].has_rotation()) continue;
    const int row = body.node[i].rotation_row;
    out.F.middleRows<3>(row) += c.damping * skew<double>(motion.node[i].Omega) * out.J.middleRows<3>(row);
  }
  out.F += c.mass * out.J;
}

/// Derivative of R₀ᵀẍ_cm by a coordinate that moves the centre of mass in axes of the frame: c_m + 2 c_c Ω₀~.
Matrix3d acceleration_of_rates(const TangentCoefficients& c, const LocalMotion<double>& motion) {
  return c.mass * Matrix3d::Identity() + skew<double>(2.0 * c.damping * motion.Omega0);
}

}  // namespace

void add_center_of_mass_tangent(const SuperelementBody& body, SuperelementScratch& scratch, SuperelementWork& work) {
  SuperelementTangent& frozen = scratch.tangent;
  const TangentCoefficients& c = frozen.coefficients;
  CenterWork& columns = work.center;
  set_columns(body, scratch.motion, c, columns);
  for (int k = 0; k < 3; ++k) {
    work.column = body.Gamma_B.row(k);
    apply_W(body, frozen, work.column, work.turned);
    columns.w.col(k) = work.turned;
  }
  work.A_BB.noalias() += body.mass * columns.J.lazyProduct(columns.F.transpose());
  work.A_BB.noalias() -= columns.w.lazyProduct(columns.g.transpose()) / body.mass;
  work.A_BB.noalias() -= columns.g.lazyProduct(columns.z.transpose()) / body.mass;
  if (body.modes == 0) return;
  // ΔA_BI = (Jᵀ (c_m + 2 c_c Ω₀~) − W Γ_Bᵀ/m) Γ_I and ΔA_IB = Γ_Iᵀ (c_m J + c_c A_v − Γ_B Z/m).
  columns.w = columns.J.lazyProduct(acceleration_of_rates(c, scratch.motion)) - columns.w / body.mass;
  columns.F -= (c.mass * columns.g + columns.z) / body.mass;
  for (Eigen::Index k = 0; k < body.modes; ++k) {
    frozen.A_BI.col(k).noalias() += columns.w.lazyProduct(body.Gamma_I.col(k));
    frozen.A_IB.row(k).transpose().noalias() += columns.F.lazyProduct(body.Gamma_I.col(k));
  }
}

}  // namespace tisserand::mechanism
