// What a body looks like: solids and mesh files that pictures show; no equation knows them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"

namespace tisserand::formats {

enum class ShapeKind { box, cylinder, sphere, cone, tube, mesh };

/// One solid in the part frame of its body, in lengths of the scene. Which members count follows from the kind; a
/// length that was not given is not-a-number.
struct ShapeSpec {
  ShapeKind kind = ShapeKind::box;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the centre of a box or sphere, of the origin of a file
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of a box or file
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                   ///< of a box, along its axes
  double radius = 0.0;      ///< of a cylinder, sphere or tube; of a cone at `from`
  double end_radius = 0.0;  ///< of a cone at `to`
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< axis of a cylinder or cone
  std::vector<Eigen::Vector3d> points;                                           ///< of the axis of a tube
  std::string file;                                 ///< resolved path, .stl, .obj or .recovery.h5
  Units units;                                      ///< of the scene
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of a file, along its axes; negative: mirrored
  std::string where;                                ///< of the body
};

}  // namespace tisserand::formats
