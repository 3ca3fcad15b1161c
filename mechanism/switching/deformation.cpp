// Coordinates of the frame, one node after the other.
#include "mechanism/switching/deformation.hpp"

#include "common/math/rotation.hpp"
#include "mechanism/bodies/superelement/kinematics.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// [d; θ] of the frame, in its axes, where the coordinates of an undeformed body change by y.
Vector6d motion_of_frame(const SuperelementBody& body, const LocalMotion<double>& undeformed, const VectorXd& y) {
  Vector6d a = Vector6d::Zero();
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const SuperelementNode& node = body.node[j];
    const LocalNode<double>& local = undeformed.node[j];
    if (node.has_translation()) {
      const Vector3d u = y.segment<3>(node.translation_row);
      a.head<3>() += node.alpha * u;
      a.tail<3>() += local.U_x * (undeformed.R0 * u);
    }
    if (node.has_rotation()) a.tail<3>() += local.U * y.segment<3>(node.rotation_row);
  }
  return a;
}

}  // namespace

Deformation deformation_of(const Model& model, std::size_t superelement, const Evaluation& now) {
  const SuperelementBody& body = body_of(model, superelement);
  LocalMotion<double> motion = now.superelements[superelement].motion;
  deformation_rates(body, nodes_of(model, superelement, now), motion);
  Deformation deformation{VectorXd(body.boundary_size + body.modes), VectorXd(body.boundary_size + body.modes)};
  deformation.y << motion.y_B, motion.y_I;
  deformation.rate << motion.deformation_rate_B, motion.rate_I;
  return deformation;
}

FrameMotion frame_motion_of(const Model& model, std::size_t superelement, const Evaluation& now) {
  const SuperelementBody& body = body_of(model, superelement);
  const LocalMotion<double>& motion = now.superelements[superelement].motion;
  Vector3d xd = Vector3d::Zero();
  for (const int j : body.translation_nodes) xd += body.node[j].alpha * motion.node[j].xd;
  return {motion.x0, motion.R0 * xd, motion.R0, motion.Omega0};
}

FrameMotion move_frame(const Model& model, std::size_t superelement, const Evaluation& undeformed,
                       Deformation& deformation) {
  const SuperelementBody& body = body_of(model, superelement);
  const LocalMotion<double>& motion = undeformed.superelements[superelement].motion;
  const Vector6d a = motion_of_frame(body, motion, deformation.y),
                 rate = motion_of_frame(body, motion, deformation.rate);
  const Eigen::MatrixXd rigid = rigid_columns(body);
  deformation.y -= rigid * a;
  deformation.rate -= rigid * rate;
  const FrameMotion before = frame_motion_of(model, superelement, undeformed);
  const Vector3d d = a.head<3>(), theta = a.tail<3>();
  const Matrix3d turn = exp_so3<double>(theta);
  return {before.x + before.R * d, before.xd + before.R * (rate.head<3>() + before.Omega.cross(d)), before.R * turn,
          turn.transpose() * before.Omega + tangent_so3<double>(theta) * rate.tail<3>()};
}

void place_deformed(const Model& model, std::size_t superelement, const Deformation& deformation,
                    const FrameMotion& frame, State& state) {
  const SuperelementBody& body = body_of(model, superelement);
  const SuperelementUse& use = model.superelements[superelement];
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const SuperelementNode& local = body.node[j];
    const Node& node = model.nodes[use.nodes[j]];
    if (local.has_translation()) {
      const Vector3d place = local.X + deformation.y.segment<3>(local.translation_row);
      const Vector3d rate = deformation.rate.segment<3>(local.translation_row);
      state.x().col(use.nodes[j]) = frame.x + frame.R * place;
      state.v().segment<3>(node.translation) = frame.xd + frame.R * (frame.Omega.cross(place) + rate);
    }
    if (local.has_rotation()) {
      const Vector3d psi = deformation.y.segment<3>(local.rotation_row);
      const Vector3d rate = deformation.rate.segment<3>(local.rotation_row);
      const Matrix3d E = exp_so3<double>(psi);
      state.Q().col(use.nodes[j]) = wxyz(Eigen::Quaterniond(Matrix3d(frame.R * E)).normalized());
      state.v().segment<3>(node.rotation) = E.transpose() * frame.Omega + tangent_so3<double>(psi) * rate;
    }
  }
  const int at = model.internal_offset[superelement];
  state.y().segment(at, body.modes) = deformation.y.tail(body.modes);
  state.v().segment(model.sizes.boundary + at, body.modes) = deformation.rate.tail(body.modes);
}

}  // namespace tisserand::mechanism
