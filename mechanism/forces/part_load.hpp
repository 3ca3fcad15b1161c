// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of companion files: a load case of a superelement times a function of time.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// Constant part of a load; its function of time is in the workspace. A superelement takes the forces of its body
/// (bodies/superelement/forces/load_cases.hpp); a rigid one takes the resultant on its node.
struct PartLoad {
  std::string name;
  int superelement = -1;                             ///< row of Model::superelements, −1: the body is rigid
  int load_case = 0;                                 ///< index in the superelement's body
  int node = -1;                                     ///< node of a rigid body
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< resultant for the factor 1, axes of the part
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< for a rigid body: moment about its node
  formats::TimeFunctionSpec value = 0.0;
  std::string where;
};

}  // namespace tisserand::mechanism
