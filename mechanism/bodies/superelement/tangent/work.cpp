// SPDX-License-Identifier: GPL-3.0-or-later
// Allocation of the stored data and work matrices of a superelement body.
#include "mechanism/bodies/superelement/tangent/work.hpp"

#include "mechanism/bodies/superelement/tangent/coupling.hpp"
#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"

namespace tisserand::mechanism {

SuperelementScratch make_scratch(const SuperelementBody& body) {
  SuperelementScratch scratch;
  scratch.motion = make_local_motion<double>(body);
  scratch.forces = make_forces<double>(body);
  scratch.R0_reference.setIdentity();
  SuperelementTangent& tangent = scratch.tangent;
  tangent.internal.set_diagonal(Eigen::VectorXd::Ones(body.modes));
  tangent.R0.setIdentity();
  tangent.Omega0.setZero();
  tangent.node = scratch.motion.node;
  tangent.U.setZero(3, body.boundary_size);
  if (body.damping.is_full() || body.second_order.any()) tangent.internal.resize(body.modes);
  if (has_stored_coupling(body)) {
    tangent.A_BI.setZero(body.boundary_size, body.modes);
    tangent.A_IB.setZero(body.modes, body.boundary_size);
  }
  return scratch;
}

SuperelementWork make_work(const SuperelementBody& body) {
  const Eigen::Index nb = body.boundary_size, m = body.modes;
  SuperelementWork work;
  work.internal.set_diagonal(Eigen::VectorXd::Ones(m));
  if (body.damping.is_full() && !body.second_order.any()) work.internal.resize(m);
  for (Eigen::MatrixXd* matrix : {&work.Q, &work.N, &work.A_BB, &work.Np, &work.G1, &work.G2}) matrix->setZero(nb, nb);
  for (Eigen::Matrix<double, Eigen::Dynamic, 3>* matrix : {&work.J, &work.F, &work.V1}) matrix->setZero(nb, 3);
  for (Eigen::VectorXd* vector : {&work.r_B_condensed, &work.column, &work.turned}) vector->setZero(nb);
  work.internal_column.setZero(m);
  if (body.planar) work.planar_columns.setZero(nb, 16);
  if (body.damping.is_full()) {
    work.K.setZero(nb, nb);
    work.A_II.setZero(m, m);
  }
  if (has_stored_coupling(body)) work.eliminated.setZero(m, nb);
  if (body.inertia == formats::InertiaOption::M) {
    CenterWork& c = work.center;
    for (Eigen::Matrix<double, Eigen::Dynamic, 3>* matrix : {&c.w, &c.g, &c.z, &c.J, &c.F}) matrix->setZero(nb, 3);
  }
  if (body.second_order.any()) work.second = make_second_order_work(body);
  return work;
}

}  // namespace tisserand::mechanism
