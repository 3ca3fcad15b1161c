// SPDX-License-Identifier: GPL-3.0-or-later
// Two-node spatial beam element: closed-form stiffness, Gauss-integrated mass.
#include "reducer/elements/beam/beam.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

namespace tisserand::reducer {
namespace {

using Matrix4 = Eigen::Matrix4d;
using Vector4 = Eigen::Vector4d;

/// Places of the four coordinates (deflection, slope, deflection, slope) of a bending plane among the twelve. In x-z
/// the slope w' is −θy.
struct BendingPlane {
  std::array<int, 4> index;
  double slope_sign;
};
constexpr BendingPlane plane_xy{{1, 5, 7, 11}, 1.0};
constexpr BendingPlane plane_xz{{2, 4, 8, 10}, -1.0};

void add_plane(const BendingPlane& plane, const Matrix4& m, Matrix12& result) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double sign = (i % 2 == 1 ? plane.slope_sign : 1.0) * (j % 2 == 1 ? plane.slope_sign : 1.0);
      result(plane.index[i], plane.index[j]) += sign * m(i, j);
    }
}

void add_pair(int first, int second, const Eigen::Matrix2d& m, Matrix12& result) {
  result(first, first) += m(0, 0);
  result(first, second) += m(0, 1);
  result(second, first) += m(1, 0);
  result(second, second) += m(1, 1);
}

/// [Prz68] (5.116), one plane: EI/(L³(1+Φ)) [12 6L −12 6L; . (4+Φ)L² −6L (2−Φ)L²; . . 12 −6L; . . . (4+Φ)L²].
Matrix4 bending_stiffness(double EI, double L, double phi) {
  const double a = 12.0, b = 6.0 * L, c = (4.0 + phi) * L * L, d = (2.0 - phi) * L * L;
  Matrix4 k;
  k << a, b, -a, b, b, c, -b, d, -a, -b, a, -b, b, d, -b, c;
  return EI / (L * L * L * (1.0 + phi)) * k;
}

/// Deflection at ξ = x/L for unit end deflections and slopes ([FK93] (11); Hermite for Φ = 0).
Vector4 deflection_shape(double xi, double L, double phi) {
  const double x2 = xi * xi, x3 = x2 * xi;
  return Vector4(1.0 - 3.0 * x2 + 2.0 * x3 + phi * (1.0 - xi), L * (xi - 2.0 * x2 + x3 + 0.5 * phi * (xi - x2)),
                 3.0 * x2 - 2.0 * x3 + phi * xi, L * (x3 - x2 + 0.5 * phi * (x2 - xi))) /
         (1.0 + phi);
}

/// Rotation of the section at ξ ([FK93] (12)).
Vector4 rotation_shape(double xi, double L, double phi) {
  const double x2 = xi * xi;
  return Vector4(6.0 / L * (x2 - xi), 1.0 - 4.0 * xi + 3.0 * x2 + phi * (1.0 - xi), 6.0 / L * (xi - x2),
                 3.0 * x2 - 2.0 * xi + phi * xi) /
         (1.0 + phi);
}

/// ∫ρA Nᵀ N dx + ∫ρI N_θᵀ N_θ dx: degree 6, integrated exactly by four Gauss points.
Matrix4 bending_mass(double rho_A, double rho_I, double L, double phi) {
  constexpr std::array<double, 4> point{-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                                        0.86113631159405257522};
  constexpr std::array<double, 4> weight{0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                                         0.34785484513745385737};
  Matrix4 m = Matrix4::Zero();
  for (std::size_t g = 0; g < point.size(); ++g) {
    const double xi = 0.5 * (1.0 + point[g]);
    const Vector4 N = deflection_shape(xi, L, phi);
    const Vector4 N_theta = rotation_shape(xi, L, phi);
    m += 0.5 * L * weight[g] * (rho_A * N * N.transpose() + rho_I * N_theta * N_theta.transpose());
  }
  return m;
}

formats::SectionInertia inertia_of(const BeamElementData& beam) {
  formats::SectionInertia inertia = formats::section_inertia(beam.section, beam.material);
  if (beam.rotary_inertia == RotaryInertia::without) inertia.about_y = inertia.about_z = 0.0;
  return inertia;
}

