// Derivatives of the transposed projector at fixed forces.
#include "mechanism/bodies/superelement/second_order_tangent.hpp"

namespace tisserand::mechanism {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// ∂(T⁻¹(ψ) b)/∂ψ = −b~/2 + 2 e' (ψ × (ψ × b)) ψᵀ − e ((ψ × b)~ + ψ~ b~): column k is Ṫ⁻¹ for ψ̇ = e_k, times b.
Matrix3d inverse_tangent_derivative(const Vector3d& psi, const Vector3d& b) {
  Matrix3d Z;
  for (int k = 0; k < 3; ++k) Z.col(k) = inverse_tangent_rate<double>(psi, Vector3d::Unit(k)) * b;
  return Z;
}

}  // namespace

void add_frame_stiffness(const SuperelementBody& body, const SuperelementTangent& frozen, const Eigen::VectorXd& f,
                         double factor, FrameStiffnessWork work, Eigen::MatrixXd& A) {
  const auto rotation_force = [&](int i) { return Vector3d(f.segment<3>(body.node[i].rotation_row)); };
  Vector3d F0 = Vector3d::Zero(), m0 = Vector3d::Zero();
  Matrix3d average = Matrix3d::Zero(), turn = Matrix3d::Zero();  // Σ α T⁻¹(−ψ); δm₀ by the rotation of the frame
  for (const int i : body.translation_nodes) {
    const Vector3d fu = f.segment<3>(body.node[i].translation_row);
    F0 += fu;
    m0 -= frozen.node[i].xh.cross(fu);
    turn += skew<double>(fu) * skew<double>(frozen.node[i].xh);
  }
  for (const int i : body.rotation_nodes) {
    const LocalNode<double>& local = frozen.node[i];
    m0 -= local.Tinv * rotation_force(i);
    average += body.node[i].alpha_rotation * local.Tinv.transpose();
    turn += inverse_tangent_derivative(local.psi, rotation_force(i)) * local.Tinv.transpose();
  }
  const Matrix3d to_c = inverse3<double>(Matrix3d(average.transpose()));
  const Vector3d c0 = to_c * m0;
  // δm₀ without δf, and δc₀ = A⁻ᵀ (δm₀ − Σ αᵢ Z(ψᵢ, c₀) δψᵢ), per column of δq.
  for (const int j : body.translation_nodes) {
    const int row = body.node[j].translation_row;
    work.dm.middleCols<3>(row) =
        skew<double>(Vector3d(f.segment<3>(row) - body.node[j].alpha * F0)) * frozen.R0.transpose();
    work.dc.middleCols<3>(row).noalias() = to_c * work.dm.middleCols<3>(row);
  }
  Matrix3d mean_turn = Matrix3d::Zero();
  for (const int i : body.rotation_nodes)
    if (body.node[i].alpha_rotation != 0.0)
      mean_turn += body.node[i].alpha_rotation * inverse_tangent_derivative(frozen.node[i].psi, c0) *
                   frozen.node[i].Tinv.transpose();
  for (const int j : body.rotation_nodes) {
    const LocalNode<double>& local = frozen.node[j];
    const int row = body.node[j].rotation_row;
    work.dm.middleCols<3>(row) = turn * local.U - inverse_tangent_derivative(local.psi, rotation_force(j)) * local.Tinv;
    work.dc.middleCols<3>(row) =
        to_c * (work.dm.middleCols<3>(row) + mean_turn * local.U -
                body.node[j].alpha_rotation * inverse_tangent_derivative(local.psi, c0) * local.Tinv);
  }
  for (const int j : body.translation_nodes) {
    const int row = body.node[j].translation_row;
    const Matrix3d G = -factor * frozen.R0 * skew<double>(Vector3d(f.segment<3>(row) - body.node[j].alpha * F0));
    for (const int k : body.rotation_nodes)
      if (body.node[k].alpha_rotation != 0.0)
        A.block<3, 3>(row, body.node[k].rotation_row).noalias() += G * frozen.node[k].U;
  }
  for (const int j : body.rotation_nodes) {
    const SuperelementNode& node = body.node[j];
    const LocalNode<double>& local = frozen.node[j];
    // ∂(T⁻¹(−ψ) b)/∂ψ = −Z(−ψ, b)
    const Matrix3d Z = factor * inverse_tangent_derivative(-local.psi, rotation_force(j) + node.alpha_rotation * c0);
    A.block<3, 3>(node.rotation_row, node.rotation_row).noalias() -= Z * local.Tinv;
    for (const int k : body.rotation_nodes)
      if (body.node[k].alpha_rotation != 0.0)
        A.block<3, 3>(node.rotation_row, body.node[k].rotation_row) += Z * (local.Tinv.transpose() * frozen.node[k].U);
    if (node.alpha_rotation != 0.0)
      A.middleRows<3>(node.rotation_row) +=
          (factor * node.alpha_rotation * local.Tinv.transpose()).lazyProduct(work.dc);
  }
}

}  // namespace tisserand::mechanism
