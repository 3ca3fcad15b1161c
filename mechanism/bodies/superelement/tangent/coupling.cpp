// SPDX-License-Identifier: GPL-3.0-or-later
// Elimination of the internal coordinates with the blocks of the latest tangent.
#include "mechanism/bodies/superelement/tangent/coupling.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;

Vector3d segment3(const double* v, int row) { return Eigen::Map<const Vector3d>(v + row); }

/// Rotation rows of v in axes of the frame: E v with option A, otherwise v.
Vector3d rotation_part(const SuperelementBody& body, const LocalNode<double>& local, const Vector3d& v) {
  return body.inertia == formats::InertiaOption::A ? Vector3d(local.E * v) : v;
}

/// Rotation increment δΘ₀ = U v of the frame.
Vector3d frame_rotation(const SuperelementBody& body, const SuperelementTangent& tangent, const double* v) {
  Vector3d rotation = Vector3d::Zero();
  if (body.frame == FrameAlgorithm::polar) {
    for (const int j : body.translation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      rotation += tangent.node[i].U_x * segment3(v, body.node[i].translation_row);
    }
  } else {
    for (const int j : body.rotation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      rotation += tangent.node[i].U * segment3(v, body.node[i].rotation_row);
    }
  }
  return rotation;
}

/// Signs in c_m Pᵀ t + c_c (Pᵀ (O₀ ∓ turn O_B) t − frame UᵀVᵀ t), with W and Z of THEORY (37), (38). (1, 1) gives W t,
/// (0, −1) gives Zᵀ t.
struct Side {
  double turn, frame;
};

void apply_side(const SuperelementBody& body, const SuperelementTangent& tangent, const Side& side,
                const Eigen::VectorXd& t, Eigen::VectorXd& out) {
  const TangentCoefficients& c = tangent.coefficients;
  const bool option_A = body.inertia == formats::InertiaOption::A;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = tangent.node[i];
    if (node.has_translation())
      moment += side.frame * c.damping * local.xd.cross(Vector3d(t.segment<3>(node.translation_row)));
    if (node.has_rotation() && option_A)
      moment += side.frame * c.damping * local.Omega.cross(Vector3d(t.segment<3>(node.rotation_row)));
  }
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = tangent.node[i];
    if (node.has_translation()) {
      const Vector3d s = t.segment<3>(node.translation_row);
      out.segment<3>(node.translation_row) = tangent.R0 * (c.mass * s + c.damping * tangent.Omega0.cross(s));
      if (body.frame == FrameAlgorithm::polar) out.segment<3>(node.translation_row) += local.U_x.transpose() * moment;
    }
    if (!node.has_rotation()) continue;
    const Vector3d s = t.segment<3>(node.rotation_row);
    Vector3d f;
    if (option_A)
      f = local.E.transpose() * (c.mass * s + c.damping * (tangent.Omega0 - side.turn * local.Omega).cross(s));
    else
      f = c.mass * s + (side.turn * c.damping) * local.Omega.cross(s);
    out.segment<3>(node.rotation_row) = f + local.U.transpose() * moment;
  }
}

/// Computes dy_I = −A_II⁻¹ (r_I + A_IB dq_B), with r_I in work.internal_column.
void expand_residual(const SuperelementBody& body, const SuperelementTangent& tangent, const double* dq_B, double* dy_I,
                     SuperelementWork& work) {
  if (tangent.dense_coupling) {
    work.internal_column.noalias() += tangent.A_IB * Eigen::Map<const Eigen::VectorXd>(dq_B, body.boundary_size);
  } else {
    apply_Z(body, tangent, dq_B, work.column);
    multiply_add(body.M_IB, work.column, work.internal_column);
  }
  tangent.internal.solve_in_place(work.internal_column);
  Eigen::Map<Eigen::VectorXd>(dy_I, body.modes) = -work.internal_column;
}

}  // namespace

