// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic matrices of solids with material axes: C in part axes from the constants of a deck.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reducer/properties/solid_material.hpp"

namespace tisserand::reducer {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Engineering constants of an orthotropic solid in material axes 1, 2, 3. nu_ij = −ε_j/ε_i under σ_i alone, so
/// nu_ij/E_i = nu_ji/E_j.
struct OrthotropicConstants {
  double E1 = 0.0, E2 = 0.0, E3 = 0.0;
  double nu12 = 0.0, nu13 = 0.0, nu23 = 0.0;
  double G12 = 0.0, G23 = 0.0, G31 = 0.0;
};

/// Elasticity C of an orthotropic solid in material axes, order [11 22 33 12 23 31], engineering shear strains. Throws
/// Error unless C is positive definite. `where`: place of the constants in the input.
Matrix6 orthotropic_elasticity(const OrthotropicConstants& constants, const std::string& where);

/// Elasticity in part axes of a material with the elasticity `C_M` in axes M: C = Tᵀ C_M T. T maps strains, ε_M =
/// R_PMᵀ ε_P R_PM. The columns of `R_PM` are the axes M in part axes.
Matrix6 rotated_elasticity(const Matrix6& C_M, const Eigen::Matrix3d& R_PM);

/// Solid material with the 21 constants `C_M`, in the order [xx yy zz xy yz zx] of axes M. The columns of `R_PM` are
/// the axes M in part axes. Throws Error unless C_M is symmetric and positive definite. `where`: place of the
/// constants in the input.
SolidMaterial anisotropic_solid(const Matrix6& C_M, const Eigen::Matrix3d& R_PM, double density,
                                const std::string& where);

}  // namespace tisserand::reducer
