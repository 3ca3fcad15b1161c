// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of nodes of modal bodies, with derivatives.
#include "mechanism/bodies/modal/node.hpp"

#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Derivative ∂(T(θ) h)/∂θ = c h~ + (−c₁ θ~ h + d₁ θ~² h) θᵀ − d [(θ~ h)~ + θ~ h~]. c₁ and d₁ are the derivatives of c
/// and d divided by the angle.
Matrix3d tangent_derivative(const Vector3d& theta, const Vector3d& h) {
  const double a2 = theta.squaredNorm();
  const AngleFunctions<double> f(a2);
  double c1, d1;
  if (a2 < 1e-2) {
    c1 = -1.0 / 12.0 + a2 * (1.0 / 180.0 - a2 * (1.0 / 6720.0 - a2 / 453600.0));
    d1 = -1.0 / 60.0 + a2 * (1.0 / 1260.0 - a2 * (1.0 / 60480.0 - a2 / 4989600.0));
  } else {
    c1 = (f.s - 2.0 * f.c) / a2;
    d1 = (f.c - 3.0 * f.d) / a2;
  }
  const Vector3d turned = theta.cross(h);
  return f.c * skew<double>(h) + (d1 * theta.cross(turned) - c1 * turned) * theta.transpose() -
         f.d * (skew<double>(turned) + skew<double>(theta) * skew<double>(h));
}

}  // namespace

ModalNodeTerms make_terms(const ModalNode& node) {
  ModalNodeTerms terms;
  for (Vector3d* v : {&terms.b, &terms.theta, &terms.rate, &terms.om}) v->setZero();
  for (Matrix3d* M : {&terms.A, &terms.E, &terms.L}) M->setIdentity();
  terms.T.setZero(6, 6 + node.Xd.cols());
  terms.T.leftCols<3>().topRows<3>().setIdentity();
  terms.bias.setZero();
  return terms;
}

template <int D>
void update_node(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                 ModalNodeTerms& t) {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  using Vector = VectorOf<D>;
  using Turns = TurnOf<D>;
  const Eigen::Matrix<double, D, D> A = frame.R.topLeftCorner<D, D>();
  Vector b = node.x.head<D>(), moved = Vector::Zero(), pushed = Vector::Zero();
  Turns theta = Turns::Zero(), rate = Turns::Zero(), second = Turns::Zero();  // θ, θ̇, θ̈
  for (Index j = 0; j < node.Xd.cols(); ++j) {
    const Vector X = node.Xd.col(j).head<D>();
    const Turns turned = node.Xt.col(j).tail<turns>();
    b += X * body.w[j];
    moved += X * body.wd[j];
    pushed += X * body.wdd[j];
    theta += turned * body.w[j];
    rate += turned * body.wd[j];
    second += turned * body.wdd[j];
    t.T.col(6 + j).head<D>() = A * X;
    t.T.col(6 + j).segment<turns>(turn) = turned;
  }
  const Turns om = frame.Omega.tail<turns>(), omd = frame.Omegad.tail<turns>();
  t.b.head<D>() = b;
  t.theta.tail<turns>() = theta;
  t.rate.tail<turns>() = rate;
  t.om.tail<turns>() = om;
  t.A = frame.R;
  Space<D>::set_exponential(t.theta, t.E);
  t.T.block<D, turns>(0, turn) = A * Space<D>::turning(b);
  t.T.block<turns, turns>(turn, turn) = Space<D>::material_map(t.E);
  const Turns carried = Space<D>::material(t.E, om);
  t.bias.head<D>() = A * Space<D>::across(om, Space<D>::across(om, b) + 2.0 * moved);
  if constexpr (D == 3) {  // in the plane rotations simply add
    const Matrix3d T = tangent_so3<double>(theta);
    t.L = T.transpose();
    for (Index j = 0; j < node.Xd.cols(); ++j) t.T.col(6 + j).tail<3>() = T * node.Xt.col(j);
    t.bias.tail<3>() = carried.cross(T * rate) + tangent_derivative(theta, rate) * rate;
    rate = (T * rate).eval();
    second = (T * second).eval();
  }

  motion.x = frame.x;
  motion.x.head<D>() += A * b;
  motion.R.topLeftCorner<D, D>() = A * t.E.topLeftCorner<D, D>();
  motion.xd.head<D>() = frame.xd.head<D>() + A * (Space<D>::across(om, b) + moved);
  motion.Omega.tail<turns>() = carried + rate;
  motion.xdd.head<D>() = frame.xdd.head<D>() + A * (Space<D>::across(omd, b) + pushed) + t.bias.head<D>();
  motion.Omegad.tail<turns>() = Space<D>::material(t.E, omd) + second + t.bias.tail<turns>();
}
template void update_node<2>(const ModalNode&, const ModalScratch&, const NodeMotion&, NodeMotion&, ModalNodeTerms&);
template void update_node<3>(const ModalNode&, const ModalScratch&, const NodeMotion&, NodeMotion&, ModalNodeTerms&);

void rate_gradient(const ModalNode& node, const ModalScratch& body, const ModalNodeTerms& t,
                   Eigen::Ref<Eigen::MatrixXd> Z) {
  const Vector3d velocity = t.om.cross(t.b) + node.Xd.lazyProduct(body.wd);
  const Vector3d carried = t.E.transpose() * t.om;
  // δ(Eᵀ ω) = (Eᵀ ω)~ T δθ
  const Matrix3d turn = skew<double>(carried) * t.L.transpose() + tangent_derivative(t.theta, t.rate);
  Z.setZero();
  Z.block<3, 3>(0, 3) = -t.A * skew<double>(velocity);
  for (Index j = 0; j < node.Xd.cols(); ++j) {
    Z.col(6 + j).head<3>() = t.A * t.om.cross(node.Xd.col(j));
    Z.col(6 + j).tail<3>() = turn * node.Xt.col(j);
  }
}

void add_geometric_stiffness(const ModalNode& node, const ModalNodeTerms& t, const Eigen::Matrix<double, 6, 1>& force,
                             Eigen::Ref<Eigen::MatrixXd> K) {
  const Index m = node.Xd.cols();
  const Vector3d g = t.A.transpose() * force.head<3>(), h = t.E * force.tail<3>();
  const Matrix3d g_skew = skew<double>(g);
  K.block<3, 3>(3, 3) += skew<double>(t.b) * g_skew;
  // Derivative of the modal moments Xtᵀ Lᵀ h: L depends on θ, and h turns with the node.
  const Matrix3d L_h = tangent_derivative(t.theta, h) - t.L.transpose() * skew<double>(h) * t.L;
  for (Index i = 0; i < m; ++i) {
    const Vector3d turned = t.L * node.Xt.col(i), bent = L_h * node.Xt.col(i);
    K.col(6 + i).segment<3>(3) -= g_skew * node.Xd.col(i) + h.cross(turned);
    K.row(6 + i).segment<3>(3) += node.Xd.col(i).transpose() * g_skew;
    for (Index j = 0; j < m; ++j) K(6 + j, 6 + i) += node.Xt.col(j).dot(bent);
  }
}

}  // namespace tisserand::mechanism
