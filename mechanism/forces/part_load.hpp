// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of companion files: a load case of a superelement times a function of time.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// Load case of a companion file times a function of time: the constant part. The compiled function is in the
/// Evaluation. On a superelement its body computes the forces (bodies/superelement/forces/load_cases.hpp). On a rigid
/// body the resultant acts on the node.
struct PartLoad {
  std::string name;
  int superelement = -1;                             ///< index in Model::superelements; −1: rigid body
  int load_case = 0;                                 ///< index in SuperelementBody::load_cases
  int node = -1;                                     ///< node of a rigid body
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< rigid body: resultant for the factor 1, axes of the part
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< rigid body: moment about its node
  formats::TimeFunctionSpec value = 0.0;
  std::string where;
};

}  // namespace tisserand::mechanism
