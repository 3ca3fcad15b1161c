// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the internal coordinates and the loads. Boundary forces follow by virtual work on the boundary shapes.
#include "reducer/recover/nodal_loads.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "common/error.hpp"
#include "reducer/recover/histories.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::NodalForce;
using formats::Recovery;
using formats::RecoveryField;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Adds 3 rows of forces or moments of some nodes to the rows [from, from + 3) of all nodes.
void put(const VectorXd& values, int first, Index from, NodeForces& all) {
  for (Index i = 0; i < values.size() / 3; ++i) all.col(first + i).segment<3>(from) += values.segment<3>(3 * i);
}

Vector6 resultant(const Eigen::Matrix3Xd& position, const NodeForces& forces) {
  Vector6 sum = Vector6::Zero();
  for (Index n = 0; n < forces.cols(); ++n) {
    sum.head<3>() += forces.col(n).head<3>();
    sum.tail<3>() += forces.col(n).tail<3>() + position.col(n).cross(Vector3d(forces.col(n).head<3>()));
  }
  return sum;
}

Eigen::Matrix3Xd boundary_positions(const Recovery& r) {
  Eigen::Matrix3Xd X(3, static_cast<Index>(r.boundary_node.size()));
  for (Index k = 0; k < X.cols(); ++k) X.col(k) = r.position.col(r.boundary_node[k]);
  return X;
}

}  // namespace

void require_nodal_loads(const formats::RecoveryReader& file, const MotionReader& motion) {
  if (motion.body().is_modal)
    throw Error(fmt::format("body '{}' is a modal body, but --loads works only for superelements, because their forces "
                            "act on boundary nodes",
                            motion.body().name),
                "--loads", "use the superelement of the part in the scene instead");
  const Recovery& r = file.recovery();
  if (!r.loads)
    throw Error("holds no inertia loads, but --loads needs them", file.path(),
                "reduce the part again with `recovery: yes`, but not with method: macneal, which has no inertia loads");
  if (!r.loads->has_forces())
    throw Error("holds no nodal forces, but --loads needs them", file.path(),
                "reduce the part again with `recovery: yes` if the file was written before version 1.2; else replace "
                "the large averaging spider of the part, whose inertia forces cannot be put on nodes");
  if (motion.read(0, 1).load_factor.cols() == 0)
    throw Error(
        "the results do not hold the acceleration of the floating frame, but --loads needs it", "--loads",
        "run the scene again as an analysis with accelerations; results of versions before 1.10 do not hold it");
}

NodalLoads nodal_loads(const formats::RecoveryReader& file, const BodyMotion& motion, Index t) {
  const Recovery& r = file.recovery();
  const Index n = r.coordinates(), m = r.internal(), n_B = n - m, boundary = static_cast<Index>(r.boundary_name.size());
  const VectorXd e = motion.y_strain.col(t), f = motion.load_factor.col(t);
  const VectorXd amplitude = e.tail(m) - (r.loads->share.bottomRows(m) * f).cwiseQuotient(r.loads->stiffness.tail(m));
  NodalLoads loads{NodeForces::Zero(6, boundary), NodeForces::Zero(6, r.nodes()), NodeForces::Zero(6, r.nodes())};
  VectorXd work = VectorXd::Zero(n_B);
  const int block = 8 * formats::chunk_items(r, RecoveryField::translation);
  for (int first = 0; first < r.nodes(); first += block) {
    const int count = std::min(block, r.nodes() - first);
    const auto add = [&](NodalForce of_load, NodalForce of_mode, RecoveryField shape, Index from) {
      const VectorXd frame = file.read_forces(of_load, first, count).cast<double>() * f;
      const VectorXd deformation = file.read_forces(of_mode, first, count).cast<double>() * amplitude;
      put(frame, first, from, loads.frame);
      put(deformation, first, from, loads.deformation);
      work += file.read(shape, first, count).cast<double>().leftCols(n_B).transpose() * (frame + deformation);
    };
    add(NodalForce::load_force, NodalForce::mode_force, RecoveryField::translation, 0);
    add(NodalForce::load_moment, NodalForce::mode_moment, RecoveryField::rotation, 3);
  }
  const VectorXd F = r.loads->boundary_stiffness * e.head(n_B) - work;
  for (Index k = 0; k < n_B; ++k) loads.boundary(r.dof_component[k], r.dof_node[k]) = F[k];
  return loads;
}

LoadBalance load_balance(const Recovery& r, const NodalLoads& loads) {
  const Eigen::Matrix3Xd at_boundary = boundary_positions(r);
  LoadBalance balance;
  balance.boundary = resultant(at_boundary, loads.boundary);
  balance.frame = resultant(r.position, loads.frame);
  balance.deformation = resultant(r.position, loads.deformation);
  balance.sum = balance.boundary + balance.frame + balance.deformation;
  double forces = 0.0, moments = 0.0;
  const auto measure = [&](const Eigen::Matrix3Xd& position, const NodeForces& of) {
    forces += of.topRows<3>().colwise().norm().sum();
    moments += of.bottomRows<3>().colwise().norm().sum();
    for (Index n = 0; n < of.cols(); ++n) moments += position.col(n).norm() * of.col(n).head<3>().norm();
  };
  measure(at_boundary, loads.boundary);
  measure(r.position, loads.frame);
  measure(r.position, loads.deformation);
  if (forces > 0.0) balance.force_error = balance.sum.head<3>().norm() / forces;
  if (moments > 0.0) balance.moment_error = balance.sum.tail<3>().norm() / moments;
  return balance;
}

void compare_with_run(const MotionReader& reader, const BodyMotion& motion, Index instant, const NodalLoads& loads,
                      LoadBalance& balance) {
  if (motion.rotation.cols() == 0 || !motion.rotation.allFinite()) return;
  const formats::ResultsLayout& layout = reader.results().layout();
  if (reader.body().row + 1 >= layout.boundary_offset.size()) return;
  const Index first = layout.boundary_offset[reader.body().row], count = loads.boundary.cols();
  const MatrixXd stored = reader.results().read_dataset("superelements/boundary_force", {reader.rows()[instant]});
  if (stored.cols() < 6 * (first + count) || !stored.allFinite()) return;
  const Eigen::Matrix3d R = frame_axes(motion, RecoverFrame::world, 0);
  balance.compared = true;
  for (Index k = 0; k < count; ++k) {
    const Vector3d world = stored.row(0).segment<3>(6 * (first + k)).transpose();
    const Vector3d of_run = motion.mirror.cwiseProduct(R.transpose() * world) / motion.to_scene.force();
    balance.differs = std::max(balance.differs, (of_run - loads.boundary.col(k).head<3>()).norm());
    balance.largest = std::max(balance.largest, of_run.norm());
  }
}

}  // namespace tisserand::reducer
