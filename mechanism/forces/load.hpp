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

/// Constant part of a load; its time functions are in the workspace because they own a parser.
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

/// Generalised force on the carrier node [force world; moment material] for the components `value` in the load's axes.
Vector6d load_force(const Load& load, const NodeMotion& node, const Eigen::Vector3d& value);

/// Derivative ∂(generalised force)/∂(x, Θ material).
Matrix6d load_stiffness(const Load& load, const NodeMotion& node, const Eigen::Vector3d& value);

}  // namespace tisserand::mechanism
