// Elimination of the internal coordinates with the blocks of the latest tangent.
#include "mechanism/bodies/superelement/coupling.hpp"

namespace tisserand::mechanism {

namespace {

using Eigen::Vector3d;

Vector3d segment3(const double* v, int row) { return Eigen::Map<const Vector3d>(v + row); }

/// v in axes of the frame: R₀ᵀ v of translations, E v of rotations with option A.
Vector3d rotation_part(const SuperelementBody& body, const LocalNode<double>& local, const Vector3d& v) {
  return body.inertia == formats::InertiaOption::A ? Vector3d(local.E * v) : v;
}

/// δΘ₀ = U v.
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

namespace {

/// c_m Pᵀ t + c_c (Pᵀ (O₀ ∓ turn O_B) t − frame UᵀVᵀ t): W t with 1, 1; Zᵀ t with 0, −1.
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

}  // namespace

void apply_W(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
             Eigen::VectorXd& out) {
  apply_side(body, tangent, {.turn = 1.0, .frame = 1.0}, t, out);
}

void apply_Z_transposed(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
                        Eigen::VectorXd& out) {
  apply_side(body, tangent, {.turn = 0.0, .frame = -1.0}, t, out);
}

void store_coupling(const SuperelementBody& body, SuperelementTangent& tangent, SuperelementWork& work) {
  tangent.dense_coupling = true;
  const double damping = tangent.coefficients.damping;
  const bool damped = damping != 0.0 && body.damping.is_full();
  for (Eigen::Index k = 0; k < body.modes; ++k) {
    work.boundary_1 = body.M_BI.col(k);
    apply_W(body, tangent, work.boundary_1, work.boundary_2);
    tangent.A_BI.col(k) = work.boundary_2;
    apply_Z_transposed(body, tangent, work.boundary_1, work.boundary_2);
    tangent.A_IB.row(k) = work.boundary_2;
    if (!damped) continue;
    work.boundary_1 = body.damping.BI.col(k);
    work.boundary_2.setZero();
    add_upsilon_transposed(body, tangent, damping, work.boundary_1, work.boundary_2);
    tangent.A_BI.col(k) += work.boundary_2;
    tangent.A_IB.row(k) += work.boundary_2;
  }
}

void eliminate_internal(const SuperelementBody& body, const SuperelementTangent& tangent, SuperelementWork& work) {
  if (body.second_order.any()) {
    work.eliminated = tangent.A_IB;
    tangent.factor.solve_in_place(work.eliminated);
    work.A_BB.noalias() -= tangent.A_BI * work.eliminated;
    return;
  }
  const bool full = body.damping.is_full();
  if (full) work.eliminated.noalias() = tangent.inverse_II.lazyProduct(tangent.A_IB);
  for (Eigen::Index k = 0; k < body.modes; ++k) {
    const Eigen::MatrixXd& rows = full ? work.eliminated : tangent.A_IB;
    work.boundary_2 = rows.row(k);
    const double factor = full ? 1.0 : work.inverse_D[k];
    work.A_BB.noalias() -= factor * tangent.A_BI.col(k).lazyProduct(work.boundary_2.transpose());
  }
}

void condense(const SuperelementBody& body, const SuperelementScratch& scratch, SuperelementWork& work) {
  work.r_B_condensed = scratch.forces.r_B;
  if (body.modes == 0) return;
  const SuperelementTangent& tangent = scratch.tangent;
  if (body.second_order.any()) {
    work.internal_1 = scratch.forces.r_I;
    tangent.factor.solve_in_place(work.internal_1);
  } else if (body.damping.is_full())
    work.internal_1.noalias() = tangent.inverse_II * scratch.forces.r_I;
  else
    work.internal_1 = tangent.inverse_D.cwiseProduct(scratch.forces.r_I);
  if (tangent.dense_coupling) {
    work.r_B_condensed.noalias() -= tangent.A_BI * work.internal_1;
    return;
  }
  work.boundary_1.setZero();
  multiply_add(body.M_BI, work.internal_1, work.boundary_1);
  apply_W(body, tangent, work.boundary_1, work.boundary_2);
  work.r_B_condensed -= work.boundary_2;
}

void expand(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
            SuperelementWork& work) {
  if (body.modes == 0) return;
  const SuperelementTangent& tangent = scratch.tangent;
  work.internal_1 = scratch.forces.r_I;
  if (tangent.dense_coupling) {
    work.internal_1.noalias() += tangent.A_IB * Eigen::Map<const Eigen::VectorXd>(dq_B, body.boundary_size);
  } else {
    apply_Z(body, tangent, dq_B, work.boundary_1);
    multiply_add(body.M_IB, work.boundary_1, work.internal_1);
  }
  Eigen::Map<Eigen::VectorXd> out(dy_I, body.modes);
  if (body.second_order.any()) {
    tangent.factor.solve_in_place(work.internal_1);
    out = work.internal_1;
  } else if (body.damping.is_full())
    out.noalias() = tangent.inverse_II * work.internal_1;
  else
    out = tangent.inverse_D.cwiseProduct(work.internal_1);
  out = -out;
}

void expand_motion(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
                   SuperelementWork& work) {
  if (body.modes == 0) return;
  const SuperelementTangent& tangent = scratch.tangent;
  Eigen::Map<Eigen::VectorXd> out(dy_I, body.modes);
  if (body.second_order.any()) {
    work.internal_1.noalias() = tangent.A_IB * Eigen::Map<const Eigen::VectorXd>(dq_B, body.boundary_size);
    tangent.factor.solve_in_place(work.internal_1);
    out = -work.internal_1;
    return;
  }
  expand(body, scratch, dq_B, dy_I, work);  // affine: minus its value at zero
  for (Eigen::Index k = 0; k < body.modes; ++k) out[k] += tangent.inverse_D[k] * scratch.forces.r_I[k];
}

}  // namespace tisserand::mechanism
