// SPDX-License-Identifier: GPL-3.0-or-later
// Visible shape of a body: solids and mesh files for pictures, without influence on equations.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"

namespace tisserand::formats {

enum class ShapeKind { box, cylinder, sphere, cone, tube, mesh };

/// One visible solid in the part frame of its body, in lengths of the scene. `kind` determines which members apply. A
/// length that is not given is NaN.
struct ShapeSpec {
  ShapeKind kind = ShapeKind::box;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< centre of a box or sphere, origin of a file
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< for a box or file
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                   ///< for a box, along its axes
  double radius = 0.0;      ///< for a cylinder, sphere or tube; for a cone at `from`
  double end_radius = 0.0;  ///< for a cone at `to`
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< axis of a cylinder or cone
  std::vector<Eigen::Vector3d> points;                                           ///< axis of a tube
  std::string file;                                 ///< resolved path, .stl, .obj or .recovery.h5
  Units units;                                      ///< units of the scene
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< for a file, along its axes; negative: mirrored
  std::string where;                                ///< place of the body
};

}  // namespace tisserand::formats
