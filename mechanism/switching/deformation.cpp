// Coordinates of the frame, one node after the other.
#include "mechanism/switching/deformation.hpp"

#include <algorithm>

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

/// Before a motion of the frame by a = [d; θ] in its axes and after it, where a has that rate.
FrameMotion moved(const FrameMotion& before, const Vector6d& a, const Vector6d& rate) {
  const Vector3d d = a.head<3>(), theta = a.tail<3>();
  const Matrix3d turn = exp_so3<double>(theta);
  return {before.x + before.R * d, before.xd + before.R * (rate.head<3>() + before.Omega.cross(d)), before.R * turn,
          turn.transpose() * before.Omega + tangent_so3<double>(theta) * rate.tail<3>()};
}

void place_modal_body(const Model& model, const ModalBody& body, const Deformation& deformation,
                      const FrameMotion& frame, State& state) {
  const Node& node = model.nodes[body.node];
  state.x().col(body.node) = frame.x;
  state.Q().col(body.node) = wxyz(Eigen::Quaterniond(frame.R).normalized());
  state.v().segment<3>(node.translation) = frame.xd;
  state.v().segment<3>(node.rotation) = frame.Omega;
  state.w().segment(body.offset, body.modes) = deformation.y.tail(body.modes);
  state.v().segment(model.sizes.first_modal() + body.offset, body.modes) = deformation.rate.tail(body.modes);
}

}  // namespace

const std::string& name_of(const Model& model, std::size_t index) {
  const int modal = modal_body_of(model, index);
  return modal < 0 ? model.superelements[index].name : model.modal_bodies[modal].name;
}

std::size_t deforming_body(const Model& model, const std::string& name) {
  std::size_t index = 0;
  while (index < deforming_bodies(model) && name_of(model, index) != name) ++index;
  return index;
}

Eigen::Index deformation_size(const Model& model, std::size_t index) {
  const int modal = modal_body_of(model, index);
  if (modal >= 0) return 6 + model.modal_bodies[modal].modes;
  return body_of(model, index).boundary_size + body_of(model, index).modes;
}

VectorXd y_of(const Model& model, std::size_t index, const Evaluation& now) {
  VectorXd y = VectorXd::Zero(deformation_size(model, index));
  if (const int modal = modal_body_of(model, index); modal >= 0)
    y.tail(y.size() - 6) = now.modal_bodies[modal].w;
  else
    y << now.superelements[index].motion.y_B, now.superelements[index].motion.y_I;
  return y;
}

Deformation deformation_of(const Model& model, std::size_t index, const Evaluation& now) {
  Deformation deformation{y_of(model, index, now), VectorXd::Zero(deformation_size(model, index))};
  if (const int modal = modal_body_of(model, index); modal >= 0) {
    deformation.rate.tail(deformation.rate.size() - 6) = now.modal_bodies[modal].wd;
    return deformation;
  }
  LocalMotion<double> motion = now.superelements[index].motion;
  deformation_rates(body_of(model, index), nodes_of(model, index, now), motion);
  deformation.rate << motion.deformation_rate_B, motion.rate_I;
  return deformation;
}

FrameMotion frame_motion_of(const Model& model, std::size_t index, const Evaluation& now) {
  if (const int modal = modal_body_of(model, index); modal >= 0) {
    const NodeMotion& node = motion_of(now, model.modal_bodies[modal].node);
    return {node.x, node.xd, node.R, node.Omega};
  }
  const SuperelementBody& body = body_of(model, index);
  const LocalMotion<double>& motion = now.superelements[index].motion;
  Vector3d xd = Vector3d::Zero();
  for (const int j : body.translation_nodes) xd += body.node[j].alpha * motion.node[j].xd;
  return {motion.x0, motion.R0 * xd, motion.R0, motion.Omega0};
}

FrameMotion move_frame(const Model& model, std::size_t index, const Evaluation& undeformed, Deformation& deformation) {
  const FrameMotion before = frame_motion_of(model, index, undeformed);
  if (modal_body_of(model, index) >= 0) {
    const Vector6d a = deformation.y.head<6>(), rate = deformation.rate.head<6>();
    deformation.y.head<6>().setZero();
    deformation.rate.head<6>().setZero();
    return moved(before, a, rate);
  }
  const SuperelementBody& body = body_of(model, index);
  const LocalMotion<double>& motion = undeformed.superelements[index].motion;
  const Vector6d a = motion_of_frame(body, motion, deformation.y),
                 rate = motion_of_frame(body, motion, deformation.rate);
  const Eigen::MatrixXd rigid = rigid_columns(body);
  deformation.y -= rigid * a;
  deformation.rate -= rigid * rate;
  return moved(before, a, rate);
}

void place_deformed(const Model& model, std::size_t index, const Deformation& deformation, const FrameMotion& frame,
                    State& state) {
  if (const int modal = modal_body_of(model, index); modal >= 0)
    return place_modal_body(model, model.modal_bodies[modal], deformation, frame, state);
  const SuperelementBody& body = body_of(model, index);
  const SuperelementUse& use = model.superelements[index];
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
  const int at = model.internal_offset[index];
  state.y().segment(at, body.modes) = deformation.y.tail(body.modes);
  state.v().segment(model.sizes.boundary + at, body.modes) = deformation.rate.tail(body.modes);
}

bool rests_inside(const Model& model, std::size_t index, const State& state) {
  const int modal = modal_body_of(model, index);
  if (modal < 0) {
    const int at = model.internal_offset[index], count = body_of(model, index).modes;
    return count > 0 && state.y().segment(at, count).isZero(0.0) &&
           state.v().segment(model.sizes.boundary + at, count).isZero(0.0);
  }
  return true;  // bend and rate of a modal body tell
}

double largest_speed(const Model& model, const State& state) {
  double largest = 0.0;
  for (const Node& node : model.nodes)
    if (node.translation >= 0) largest = std::max(largest, state.v().segment<3>(node.translation).norm());
  return largest;
}

}  // namespace tisserand::mechanism
