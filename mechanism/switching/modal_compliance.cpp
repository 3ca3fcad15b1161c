// SPDX-License-Identifier: GPL-3.0-or-later
// Mass of the frame and of the modes at rest; displacements and rotations of the nodes.
#include "mechanism/switching/modal_compliance.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

RigidPart rigid_part(const ModalBody& body) {
  const VectorXd rest = VectorXd::Zero(body.modes);
  ModalScratch scratch = make_scratch(body);
  update_kinematics(body, NodeMotion{}, {rest.data(), rest.data(), rest.data()}, Vector3d::Zero(), scratch);
  const Matrix3d lever = skew<double>(scratch.c);
  RigidPart rigid;
  rigid.mass << body.mass * Matrix3d::Identity(), -lever, lever, scratch.J;
  rigid.coupling.resize(6, body.modes);
  rigid.coupling << body.C1, scratch.N;
  rigid.part = rigid.mass.completeOrthogonalDecomposition().solve(rigid.coupling);
  return rigid;
}

ModalCompliance::ModalCompliance(const Model& model, std::size_t modal_body)
    : body_(model.modal_bodies[modal_body]), rigid_(rigid_part(body_)) {
  const Index m = body_.modes;
  std::vector<const ModalNode*> nodes;
  for (const ModalNode& node : model.modal_nodes)
    if (static_cast<std::size_t>(node.body) == modal_body) nodes.push_back(&node);
  move_.resize(3 * static_cast<Index>(nodes.size()), 6 + m);
  turn_.resizeLike(move_);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto row = 3 * static_cast<Index>(k);
    move_.middleRows<3>(row) << Matrix3d::Identity(), -skew<double>(nodes[k]->x), nodes[k]->Xd;
    turn_.middleRows<3>(row) << Matrix3d::Zero(), Matrix3d::Identity(), nodes[k]->Xt;
    x_.push_back(nodes[k]->x);
    if (nodes[k]->active && nodes[k]->turns) held_.push_back(k);
  }
}

VectorXd ModalCompliance::deformation(const VectorXd& load) const {
  VectorXd y = VectorXd::Zero(6 + body_.modes);
  y.tail(body_.modes) = load.tail(body_.modes).cwiseQuotient(body_.stiffness);
  return without_rigid_motion(y);
}

VectorXd ModalCompliance::without_rigid_motion(const VectorXd& y) const {
  VectorXd bent = y;
  bent.head<6>() = -rigid_.part * y.tail(body_.modes);
  return bent;
}

VectorXd ModalCompliance::stiffness(const VectorXd& y) const {
  VectorXd f = VectorXd::Zero(y.size());
  f.tail(body_.modes) = body_.stiffness.cwiseProduct(y.tail(body_.modes));
  return f;
}

VectorXd ModalCompliance::mass(const VectorXd& y) const {
  VectorXd p(y.size());
  p.head<6>() = rigid_.mass * y.head<6>() + rigid_.coupling * y.tail(body_.modes);
  p.tail(body_.modes) = rigid_.coupling.transpose() * y.head<6>() + y.tail(body_.modes);
  return p;
}

double ModalCompliance::displacement(const VectorXd& y) const {
  double largest = 2.0 * std::sqrt(std::max(0.0, kinetic_energy(y)) / body_.mass);  // √2 √(yᵀ M y / m)
  const VectorXd u = move_ * y, theta = turn_ * y;
  for (std::size_t j = 0; j < x_.size(); ++j) {
    const Vector3d seen = u.segment<3>(3 * static_cast<Index>(j));
    largest = std::max(largest, seen.norm());
    for (const std::size_t from : held_) {
      const auto row = 3 * static_cast<Index>(from);
      const Vector3d turn = theta.segment<3>(row), arm = x_[j] - x_[from];
      largest = std::max(largest, (seen - u.segment<3>(row) - turn.cross(arm)).norm());
    }
  }
  return largest;
}

double ModalCompliance::largest_kinetic(const VectorXd& rate) const {
  double largest = kinetic_energy(without_rigid_motion(rate));
  VectorXd seen = rate;
  for (const std::size_t from : held_) {
    const auto row = 3 * static_cast<Index>(from);
    seen.head<6>().setZero();
    seen.tail(body_.modes) = rate.tail(body_.modes);
    const Vector3d turn = turn_.middleRows<3>(row) * seen, u = move_.middleRows<3>(row) * seen;
    seen.head<3>() = -(u - turn.cross(x_[from]));
    seen.segment<3>(3) = -turn;
    largest = std::max(largest, kinetic_energy(seen));
  }
  return largest;
}

double ModalCompliance::force(const VectorXd& y) const {
  const double kinetic = largest_kinetic(y);
  return kinetic > 0.0 ? strain_energy(y) * std::sqrt(2.0 * body_.mass / kinetic) : 0.0;
}

}  // namespace tisserand::mechanism
