// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly in (x₀, Θ₀, y), elimination of the internal coordinates there, and transformation to node coordinates.
#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"

#include <Eigen/Dense>

namespace tisserand::mechanism {
namespace {

using Eigen::Lower;
using Eigen::Matrix3d;
using Eigen::MatrixXd;

/// Computes out = X [A₀; U; Υ] for X with 6 + nb columns: x₀, Θ₀, y_B.
template <int D>
void times_Z_in(const SuperelementBody& body, const SuperelementTangent& frozen, const MatrixXd& X, MatrixXd& out,
                MatrixXd& thin) {
  constexpr int n = Space<D>::turns;
  auto total = thin.leftCols<D>();
  auto turn = thin.middleCols<n>(3);
  total.setZero();
  turn = X.middleCols<n>(Space<D>::first_turn);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = frozen.node[i];
    if (node.has_translation()) {
      total += X.middleCols<D>(6 + node.translation_row);
      turn -= X.middleCols<D>(6 + node.translation_row).lazyProduct(Space<D>::turning(Space<D>::part(local.xh)));
    }
    if (node.has_rotation())
      turn -= X.middleCols<n>(6 + node.rotation_row).lazyProduct(local.Tinv.bottomRightCorner<n, n>().transpose());
  }
  auto& rest = total;  // share of the columns of x₀, which the weights distribute
  rest = X.leftCols<D>() - total;
  const Eigen::Matrix<double, D, D> R0T = frozen.R0.topLeftCorner<D, D>().transpose();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = frozen.node[i];
    if (node.has_translation()) {
      const int row = node.translation_row;
      for (int c = 0; c < D; ++c) {  // column by column, because a product with a sum would allocate memory for the sum
        auto column = out.col(row + c);
        column = R0T(0, c) * (X.col(6 + row) + node.alpha * rest.col(0));
        for (int k = 1; k < D; ++k) column += R0T(k, c) * (X.col(6 + row + k) + node.alpha * rest.col(k));
      }
      if (body.frame == FrameAlgorithm::polar)
        out.middleCols<D>(row) += turn.lazyProduct(local.U_x.bottomLeftCorner<n, D>());
    }
    if (!node.has_rotation()) continue;
    const int row = node.rotation_row;
    out.middleCols<n>(row) = X.middleCols<n>(6 + row).lazyProduct(local.Tinv.bottomRightCorner<n, n>());
    if (turns_frame(body, node)) out.middleCols<n>(row) += turn.lazyProduct(frame_turn<D>(node, local));
  }
}

void times_Z(const SuperelementBody& body, const SuperelementTangent& frozen, const MatrixXd& X, MatrixXd& out,
             MatrixXd& thin) {
  in_space(body.planar, [&]<int D>() { times_Z_in<D>(body, frozen, X, out, thin); });
}

void freeze_frame(const LocalMotion<double>& motion, const TangentCoefficients& c, SuperelementTangent& frozen) {
  frozen.coefficients = c;
  frozen.R0 = motion.R0;
  frozen.Omega0 = motion.Omega0;
  frozen.node = motion.node;
}

/// Adds c_k K_y + c_c b (L + h)ᵀ(L + h), THEORY (44), (45), to the lower triangle of the y block, with
/// K_y = (L + h)ᵀ(L + h) + Σ e_a Γ_a.
void add_strain_stiffness(const SuperelementBody& body, const StrainTerms<double>& t, const TangentCoefficients& c,
                          SecondOrderWork& work) {
  const Stiffening& stiffening = *body.second_order.stiffening;
  auto K = work.K.bottomRightCorner(stiffening.L.cols(), stiffening.L.cols());
  work.bent = stiffening.L + t.h;
  K.selfadjointView<Lower>().rankUpdate(work.bent.transpose(), c.stiffness + c.damping * body.damping.stiffness);
  if (c.stiffness != 0.0) add_combination(stiffening.Gamma, c.stiffness, t.e, K);
}

/// Adds the stiffness of the load cases, −c_k Σ s K, to the lower triangle of the y block.
void add_load_stiffness(const SuperelementBody& body, const LoadTerms<double>& t, double stiffness,
                        SecondOrderWork& work) {
  for (std::size_t i = 0; i < body.load_cases.size(); ++i) {
    const double factor = stiffness * t.factors[static_cast<Eigen::Index>(i)];
    const MatrixXd& load = body.load_cases[i].stiffness;
    if (factor != 0.0 && load.size() > 0) work.K.bottomRightCorner(load.rows(), load.cols()) -= factor * load;
  }
}

