// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and mass per area of isotropic sheets and laminates.
#include "reducer/properties/laminate.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/LU>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;

/// Matrix from strains in the laminate's axes to strains in the fibres' axes, [11 22 12] with engineering shear.
Matrix3d strain_in_fibre_axes(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d T;
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  return T;
}

/// Reduced stiffness of plane stress in the laminate's axes ([Jon99] chapter 2).
Matrix3d in_plane_stiffness(const Ply& ply) {
  const double factor = 1.0 - ply.nu12 * ply.nu12 * ply.E2 / ply.E1;
  Matrix3d Q = Matrix3d::Zero();
  Q(0, 0) = ply.E1 / factor;
  Q(1, 1) = ply.E2 / factor;
  Q(0, 1) = Q(1, 0) = ply.nu12 * ply.E2 / factor;
  Q(2, 2) = ply.G12;
  const Matrix3d T = strain_in_fibre_axes(ply.angle);
  return T.transpose() * Q * T;
}

/// [γxz, γyz] from [τxz, τyz].
Matrix2d shear_compliance(const Ply& ply) {
  const double c = std::cos(ply.angle), s = std::sin(ply.angle);
  Matrix2d R;
  R << c, s, -s, c;
  return R.transpose() * Eigen::Vector2d(1.0 / ply.G13, 1.0 / ply.G23).asDiagonal() * R;
}

/// Inverse of ∫ fᵀ G⁻¹ f dz. F(z) = a(z) A⁻¹B − b(z) with a = ∫ Q dz, b = ∫ Q z dz from the bottom up to z. F (D − B
/// A⁻¹ B)⁻¹ turns moment gradients into shear stress ([RR97]). Its entries of M_x,x and M_y,y are f = [F11 F32; F31
/// F22]. f is quadratic in z, so three points per ply are exact.
Matrix2d shear_stiffness(const std::vector<Ply>& plies, double bottom, const ShellSection& section) {
  constexpr std::array<std::pair<double, double>, 3> gauss{
      {{0.11270166537925831148, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074168852, 5.0 / 18.0}}};
  const Matrix3d A_inverse_B = section.A.inverse() * section.B;
  const Matrix3d D_inverse = (section.D - section.B * A_inverse_B).inverse();
  Matrix3d a = Matrix3d::Zero(), b = Matrix3d::Zero();
  Matrix2d compliance = Matrix2d::Zero();
  double z0 = bottom;
  for (const Ply& ply : plies) {
    const Matrix3d Q = in_plane_stiffness(ply);
    const Matrix2d G_inverse = shear_compliance(ply);
    for (const auto& [at, weight] : gauss) {
      const double z = z0 + at * ply.thickness;
      const Matrix3d F = ((a + Q * (z - z0)) * A_inverse_B - b - Q * (0.5 * (z * z - z0 * z0))) * D_inverse;
      Matrix2d f;
      f << F(0, 0), F(2, 1), F(2, 0), F(1, 1);
      compliance += weight * ply.thickness * f.transpose() * G_inverse * f;
    }
    const double z1 = z0 + ply.thickness;
    a += Q * ply.thickness;
    b += Q * (0.5 * (z1 * z1 - z0 * z0));
    z0 = z1;
  }
  const Matrix2d stiffness = compliance.inverse();
  return 0.5 * (stiffness + stiffness.transpose());
}

void check_ply(const Ply& ply, std::size_t number, const std::string& where) {
  const auto demand = [&](bool holds, const char* quantity, double value, const char* condition) {
    if (!holds)
      throw Error(fmt::format("ply {}: {} is {:g}", number, quantity, value), where,
                  fmt::format("give a {} that is {}", quantity, condition));
  };
  const std::array<std::pair<const char*, double>, 6> positive{{{"thickness", ply.thickness},
                                                                {"E1", ply.E1},
                                                                {"E2", ply.E2},
                                                                {"G12", ply.G12},
                                                                {"G13", ply.G13},
                                                                {"G23", ply.G23}}};
  for (const auto& [quantity, value] : positive)
    demand(value > 0.0 && std::isfinite(value), quantity, value, "positive and finite");
  demand(ply.density >= 0.0 && std::isfinite(ply.density), "density", ply.density, "finite and not negative");
  demand(std::isfinite(ply.angle), "angle", ply.angle, "finite");
  demand(ply.nu12 * ply.nu12 < ply.E1 / ply.E2, "nu12", ply.nu12, "smaller than sqrt(E1/E2) in absolute value");
}

}  // namespace

ShellSection isotropic_shell(double youngs_modulus, double poisson_ratio, double density, double thickness,
                             double shear_correction) {
  const double E = youngs_modulus, nu = poisson_ratio, t = thickness, G = E / (2.0 * (1.0 + nu));
  Matrix3d plane;
  plane << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  ShellSection section;
  section.A = E * t / (1.0 - nu * nu) * plane;
  section.D = t * t / 12.0 * section.A;
  section.As = shear_correction * G * t * Matrix2d::Identity();
  section.mass = density * t;
  section.rotary_inertia = density * t * t * t / 12.0;
  section.thickness = t;
  return section;
}

ShellSection laminate(const std::vector<Ply>& plies, double bottom) {
  ShellSection section;
  double z0 = bottom;
  for (const Ply& ply : plies) {
    const Matrix3d Q = in_plane_stiffness(ply);
    const double t = ply.thickness, z1 = z0 + t;
    const double first = 0.5 * (z1 * z1 - z0 * z0), second = t * (z0 * z0 + z0 * z1 + z1 * z1) / 3.0;
    section.A += Q * t;
    section.B += Q * first;
    section.D += Q * second;
    section.mass += ply.density * t;
    section.first_moment += ply.density * first;
    section.rotary_inertia += ply.density * second;
    section.thickness += t;
    z0 = z1;
  }
  section.As = shear_stiffness(plies, bottom, section);
  return section;
}

void check_plies(const std::vector<Ply>& plies, const std::string& where) {
  if (plies.empty()) throw Error("the laminate has no plies", where, "list at least one ply");
  for (std::size_t i = 0; i < plies.size(); ++i) check_ply(plies[i], i + 1, where);
}

}  // namespace tisserand::reducer
