// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic matrices of solids in part axes: isotropic, orthotropic and fully anisotropic materials.
#include "reducer/properties/solid_material.hpp"

#include <array>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "common/error.hpp"
#include "reducer/properties/solid_anisotropic.hpp"

namespace tisserand::reducer {
namespace {

/// Tensor indices of the six strains [xx yy zz xy yz zx].
constexpr std::array<std::array<int, 2>, 6> tensor_index{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

}  // namespace

SolidMaterial isotropic_solid(double youngs_modulus, double poisson_ratio, double density) {
  const double G = 0.5 * youngs_modulus / (1.0 + poisson_ratio);
  const double lambda = youngs_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
  SolidMaterial material;
  material.C.topLeftCorner<3, 3>().setConstant(lambda);
  material.C.diagonal() << Eigen::Vector3d::Constant(lambda + 2.0 * G), Eigen::Vector3d::Constant(G);
  material.density = density;
  return material;
}

Matrix6 orthotropic_elasticity(const OrthotropicConstants& constants, const std::string& where) {
  const auto& [E1, E2, E3, nu12, nu13, nu23, G12, G23, G31] = constants;
  if (!(E1 > 0.0 && E2 > 0.0 && E3 > 0.0 && G12 > 0.0 && G23 > 0.0 && G31 > 0.0))
    throw Error(fmt::format("orthotropic material: moduli E = {:.6g}, {:.6g}, {:.6g}, G12, G23, G31 = {:.6g}, {:.6g}, "
                            "{:.6g} are not all positive",
                            E1, E2, E3, G12, G23, G31),
                where, "give six positive moduli");
  Eigen::Matrix3d normal;
  normal << 1.0 / E1, -nu12 / E1, -nu13 / E1,  //
      -nu12 / E1, 1.0 / E2, -nu23 / E2,        //
      -nu13 / E1, -nu23 / E2, 1.0 / E3;
  const Eigen::LLT<Eigen::Matrix3d> factors(normal);
  if (factors.info() != Eigen::Success)
    throw Error(fmt::format("orthotropic material: Poisson's ratios nu12, nu13, nu23 = {:.6g}, {:.6g}, {:.6g} are not "
                            "consistent with E = {:.6g}, {:.6g}, {:.6g}: some strain would have negative energy",
                            nu12, nu13, nu23, E1, E2, E3),
                where, "check which of the two ratios you gave: nu_ij/E_i = nu_ji/E_j");
  Matrix6 C = Matrix6::Zero();
  C.topLeftCorner<3, 3>() = factors.solve(Eigen::Matrix3d::Identity());
  C.topLeftCorner<3, 3>() = (0.5 * (C.topLeftCorner<3, 3>() + C.topLeftCorner<3, 3>().transpose())).eval();
  C.diagonal().tail<3>() << G12, G23, G31;
  return C;
}

Matrix6 rotated_elasticity(const Matrix6& C_M, const Eigen::Matrix3d& R_PM) {
  Matrix6 T;  // strains in material axes from strains in part axes: ε_M = R_PMᵀ ε_P R_PM
  for (int j = 0; j < 6; ++j) {
    const auto [a, b] = tensor_index[j];
    for (int i = 0; i < 6; ++i) {
      const auto [c, d] = tensor_index[i];
      const double mixed = R_PM(a, c) * R_PM(b, d) + R_PM(b, c) * R_PM(a, d);
      T(i, j) = i < 3 ? 0.5 * mixed : mixed;
    }
  }
  const Matrix6 C = T.transpose() * C_M * T;
  return 0.5 * (C + C.transpose());
}

SolidMaterial anisotropic_solid(const Matrix6& C_M, const Eigen::Matrix3d& R_PM, double density,
                                const std::string& where) {
  if (!C_M.allFinite() || !C_M.isApprox(C_M.transpose(), 1e-6) || Eigen::LLT<Matrix6>(C_M).info() != Eigen::Success)
    throw Error(
        "the elastic matrix of a solid is not symmetric and positive definite", where,
        "give the 21 constants of stress = C strain in the order xx yy zz xy yz zx with engineering shear strains");
  return {rotated_elasticity(C_M, R_PM), density};
}

}  // namespace tisserand::reducer