/// Adds factor S̄, which is block diagonal, to the y block.
void add_linear_stiffness(const SuperelementBody& body, double factor, SecondOrderWork& work) {
  const int nb = body.boundary_size, m = body.modes;
  work.K.block(6, 6, nb, nb) += factor * body.S_BB;
  work.K.diagonal().tail(m) += factor * body.S_II;
}

/// Adds the damping without b S̄ to the y block.
void add_damping(const SuperelementBody& body, double factor, SecondOrderWork& work) {
  const SuperelementDamping& damping = body.damping;
  if (!damping.active || factor == 0.0) return;
  const int nb = body.boundary_size, m = body.modes;
  work.K.diagonal().tail(m) += factor * (damping.internal - damping.stiffness * body.S_II);
  if (!damping.is_full()) return;
  work.K.block(6, 6, nb, nb) += factor * damping.BB;
  work.K.bottomLeftCorner(m, nb + 6).rightCols(nb) += factor * damping.IB;
  work.K.bottomRightCorner(m, m) += factor * damping.II;
}

/// Adds the lower triangle of ∂²T/∂(η, ẏ)² of THEORY (54), η = (v₀, Ω₀): Wᵀ M̄ W, and the terms of C and JJ by Ω₀.
void add_inertia(const SuperelementBody& body, const InertiaTerms<double>& t, double factor, SecondOrderWork& work) {
  if (factor == 0.0) return;
  const FullInertia& inertia = *body.second_order.inertia;
  const Eigen::Index n = inertia.M.rows();
  auto yy = work.K.bottomRightCorner(n, n);
  auto rigid = work.K.bottomLeftCorner(n, 6);
  yy += factor * inertia.M;
  using Six = Eigen::Matrix<double, 6, 6>;
  Six W = Six::Identity();  // rigid part of the true velocity by (v₀, Ω₀)
  const Eigen::Map<const MatrixXd> Cy(t.Cy.data(), n, 3);
  const Eigen::Matrix<double, 6, 3> rigid_Cy = inertia.R.transpose().lazyProduct(Cy);
  work.X = inertia.MR;
  if (inertia.foreshortening) {
    Eigen::Matrix<double, 6, 3> turn;
    turn << -skew<double>(t.sigma), -0.5 * skew<double>(t.nu) + t.TT;
    W.rightCols<3>() += inertia.J0_inverse * turn;
    work.momentum = t.forms_y.topRows(6);  // ∂n₂/∂ẏ
    if (turns_nodes(inertia))
      work.momentum.bottomRows<3>() += Eigen::Map<const MatrixXd>(t.Wy.data(), n, 3).transpose();
    work.D.noalias() = inertia.J0_inverse.lazyProduct(work.momentum);
    work.X += 0.5 * work.momentum.transpose();
    yy.triangularView<Lower>() += factor * work.X * work.D;
    yy.triangularView<Lower>() += factor * work.D.transpose() * work.X.transpose();
    work.X += 0.5 * work.momentum.transpose();
    rigid.rightCols<3>().noalias() += factor * work.D.transpose().lazyProduct(rigid_Cy);
  }
  rigid.noalias() += factor * work.X.lazyProduct(W);
  rigid.rightCols<3>() += factor * Cy;
  Six rr = W.transpose() * (inertia.R.transpose().lazyProduct(inertia.MR)) * W;
  const Eigen::Matrix<double, 6, 3> turning = W.transpose() * rigid_Cy;
  rr.rightCols<3>() += turning;
  rr.bottomRows<3>() += turning.transpose();
  rr.bottomRightCorner<3, 3>() += t.JJ;
  work.K.topLeftCorner<6, 6>() += factor * rr;
}

/// Assembles the lower triangle of all terms of inertia option F.
void assemble_full_inertia(const SuperelementBody& body, const SuperelementForces<double>& forces,
                           const TangentCoefficients& c, SecondOrderWork& work) {
  work.K.setZero();
  add_inertia(body, forces.inertia, c.mass, work);
  if (body.second_order.stiffening)
    add_strain_stiffness(body, forces.strain, c, work);
  else
    add_linear_stiffness(body, c.stiffness + c.damping * body.damping.stiffness, work);
  add_damping(body, c.damping, work);
  add_load_stiffness(body, forces.loads, c.stiffness, work);
}

/// Assembles the lower triangle of K_y − S̄.
void assemble_stiffening(const SuperelementBody& body, const SuperelementForces<double>& forces,
                         const TangentCoefficients& c, SecondOrderWork& work) {
  work.K.setZero();
  add_strain_stiffness(body, forces.strain, c, work);
  add_linear_stiffness(body, -(c.stiffness + c.damping * body.damping.stiffness), work);
  add_load_stiffness(body, forces.loads, c.stiffness, work);
}

