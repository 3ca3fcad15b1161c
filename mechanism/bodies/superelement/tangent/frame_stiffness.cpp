// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the transposed projector at fixed forces: THEORY (21), (22).
#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"

#include <Eigen/LU>

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Derivative Z(ψ, b) = ∂(T⁻¹(ψ) b)/∂ψ of THEORY (21): −b~/2 + 2 e' (ψ × (ψ × b)) ψᵀ − e ((ψ × b)~ + ψ~ b~). Column k
/// is Ṫ⁻¹ b for ψ̇ = e_k.
Matrix3d inverse_tangent_derivative(const Vector3d& psi, const Vector3d& b) {
  Matrix3d Z;
  for (int k = 0; k < 3; ++k) Z.col(k) = inverse_tangent_rate<double>(psi, Vector3d::Unit(k)) * b;
  return Z;
}

/// Derivative inverse_tangent_derivative() for rotations of nodes in space; zero in the plane, where T is 1.
template <int D>
Eigen::Matrix<double, Space<D>::turns, Space<D>::turns> derivative_of(const Vector3d& psi, const TurnOf<D>& b) {
  if constexpr (D == 3)
    return inverse_tangent_derivative(psi, b);
  else
    return TurnOf<D>::Zero();
}

}  // namespace

template <int D>
void add_frame_stiffness(const SuperelementBody& body, const SuperelementTangent& frozen, const Eigen::VectorXd& f,
                         double factor, FrameStiffnessWork work, MatrixXd& A) {
  constexpr int n = Space<D>::turns;
  using Square = Eigen::Matrix<double, n, n>;
  const auto rotation_force = [&](int i) { return TurnOf<D>(f.segment<n>(body.node[i].rotation_row)); };
  const auto Tinv = [&](int i) { return Square(frozen.node[i].Tinv.bottomRightCorner<n, n>()); };
  const auto U = [&](int i) { return frame_turn<D>(body.node[i], frozen.node[i]); };
  const Eigen::Matrix<double, D, D> R0 = frozen.R0.topLeftCorner<D, D>();
  auto dm = work.dm.bottomRows<n>(), dc = work.dc.bottomRows<n>();
  VectorOf<D> F0 = VectorOf<D>::Zero();
  TurnOf<D> m0 = TurnOf<D>::Zero();
  Square average = Square::Zero(), turn = Square::Zero();  // Σ α T⁻¹(−ψ); δm₀ by the rotation of the frame
  for (const int i : body.translation_nodes) {
    const VectorOf<D> fu = f.segment<D>(body.node[i].translation_row), xh = Space<D>::part(frozen.node[i].xh);
    F0 += fu;
    m0 -= Space<D>::cross(xh, fu);
    turn -= Space<D>::turning_product(fu, xh);
  }
  for (const int i : body.rotation_nodes) {
    m0 -= Tinv(i) * rotation_force(i);
    average += body.node[i].alpha_rotation * Tinv(i).transpose();
    turn += derivative_of<D>(frozen.node[i].psi, rotation_force(i)) * Tinv(i).transpose();
  }
  const Square to_c = Square(average.transpose()).inverse();
  const TurnOf<D> c0 = to_c * m0;
  const auto turned = [&](int j) {  // force on node j, less its share of the force on x₀
    return Space<D>::turning(f.segment<D>(body.node[j].translation_row) - body.node[j].alpha * F0);
  };
  // THEORY (22), m₀ = μ and c₀ = γ: δm₀ without δf, and δc₀ = A⁻ᵀ (δm₀ − Σ αᵢ Z(ψᵢ, c₀) δψᵢ), per column of δq.
  for (const int j : body.translation_nodes) {
    const int row = body.node[j].translation_row;
    dm.template middleCols<D>(row) = turned(j).transpose() * R0.transpose();
    dc.template middleCols<D>(row).noalias() = to_c * dm.template middleCols<D>(row);
  }
  Square mean_turn = Square::Zero();
  for (const int i : body.rotation_nodes)
    if (body.node[i].alpha_rotation != 0.0)
      mean_turn += body.node[i].alpha_rotation * derivative_of<D>(frozen.node[i].psi, c0) * Tinv(i).transpose();
  for (const int j : body.rotation_nodes) {
    const Vector3d& psi = frozen.node[j].psi;
    const int row = body.node[j].rotation_row;
    dm.template middleCols<n>(row) = turn * U(j) - derivative_of<D>(psi, rotation_force(j)) * Tinv(j);
    dc.template middleCols<n>(row) = to_c * (dm.template middleCols<n>(row) + mean_turn * U(j) -
                                             body.node[j].alpha_rotation * derivative_of<D>(psi, c0) * Tinv(j));
  }
  for (const int j : body.translation_nodes) {
    const Eigen::Matrix<double, D, n> G = factor * R0 * turned(j);
    for (const int k : body.rotation_nodes)
      if (body.node[k].alpha_rotation != 0.0)
        A.block<D, n>(body.node[j].translation_row, body.node[k].rotation_row).noalias() += G * U(k);
  }
  for (const int j : body.rotation_nodes) {
    const SuperelementNode& node = body.node[j];
    // ∂(T⁻¹(−ψ) b)/∂ψ = −Z(−ψ, b)
    const Square Z = factor * derivative_of<D>(-frozen.node[j].psi, rotation_force(j) + node.alpha_rotation * c0);
    A.block<n, n>(node.rotation_row, node.rotation_row).noalias() -= Z * Tinv(j);
    for (const int k : body.rotation_nodes)
      if (body.node[k].alpha_rotation != 0.0)
        A.block<n, n>(node.rotation_row, body.node[k].rotation_row) += Z * (Tinv(j).transpose() * U(k));
    if (node.alpha_rotation != 0.0)
      A.middleRows<n>(node.rotation_row) += (factor * node.alpha_rotation * Tinv(j).transpose()).lazyProduct(dc);
  }
}
template void add_frame_stiffness<2>(const SuperelementBody&, const SuperelementTangent&, const Eigen::VectorXd&,
                                     double, FrameStiffnessWork, MatrixXd&);
template void add_frame_stiffness<3>(const SuperelementBody&, const SuperelementTangent&, const Eigen::VectorXd&,
                                     double, FrameStiffnessWork, MatrixXd&);

}  // namespace tisserand::mechanism
