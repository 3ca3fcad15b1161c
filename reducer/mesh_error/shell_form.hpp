// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of shells on which smooth stresses cannot be found: coarse curves, and folds too close to each other.
#pragma once

#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Properties of the geometry around a shell that make the estimate of the discretisation error unreliable.
struct ShellForm {
  /// true: a coarse curve, where the shell turns by 25 to 75 degrees at two edges or at both ends of a free edge.
  bool turned = false;
  /// true: fewer than three shells across, since the shell and all with a common corner touch a fold.
  bool few_across = false;
  /// true: both curvatures turn the shell by more than 1.5 degrees, the smaller by more than a fifth of the other.
  bool double_curvature = false;
};

std::vector<ShellForm> shell_forms(const Mesh& mesh);

}  // namespace tisserand::reducer