/// Computes work.second.pulled = Zᵀ K_bb Z.
void pull_back_boundary(const SuperelementBody& body, const SuperelementTangent& frozen, SuperelementWork& work) {
  SecondOrderWork& w = work.second;
  w.K_bb.triangularView<Eigen::StrictlyUpper>() = w.K_bb.transpose();
  times_Z(body, frozen, w.K_bb, w.half, w.thin_boundary);
  w.turned = w.half.transpose();
  times_Z(body, frozen, w.turned, w.pulled, w.thin_nodes);
}

void copy_boundary(const SuperelementBody& body, SecondOrderWork& w) {
  const int b = 6 + body.boundary_size;
  w.K_bb = w.K.topLeftCorner(b, b);
  w.K_Ib = w.K.bottomLeftCorner(body.modes, b);
}

void add_frame_stiffness(const SuperelementBody& body, const SuperelementForces<double>& forces, double factor,
                         const SuperelementTangent& frozen, SuperelementWork& work) {
  if (factor == 0.0) return;
  if (body.frame == FrameAlgorithm::polar) return;
  in_space(body.planar, [&]<int D>() {
    add_frame_stiffness<D>(body, frozen, forces.s_B, factor, {work.second.dm, work.second.dc}, work.A_BB);
  });
}

}  // namespace

SecondOrderWork make_second_order_work(const SuperelementBody& body) {
  const Eigen::Index nb = body.boundary_size, m = body.modes, n = nb + m;
  SecondOrderWork w;
  w.K.setZero(6 + n, 6 + n);
  if (body.second_order.stiffening) w.bent.setZero(body.second_order.stiffening->L.rows(), n);
  w.X.setZero(n, 6);
  w.D.setZero(6, n);
  w.momentum.setZero(6, n);
  w.K_bb.setZero(6 + nb, 6 + nb);
  w.K_Ib.setZero(m, 6 + nb);
  w.half.setZero(6 + nb, nb);
  w.turned.setZero(nb, 6 + nb);
  w.pulled.setZero(nb, nb);
  w.thin_boundary.setZero(6 + nb, 6);
  w.thin_nodes.setZero(nb, 6);
  w.thin_internal.setZero(m, 6);
  w.A_IB.setZero(m, nb);
  w.dm.setZero(3, nb);
  w.dc.setZero(3, nb);
  return w;
}

void full_inertia_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients,
                          InternalCoordinates internal, SuperelementScratch& scratch, SuperelementWork& work) {
  SecondOrderWork& w = work.second;
  SuperelementTangent& frozen = scratch.tangent;
  freeze_frame(scratch.motion, coefficients, frozen);
  frozen.dense_coupling = true;
  assemble_full_inertia(body, scratch.forces, coefficients, w);
  copy_boundary(body, w);
  if (body.modes > 0) {
    times_Z(body, frozen, w.K_Ib, frozen.A_IB, w.thin_internal);
    frozen.A_BI = frozen.A_IB.transpose();
  }
  if (body.modes > 0 && internal == InternalCoordinates::eliminated) {
    frozen.internal.factor_symmetric(w.K.bottomRightCorner(body.modes, body.modes));
    frozen.internal.subtract_schur(w.K_Ib, w.K_bb);
  }
  pull_back_boundary(body, frozen, work);
  work.A_BB = w.pulled;
  add_frame_stiffness(body, scratch.forces, coefficients.stiffness, frozen, work);
}

void add_stiffening_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients,
                            InternalCoordinates internal, SuperelementScratch& scratch, SuperelementWork& work) {
  SecondOrderWork& w = work.second;
  SuperelementTangent& frozen = scratch.tangent;
  const int m = body.modes;
  assemble_stiffening(body, scratch.forces, coefficients, w);
  copy_boundary(body, w);
  if (m > 0) {
    times_Z(body, frozen, w.K_Ib, w.A_IB, w.thin_internal);
    frozen.A_IB += w.A_IB;
    frozen.A_BI += w.A_IB.transpose();
    auto II = w.K.bottomRightCorner(m, m);
    II.diagonal().array() += coefficients.mass;
    II.diagonal() += coefficients.stiffness * body.S_II + coefficients.damping * body.damping.internal;
    if (body.damping.is_full()) II += coefficients.damping * body.damping.II;
    if (internal == InternalCoordinates::eliminated) frozen.internal.factor_symmetric(II);
  }
  pull_back_boundary(body, frozen, work);
  work.A_BB += w.pulled;
  add_frame_stiffness(body, scratch.forces, coefficients.stiffness, frozen, work);
}

}  // namespace tisserand::mechanism
