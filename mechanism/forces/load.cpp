// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual work of applied forces and moments.
#include "mechanism/forces/load.hpp"

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;
using formats::LoadAxes;
using formats::LoadKind;

/// Components in node axes of a load given in world axes.
Vector3d in_node_axes(const Load& load, const NodeMotion& node, const Vector3d& value) {
  return node.R.transpose() * (load.turn ? Vector3d(*load.turn * value) : value);
}

}  // namespace

Vector6d load_force(const Load& load, const NodeMotion& node, const Vector3d& value) {
  // `material`: the load in node axes.
  const Vector3d material = load.axes == LoadAxes::body ? Vector3d(load.at.R * value) : in_node_axes(load, node, value);
  Vector6d force = Vector6d::Zero();
  if (load.kind == LoadKind::force) {
    force.head<3>() = node.R * material;
    force.tail<3>() = load.at.p.cross(material);
  } else {
    force.tail<3>() = material;
  }
  return force;
}

Matrix6d load_stiffness(const Load& load, const NodeMotion& node, const Vector3d& value) {
  Matrix6d K = Matrix6d::Zero();
  if (load.axes == LoadAxes::world) {
    // δ(Rᵀ f) = (Rᵀ f)~ δΘ
    const Eigen::Matrix3d change = skew<double>(in_node_axes(load, node, value));
    if (load.kind == LoadKind::force)
      K.block<3, 3>(3, 3) = skew<double>(load.at.p) * change;
    else
      K.block<3, 3>(3, 3) = change;
  } else if (load.kind == LoadKind::force) {
    // δ(R f) = −R f~ δΘ
    K.block<3, 3>(0, 3) = -node.R * skew<double>(load.at.R * value);
  }
  return K;
}

}  // namespace tisserand::mechanism