void add_upsilon_transposed(const SuperelementBody& body, const SuperelementTangent& tangent, double factor,
                            const Eigen::VectorXd& t, Eigen::VectorXd& out) {
  Vector3d moment = Vector3d::Zero(), total = Vector3d::Zero();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation()) {
      const Vector3d s = factor * t.segment<3>(node.translation_row);
      total += s;
      moment -= tangent.node[i].xh.cross(s);
    }
    if (node.has_rotation()) moment -= tangent.node[i].Tinv * (factor * t.segment<3>(node.rotation_row));
  }
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = tangent.node[i];
    if (node.has_translation()) {
      out.segment<3>(node.translation_row) +=
          tangent.R0 * (factor * t.segment<3>(node.translation_row) - node.alpha * total);
      if (body.frame == FrameAlgorithm::polar) out.segment<3>(node.translation_row) += local.U_x.transpose() * moment;
    }
    if (node.has_rotation())
      out.segment<3>(node.rotation_row) +=
          local.Tinv.transpose() * (factor * t.segment<3>(node.rotation_row)) + local.U.transpose() * moment;
  }
}

void apply_Z(const SuperelementBody& body, const SuperelementTangent& tangent, const double* v, Eigen::VectorXd& out) {
  const TangentCoefficients& c = tangent.coefficients;
  const Vector3d rotation = frame_rotation(body, tangent, v);
  out.setZero();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = tangent.node[i];
    if (node.has_translation()) {
      const Vector3d x = tangent.R0.transpose() * segment3(v, node.translation_row);
      out.segment<3>(node.translation_row) +=
          c.mass * x + c.damping * (x.cross(tangent.Omega0) + local.xd.cross(rotation));
    }
    if (!node.has_rotation()) continue;
    const Vector3d theta = rotation_part(body, local, segment3(v, node.rotation_row));
    out.segment<3>(node.rotation_row) += c.mass * theta;
    if (body.inertia == formats::InertiaOption::A)
      out.segment<3>(node.rotation_row) += c.damping * (theta.cross(tangent.Omega0) + local.Omega.cross(rotation));
  }
}

void apply_W(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
             Eigen::VectorXd& out) {
  apply_side(body, tangent, {.turn = 1.0, .frame = 1.0}, t, out);
}

void apply_Z_transposed(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
                        Eigen::VectorXd& out) {
  apply_side(body, tangent, {.turn = 0.0, .frame = -1.0}, t, out);
}

bool has_stored_coupling(const SuperelementBody& body) {
  return body.planar || body.inertia == formats::InertiaOption::M || body.damping.is_full() || body.second_order.any();
}

void store_coupling(const SuperelementBody& body, SuperelementTangent& tangent, SuperelementWork& work) {
  tangent.dense_coupling = true;
  const double damping = tangent.coefficients.damping;
  const bool damped = damping != 0.0 && body.damping.is_full();
  for (Eigen::Index k = 0; k < body.modes; ++k) {
    work.column = body.M_BI.col(k);
    apply_W(body, tangent, work.column, work.turned);
    tangent.A_BI.col(k) = work.turned;
    apply_Z_transposed(body, tangent, work.column, work.turned);
    tangent.A_IB.row(k) = work.turned;
    if (!damped) continue;
    work.column = body.damping.BI.col(k);
    work.turned.setZero();
    add_upsilon_transposed(body, tangent, damping, work.column, work.turned);
    tangent.A_BI.col(k) += work.turned;
    tangent.A_IB.row(k) += work.turned;
  }
}

void eliminate_internal(const SuperelementTangent& tangent, SuperelementWork& work) {
  work.eliminated = tangent.A_IB;
  tangent.internal.solve_in_place(work.eliminated);
  work.A_BB.noalias() -= tangent.A_BI * work.eliminated;
}

void condense(const SuperelementBody& body, const SuperelementScratch& scratch, SuperelementWork& work) {
  work.r_B_condensed = scratch.forces.r_B;
  if (body.modes == 0) return;
  const SuperelementTangent& tangent = scratch.tangent;
  work.internal_column = scratch.forces.r_I;
  tangent.internal.solve_in_place(work.internal_column);
  if (tangent.dense_coupling) {
    work.r_B_condensed.noalias() -= tangent.A_BI * work.internal_column;
    return;
  }
  work.column.setZero();
  multiply_add(body.M_BI, work.internal_column, work.column);
  apply_W(body, tangent, work.column, work.turned);
  work.r_B_condensed -= work.turned;
}

void expand(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
            SuperelementWork& work) {
  work.internal_column = scratch.forces.r_I;
  if (body.modes > 0) expand_residual(body, scratch.tangent, dq_B, dy_I, work);
}

void expand_motion(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
                   SuperelementWork& work) {
  work.internal_column.setZero();
  if (body.modes > 0) expand_residual(body, scratch.tangent, dq_B, dy_I, work);
}

}  // namespace tisserand::mechanism
