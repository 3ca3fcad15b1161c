// Loads of rigid accelerations and of spin, and their static answers.
#include "reducer/second_order/inertia_loads.hpp"

#include "common/parallel.hpp"
#include "formats/companion/companion.hpp"
#include "reducer/second_order/inertia.hpp"

namespace tisserand::reducer {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd inertia_loads(const MatrixXd& MD) {
  MatrixXd g(MD.rows(), inertial);
  g.leftCols<6>() = MD;
  const MatrixXd turning = MD.rightCols<3>();
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    g.col(6 + pair) = -0.5 * (crossed(k, turning.col(j)) + crossed(j, turning.col(k)));
  }
  return g;
}

MatrixXd residual_displacements(const InternalProblem& problem, const InternalModes& internal, const MatrixXd& force) {
  MatrixXd w = MatrixXd::Zero(force.rows(), force.cols());
  if (problem.partition.n_I() == 0) return w;
  const MatrixXd f_I = rows(force, problem.partition.internal);
  MatrixXd w_I = problem.S_II.solve(f_I);
  w_I -= internal.Phi * (internal.lambda.cwiseInverse().asDiagonal() * (internal.Phi.transpose() * f_I));
  for (std::size_t i = 0; i < problem.partition.internal.size(); ++i)
    w.row(problem.partition.internal[i]) = w_I.row(static_cast<Index>(i));
  return w;
}

InertiaAnswers inertia_answers(const InternalProblem& problem, const InternalModes& internal,
                               const Eigen::Vector3d& reference_point) {
  const System& system = problem.system;
  InertiaAnswers answers{reference_point, {}, MatrixXd::Zero(internal.lambda.size(), inertial)};
  const Index auxiliary = expand(system.T, MatrixXd::Zero(system.size(), 1)).rows();
  MatrixXd D = MatrixXd::Zero(auxiliary, 6);
  D.topRows(system.coordinates.count()) = rigid_motions(problem.mesh, system.coordinates, reference_point);
  const FrameInertia inertia = frame_inertia(problem.mesh, system.coordinates, MatrixXd(auxiliary, 0), D, core_count());
  const MatrixXd g = gather(system.T, inertia_loads(inertia.MD));
  answers.x = expand(system.T, residual_displacements(problem, internal, g));
  if (problem.partition.n_I() > 0) answers.share = internal.Phi.transpose() * rows(g, problem.partition.internal);
  return answers;
}

}  // namespace tisserand::reducer