Matrix12 consistent_mass(const BeamElementData& beam) {
  const double L = beam.length;
  const formats::SectionInertia inertia = inertia_of(beam);
  const ShearFlexibility phi = shear_flexibility(beam);
  Eigen::Matrix2d linear;
  linear << 2.0, 1.0, 1.0, 2.0;
  linear *= L / 6.0;
  Matrix12 m = Matrix12::Zero();
  add_pair(0, 6, inertia.mass * linear, m);
  add_pair(3, 9, inertia.about_x * linear, m);
  add_plane(plane_xy, bending_mass(inertia.mass, inertia.about_z, L, phi.xy), m);
  add_plane(plane_xz, bending_mass(inertia.mass, inertia.about_y, L, phi.xz), m);
  return m;
}

Matrix12 lumped_mass(const BeamElementData& beam) {
  const double half = 0.5 * beam.length;
  const formats::SectionInertia inertia = inertia_of(beam);
  Eigen::Matrix<double, 6, 1> node;
  node << Eigen::Vector3d::Constant(half * inertia.mass), half * inertia.about_x, half * inertia.about_y,
      half * inertia.about_z;
  Matrix12 m = Matrix12::Zero();
  m.diagonal() << node, node;
  return m;
}

}  // namespace

ShearFlexibility shear_flexibility(const BeamElementData& beam) {
  ShearFlexibility phi;
  if (beam.theory == formats::BeamTheory::euler_bernoulli) return phi;
  const double factor =
      12.0 * beam.material.youngs_modulus / (beam.material.shear_modulus() * beam.length * beam.length);
  const formats::Section& s = beam.section;
  if (s.shear_area_y > 0.0) phi.xy = factor * s.second_moment_z / s.shear_area_y;
  if (s.shear_area_z > 0.0) phi.xz = factor * s.second_moment_y / s.shear_area_z;
  return phi;
}

bool is_plain(const BeamElementData& beam) {
  const formats::Section& s = beam.section;
  const AddedMass& added = beam.added_mass;
  return beam.stations.empty() && s.second_moment_yz == 0.0 && s.shear_coupling == 0.0 && s.centroid_y == 0.0 &&
         s.centroid_z == 0.0 && s.shear_center_y == 0.0 && s.shear_center_z == 0.0 && added.first == 0.0 &&
         added.second == 0.0 && added.inertia == 0.0 && !is_rod(beam);
}

bool is_rod(const BeamElementData& beam) {
  const auto bends = [](const formats::Section& s) { return s.second_moment_y != 0.0 || s.second_moment_z != 0.0; };
  return beam.stations.empty() ? !bends(beam.section) : std::none_of(beam.stations.begin(), beam.stations.end(), bends);
}

Matrix12 beam_stiffness(const BeamElementData& beam) {
  const double E = beam.material.youngs_modulus, G = beam.material.shear_modulus(), L = beam.length;
  const formats::Section& s = beam.section;
  const ShearFlexibility phi = shear_flexibility(beam);
  Eigen::Matrix2d spring;
  spring << 1.0, -1.0, -1.0, 1.0;
  Matrix12 k = Matrix12::Zero();
  add_pair(0, 6, E * s.area / L * spring, k);
  add_pair(3, 9, G * s.torsion_constant / L * spring, k);
  add_plane(plane_xy, bending_stiffness(E * s.second_moment_z, L, phi.xy), k);
  add_plane(plane_xz, bending_stiffness(E * s.second_moment_y, L, phi.xz), k);
  return k;
}

Matrix12 beam_mass(const BeamElementData& beam) {
  switch (beam.mass_matrix) {
    case formats::MassMatrix::consistent:
      return consistent_mass(beam);
    case formats::MassMatrix::lumped:
      return lumped_mass(beam);
  }
  return Matrix12::Zero();
}

std::optional<Eigen::Matrix3d> beam_axes(const Eigen::Vector3d& axis, const Eigen::Vector3d& orientation) {
  const Eigen::Vector3d x = axis.normalized();
  const Eigen::Vector3d normal = orientation.normalized() - x * x.dot(orientation.normalized());
  if (!(normal.norm() > 1e-6)) return std::nullopt;
  Eigen::Matrix3d R_PE;
  R_PE.col(0) = x;
  R_PE.col(1) = normal.normalized();
  R_PE.col(2) = x.cross(R_PE.col(1));
  return R_PE;
}

Matrix12 to_part_axes(const Matrix12& local, const Eigen::Matrix3d& R_PE) {
  Matrix12 result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      result.block<3, 3>(3 * i, 3 * j) = R_PE * local.block<3, 3>(3 * i, 3 * j) * R_PE.transpose();
  return 0.5 * (result + result.transpose());
}

}  // namespace tisserand::reducer
