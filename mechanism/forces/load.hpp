// SPDX-License-Identifier: GPL-3.0-or-later
// Forces and moments applied at a marker, as functions of time, in world axes or following the marker.
#pragma once

#include <array>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/forces/time_function.hpp"
#include "mechanism/frames/marker.hpp"

namespace tisserand::mechanism {

/// Force or moment on a marker: the constant part. Its compiled time functions are in the Evaluation, because they own
/// a parser.
struct Load {
  std::string name;
  formats::LoadKind kind = formats::LoadKind::force;
  formats::LoadAxes axes = formats::LoadAxes::world;
  Marker at;
  std::array<formats::TimeFunctionSpec, 3> components;
  std::optional<Eigen::Matrix3d> turn;  ///< rotation from world axes to those of a planar model
  std::string where;
};

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Generalised force of a load on the node of its marker: [force (world axes); moment (axes of the node)]. `value`:
/// components in the axes of the load.
Vector6d load_force(const Load& load, const NodeMotion& node, const Eigen::Vector3d& value);

/// Derivative of load_force() by the position and the material rotation of the node (6 x 6).
Matrix6d load_stiffness(const Load& load, const NodeMotion& node, const Eigen::Vector3d& value);

}  // namespace tisserand::mechanism
