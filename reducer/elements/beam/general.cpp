// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals of section compliance and section mass along the beam.
#include "reducer/elements/beam/general.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "common/math/rotation.hpp"
#include "formats/sections/monosymmetry.hpp"
#include "reducer/properties/beam_taper.hpp"

namespace tisserand::reducer {
namespace {

using formats::Section;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::array<double, 4> gauss_point{-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                                            0.86113631159405257522};
constexpr std::array<double, 4> gauss_weight{0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                                             0.34785484513745385737};

Section section_at(const BeamElementData& beam, double x) {
  return beam.stations.empty() ? beam.section : constants_at(beam.stations, x / beam.length);
}

/// Motion of a rigid body at distance x along the axis from its motion [u; θ] at 0.
Matrix6 transfer(double x) {
  Matrix6 r = Matrix6::Identity();
  r(1, 5) = x;
  r(2, 4) = -x;
  return r;
}

/// Strains [ε γy γz κx κy κz] of the axis for section forces about the axis.
Matrix6 compliance(const BeamElementData& beam, const Section& s) {
  const double E = beam.material.youngs_modulus, G = beam.material.shear_modulus();
  const double y_s = s.centroid_y + s.shear_center_y, z_s = s.centroid_z + s.shear_center_z;
  Matrix6 H = Matrix6::Identity();  // to N, My, Mz about the centroid, Q and Mx about the shear centre
  H(3, 1) = z_s;
  H(3, 2) = -y_s;
  H(4, 0) = -s.centroid_z;
  H(5, 0) = s.centroid_y;
  Matrix6 D = Matrix6::Zero();
  D(0, 0) = 1.0 / (E * s.area);
  if (beam.theory == formats::BeamTheory::timoshenko) {  // a shear area of zero means rigid in shear
    if (s.shear_area_y > 0.0) D(1, 1) = 1.0 / (G * s.shear_area_y);
    if (s.shear_area_z > 0.0) D(2, 2) = 1.0 / (G * s.shear_area_z);
    if (s.shear_area_y > 0.0 && s.shear_area_z > 0.0) D(1, 2) = D(2, 1) = s.shear_coupling / G;
  }
  D(3, 3) = 1.0 / (G * s.torsion_constant);
  // [My; Mz] = E [Iy −Iyz; −Iyz Iz] [κy; κz].
  const double determinant = s.second_moment_y * s.second_moment_z - s.second_moment_yz * s.second_moment_yz;
  D(4, 4) = s.second_moment_z / (E * determinant);
  D(5, 5) = s.second_moment_y / (E * determinant);
  D(4, 5) = D(5, 4) = s.second_moment_yz / (E * determinant);
  return H.transpose() * D * H;
}

void add_mass(double mass, double y, double z, Matrix6& mu) {
  const Matrix3d arm = skew<double>(Vector3d(0.0, y, z));
  mu.topLeftCorner<3, 3>().diagonal().array() += mass;
  mu.topRightCorner<3, 3>() -= mass * arm;
  mu.bottomLeftCorner<3, 3>() += mass * arm;
  mu.bottomRightCorner<3, 3>() -= mass * arm * arm;
}

/// Mass per length about the axis, [translation; rotation].
Matrix6 section_mass(const BeamElementData& beam, const Section& s, double x) {
  const double xi = x / beam.length;
  const formats::SectionInertia inertia = formats::section_inertia(s, beam.material);
  const AddedMass& added = beam.added_mass;
  Matrix6 mu = Matrix6::Zero();
  add_mass(inertia.mass, s.centroid_y, s.centroid_z, mu);
  add_mass((1.0 - xi) * added.first + xi * added.second, added.offset_y, added.offset_z, mu);
  mu(3, 3) += inertia.about_x + added.inertia;
  if (beam.rotary_inertia == RotaryInertia::with) {
    mu(4, 4) += inertia.about_y;
    mu(5, 5) += inertia.about_z;
    mu(4, 5) -= inertia.about_yz;
    mu(5, 4) -= inertia.about_yz;
  }
  return mu;
}

/// ∫ r(to − s) c(s) b(s) ds from `from` to `to`: contribution of the strains in between to the motion at `to`.
Matrix6 strained(const BeamElementData& beam, double from, double to) {
  Matrix6 sum = Matrix6::Zero();
  for (std::size_t g = 0; g < gauss_point.size(); ++g) {
    const double s = from + 0.5 * (to - from) * (1.0 + gauss_point[g]);
    sum += 0.5 * (to - from) * gauss_weight[g] * transfer(to - s) * compliance(beam, section_at(beam, s)) *
           transfer(beam.length - s).transpose();
  }
  return sum;
}

/// Number of pieces of the integrals, which increases with the ratio of the end areas.
int pieces_of(const BeamElementData& beam) {
  if (beam.stations.empty()) return 1;
  const double first = beam.stations.front().area, second = beam.stations.back().area;
  return 8 + static_cast<int>(4.0 * std::min(std::max(first / second, second / first), 50.0));
}

struct Point {
  double x = 0.0;
  double weight = 0.0;               ///< weight of the integral along the beam
  Matrix6 motion = Matrix6::Zero();  ///< [u; θ] at x for unit forces at end 2 with end 1 held
};

struct Integration {
  std::vector<Point> points;
  Matrix6 flexibility = Matrix6::Zero();
};

Integration integrate(const BeamElementData& beam) {
  const int pieces = pieces_of(beam);
  const double h = beam.length / pieces;
  Integration result;
  for (int p = 0; p < pieces; ++p) {
    const double start = p * h;
    const Matrix6 before = result.flexibility;
    for (std::size_t g = 0; g < gauss_point.size(); ++g) {
      const double x = start + 0.5 * h * (1.0 + gauss_point[g]);
      result.points.push_back({x, 0.5 * h * gauss_weight[g], transfer(x - start) * before + strained(beam, start, x)});
    }
    result.flexibility = transfer(h) * before + strained(beam, start, start + h);
  }
  return result;
}

/// f⁻¹, scaled by the diagonal because displacements and rotations differ in unit.
Matrix6 inverse(const Matrix6& f) {
  const Eigen::Matrix<double, 6, 1> scale = f.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6 scaled = scale.asDiagonal() * (0.5 * (f + f.transpose())) * scale.asDiagonal();
  const Matrix6 k = scaled.ldlt().solve(Matrix6::Identity());
  return scale.asDiagonal() * (0.5 * (k + k.transpose())) * scale.asDiagonal();
}

/// Lumped mass matrix: ∫μ dx of each half at its end.
Matrix12 lumped(const BeamElementData& beam, const std::vector<double>& halves) {
  Matrix12 M = Matrix12::Zero();
  for (std::size_t end = 0; end + 1 < halves.size(); ++end)
    for (std::size_t g = 0; g < gauss_point.size(); ++g) {
      const double half = 0.5 * (halves[end + 1] - halves[end]);
      const double x = halves[end] + half * (1.0 + gauss_point[g]);
      const Eigen::Index at = 6 * static_cast<Eigen::Index>(end);
      M.block<6, 6>(at, at) += half * gauss_weight[g] * section_mass(beam, section_at(beam, x), x);
    }
  return M;
}

BeamMatrices rod(const BeamElementData& beam) {
  const double L = beam.length;
  double axial = 0.0, torsional = 0.0;
  bool twists = true;
  BeamMatrices result;
  Matrix6x12 N = Matrix6x12::Zero();
  const int pieces = pieces_of(beam);
  for (int p = 0; p < pieces; ++p)
    for (std::size_t g = 0; g < gauss_point.size(); ++g) {
      const double weight = 0.5 * L / pieces * gauss_weight[g], x = L / pieces * (p + 0.5 * (1.0 + gauss_point[g]));
      const Section s = section_at(beam, x);
      axial += weight / (beam.material.youngs_modulus * s.area);
      twists = twists && s.torsion_constant > 0.0;
      if (twists) torsional += weight / (beam.material.shear_modulus() * s.torsion_constant);
      for (int i = 0; i < 4; ++i) {
        N(i, i) = 1.0 - x / L;
        N(i, 6 + i) = x / L;
      }
      const Matrix6 mu = weight * section_mass(beam, s, x);
      result.mass += N.transpose() * mu * N;
    }
  for (const int i : {0, 3}) {
    const double k = i == 0 ? 1.0 / axial : twists ? 1.0 / torsional : 0.0;
    result.stiffness(i, i) = result.stiffness(i + 6, i + 6) = k;
    result.stiffness(i, i + 6) = result.stiffness(i + 6, i) = -k;
  }
  return result;
}

/// Mass points of a lumped beam: each half of the beam at its end.
std::vector<BeamMassPoint> lumped_points(const BeamElementData& beam) {
  const Matrix12 M = lumped(beam, {0.0, 0.5 * beam.length, beam.length});
  std::vector<BeamMassPoint> points(2);
  for (int end = 0; end < 2; ++end) {
    points[end].x = end * beam.length;
    points[end].motion.setZero();
    points[end].motion.middleCols<6>(6 * end).setIdentity();
    points[end].mass = M.block<6, 6>(6 * end, 6 * end);
  }
  return points;
}

std::vector<BeamMassPoint> consistent_points(const BeamElementData& beam) {
  const Integration along = integrate(beam);
  Matrix6x12 T;
  T << -transfer(beam.length), Matrix6::Identity();
  const Matrix6x12 forces = inverse(along.flexibility) * T;
  std::vector<BeamMassPoint> points;
  for (const Point& at : along.points) {
    BeamMassPoint point{at.x, at.motion * forces, at.weight * section_mass(beam, section_at(beam, at.x), at.x)};
    point.motion.leftCols<6>() += transfer(at.x);
    points.push_back(point);
  }
  return points;
}

/// Mass points of a rod: motion linear, bending rotations those of the line; mass and inertia about the axis.
std::vector<BeamMassPoint> rod_points(const BeamElementData& beam) {
  const double L = beam.length;
  std::vector<BeamMassPoint> points;
  if (beam.mass_matrix == formats::MassMatrix::lumped) {
    points = lumped_points(beam);
  } else {
    const int pieces = pieces_of(beam);
    for (int p = 0; p < pieces; ++p)
      for (std::size_t g = 0; g < gauss_point.size(); ++g) {
        const double x = L / pieces * (p + 0.5 * (1.0 + gauss_point[g]));
        BeamMassPoint point{x, Matrix6x12::Zero(),
                            0.5 * L / pieces * gauss_weight[g] * section_mass(beam, section_at(beam, x), x)};
        for (int i = 0; i < 4; ++i) {
          point.motion(i, i) = 1.0 - x / L;
          point.motion(i, 6 + i) = x / L;
        }
        points.push_back(point);
      }
  }
  for (BeamMassPoint& point : points) {
    point.motion.bottomRows<2>().setZero();
    point.motion(4, 2) = point.motion(5, 7) = 1.0 / L;
    point.motion(4, 8) = point.motion(5, 1) = -1.0 / L;
    const double mass = point.mass(0, 0), twist = point.mass(3, 3);
    point.mass.setZero();
    point.mass.diagonal() << mass, mass, mass, twist, 0.0, 0.0;
  }
  return points;
}

/// ∫σ |r − s|² dA for the section forces F about the axis: N (I_p/A + |s|²) + β_y M_y − β_z M_z. Moments are about the
/// centroid, and s is the shear centre from it (formats/sections/monosymmetry.hpp).
Eigen::Matrix<double, 1, 6> wagner_row(const Section& s, const formats::Monosymmetry& beta) {
  const double y = s.shear_center_y, z = s.shear_center_z;
  Eigen::Matrix<double, 1, 6> row = Eigen::Matrix<double, 1, 6>::Zero();
  row[0] = s.polar_moment / s.area + y * y + z * z - beta.beta_y * s.centroid_z - beta.beta_z * s.centroid_y;
  row[4] = beta.beta_y;
  row[5] = -beta.beta_z;
  return row;
}

}  // namespace

std::optional<std::string> general_beam_fault(const BeamElementData& beam) {
  constexpr int samples = 32;
  for (int k = 0; k <= samples; ++k) {
    const Section s = section_at(beam, beam.length * k / samples);
    const auto fault = [&](const char* what, double value) {
      return fmt::format("{} is {:g} at {:.3g} of its length and must be positive", what, value, 1.0 * k / samples);
    };
    if (!(s.area > 0.0)) return fault("the area", s.area);
    if (is_rod(beam)) continue;
    const double mean = 0.5 * (s.second_moment_y + s.second_moment_z);
    const double least = mean - std::hypot(0.5 * (s.second_moment_y - s.second_moment_z), s.second_moment_yz);
    if (!(least > 1e-12 * mean)) return fault("the smaller principal second moment of area", least);
    if (!(s.torsion_constant > 0.0)) return fault("the torsion constant", s.torsion_constant);
  }
  return std::nullopt;
}

BeamMatrices general_beam(const BeamElementData& beam) {
  const double L = beam.length;
  BeamMatrices result;
  if (is_rod(beam)) {
    result = rod(beam);
  } else {
    const Integration along = integrate(beam);
    Matrix6x12 T;
    T << -transfer(L), Matrix6::Identity();
    const Matrix6x12 forces = inverse(along.flexibility) * T;
    result.stiffness = T.transpose() * forces;
    for (const Point& point : along.points) {
      Matrix6x12 N = point.motion * forces;
      N.leftCols<6>() += transfer(point.x);
      const Matrix6 mu = point.weight * section_mass(beam, section_at(beam, point.x), point.x);
      result.mass += N.transpose() * mu * N;
    }
  }
  if (beam.mass_matrix == formats::MassMatrix::lumped) result.mass = lumped(beam, {0.0, 0.5 * L, L});
  if (is_rod(beam)) {  // a rod has no bending rotations
    for (const int i : {4, 5, 10, 11}) {
      result.mass.row(i).setZero();
      result.mass.col(i).setZero();
    }
  }
  result.stiffness = 0.5 * (result.stiffness + result.stiffness.transpose()).eval();
  result.mass = 0.5 * (result.mass + result.mass.transpose()).eval();
  return result;
}

std::vector<BeamMassPoint> beam_mass_points(const BeamElementData& beam) {
  if (is_rod(beam)) return rod_points(beam);
  return beam.mass_matrix == formats::MassMatrix::lumped ? lumped_points(beam) : consistent_points(beam);
}

std::vector<BeamField> beam_fields(const BeamElementData& beam) {
  const double L = beam.length;
  const Integration along = integrate(beam);
  Matrix6x12 T;
  T << -transfer(L), Matrix6::Identity();
  const Matrix6x12 forces = inverse(along.flexibility) * T;
  const Eigen::Vector2d third = beam.stations.empty()
                                    ? formats::third_moments(beam.section).value_or(Eigen::Vector2d::Zero())
                                    : Eigen::Vector2d(Eigen::Vector2d::Zero());
  std::vector<BeamField> fields;
  for (const Point& point : along.points) {
    const Section section = section_at(beam, point.x);
    BeamField field;
    field.weight = point.weight;
    field.motion = point.motion * forces;
    field.motion.leftCols<6>() += transfer(point.x);
    field.force = transfer(L - point.x).transpose() * forces;
    field.gradient = compliance(beam, section) * field.force;  // strains; u' = γ + θ × e_x
    field.gradient.row(1) += field.motion.row(5);
    field.gradient.row(2) -= field.motion.row(4);
    field.wagner = wagner_row(section, formats::monosymmetry(section, third)) * field.force;
    fields.push_back(field);
  }
  return fields;
}

}  // namespace tisserand::reducer
