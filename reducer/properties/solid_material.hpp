// SPDX-License-Identifier: GPL-3.0-or-later
// Linear elastic material of a solid.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// Linear elastic material of a solid: σ = C ε in part axes, order [xx yy zz xy yz zx], engineering shear strains.
struct SolidMaterial {
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  double density = 0.0;
};

/// Isotropic solid material from its constants.
SolidMaterial isotropic_solid(double youngs_modulus, double poisson_ratio, double density);

}  // namespace tisserand::reducer
