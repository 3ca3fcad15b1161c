// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of shells on which smooth stresses cannot be found: coarse curves, and folds too close to each other.
#pragma once

#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

struct ShellForm {
  bool turned = false;      ///< at two edges, or both ends of a free edge, by 25 to 75 degrees: a coarse curve
  bool few_across = false;  ///< the shell and all with a common corner touch a fold: fewer than three across
  bool double_curvature =
      false;  ///< both curvatures turn it by more than 1.5 degrees, the smaller by more than a fifth of the other
};

std::vector<ShellForm> shell_forms(const Mesh& mesh);

}  // namespace tisserand::reducer
