// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::test_support {

using namespace mechanism;
using Eigen::MatrixXd;

namespace {

MatrixXd internal_block(const SuperelementBody& body, const TangentCoefficients& c, const SuperelementWork& work) {
  const int m = body.modes;
  if (body.second_order.any()) return work.second.K.bottomRightCorner(m, m).selfadjointView<Eigen::Lower>();
  MatrixXd A = MatrixXd::Zero(m, m);
  if (body.damping.is_full()) A = c.damping * body.damping.II;
  A.diagonal() += c.stiffness * body.S_II + c.damping * body.damping.internal + Eigen::VectorXd::Constant(m, c.mass);
  return A;
}

}  // namespace

void uncondensed_tangent(const SuperelementBody& body, const SuperelementScratch& scratch,
                         const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const TangentCoefficients& c, TangentKind kind, MatrixXd& A) {
  if (kind == TangentKind::exact) return whole_exact_tangent(body, scratch, nodes, gravity, c, A);
  const int nb = body.boundary_size, m = body.modes;
  SuperelementScratch own = scratch;
  own.tangent.A_BI.setZero(nb, m);
  own.tangent.A_IB.setZero(m, nb);
  SuperelementWork work = make_work(body);
  kept_tangent(body, c, own, work);
  A.resize(nb + m, nb + m);
  A << work.A_BB, own.tangent.A_BI, own.tangent.A_IB, internal_block(body, c, work);
}

}  // namespace tisserand::test_support
