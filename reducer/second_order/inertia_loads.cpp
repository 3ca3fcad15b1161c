// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of rigid accelerations and of rotation, and their static answers.
#include "reducer/second_order/inertia_loads.hpp"

#include "common/parallel.hpp"
#include "reducer/modes/loose_modes.hpp"
#include "reducer/second_order/inertia.hpp"

namespace tisserand::reducer {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd residual_displacements(const ReducedPart& part, const MatrixXd& force) {
  const InternalModes& internal = part.internal;
  MatrixXd w = MatrixXd::Zero(force.rows(), force.cols());
  if (part.partition.n_I() == 0) return w;
  const MatrixXd f_I = rows(force, part.partition.internal);
  MatrixXd w_I = static_answers(part, internal, f_I);
  const Index elastic = internal.lambda.size() - internal.loose();
  const auto Phi = internal.Phi.rightCols(elastic);
  w_I -= Phi * (internal.lambda.tail(elastic).cwiseInverse().asDiagonal() * (Phi.transpose() * f_I));
  for (std::size_t i = 0; i < part.partition.internal.size(); ++i)
    w.row(part.partition.internal[i]) = w_I.row(static_cast<Index>(i));
  return w;
}

InertiaAnswers inertia_answers(const ReducedPart& part, const Eigen::Vector3d& reference_point) {
  const System& system = part.system;
  const InternalModes& internal = part.internal;
  InertiaAnswers answers{reference_point, {}, MatrixXd::Zero(internal.lambda.size(), inertial_loads), {}};
  const Index rows_of_all = expand(system.T, MatrixXd::Zero(system.size(), 1)).rows();
  const FrameInertia inertia =
      frame_inertia(part.mesh, system.coordinates, MatrixXd(rows_of_all, 0), reference_point, core_count());
  const MatrixXd g = gather(system.T, inertia.load);
  answers.x = expand(system.T, residual_displacements(part, g));
  if (part.partition.n_I() > 0) answers.share = internal.Phi.transpose() * rows(g, part.partition.internal);
  answers.share.topRows(internal.loose()).setZero();
  answers.force = g;
  return answers;
}

}  // namespace tisserand::reducer
