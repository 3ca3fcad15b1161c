// SPDX-License-Identifier: GPL-3.0-or-later
// Patch test of the shell elements on the mesh of MacNeal and Harder ([MH85]): how far a constant state is missed.
#pragma once

#include <Eigen/Core>

#include "reducer/properties/shell_section.hpp"
#include "tests/support/meshes/shell_mesh.hpp"

namespace tisserand::reducer {

/// Constant membrane strain and curvature of the middle surface in part axes x, y (engineering shear).
struct PatchState {
  Eigen::Vector3d epsilon = Eigen::Vector3d::Zero();
  Eigen::Vector3d kappa = Eigen::Vector3d::Zero();
};

struct ShellPatch {
  Facets facets = Facets::quadrilaterals;
  ShellSection section;
  double offset = 0.0;  ///< of the middle surface from the nodes
  PatchState state;
};

/// The states of [MH85]: εx = εy = γ = 1e-3, and κ = -1e-3 likewise.
PatchState patch_membrane();
PatchState patch_bending();

struct PatchErrors {
  double motion = 0.0;  ///< largest error of displacements and rotations, over the largest of them
  double energy = 0.0;  ///< relative
};

/// The motion of the four outer nodes is prescribed; the patch is turned by the rotation vector `turn`.
PatchErrors patch_errors(const ShellPatch& patch, const Eigen::Vector3d& turn);

}  // namespace tisserand::reducer
