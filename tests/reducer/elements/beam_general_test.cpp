// SPDX-License-Identifier: GPL-3.0-or-later
// The general beam against the plain one, closed formulas of coupled and tapered beams, and its laws.
#include "reducer/elements/beam/general.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"
#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"
#include "reducer/properties/beam_taper.hpp"

namespace tisserand::reducer::beam_general_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::BeamTheory;
using formats::MassMatrix;
using formats::Section;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double E = 2.1e11, G = E / 2.6, rho = 7850.0;

BeamElementData beam_with(const Section& section, double length) {
  BeamElementData beam;
  beam.section = section;
  beam.material = {"m", E, 0.3, rho, ""};
  beam.length = length;
  return beam;
}

/// A section without any symmetry, its centroid and shear centre off the axis.
Section odd_section() {
  Section s{"s", 2e-3, 3e-6, 8e-6, 6e-8, 11e-6, 1.1e-3, 0.9e-3, ""};
  s.second_moment_yz = -2e-6;
  s.centroid_y = 0.01;
  s.centroid_z = -0.02;
  s.shear_center_y = -0.03;
  s.shear_center_z = 0.015;
  s.shear_coupling = 120.0;
  return s;
}

/// Displacements of end 2 for unit forces there, end 1 held.
Matrix6 flexibility(const Matrix12& S) { return S.bottomRightCorner<6, 6>().ldlt().solve(Matrix6::Identity()); }

/// Unit translations and rotations of the beam about the point `from` of its axis.
Eigen::Matrix<double, 12, 6> rigid(double length, double from) {
  Eigen::Matrix<double, 12, 6> R;
  R << Matrix6::Identity(), Matrix6::Identity();
  R.block<3, 3>(0, 3) = -skew<double>(Vector3d(-from, 0, 0));
  R.block<3, 3>(6, 3) = -skew<double>(Vector3d(length - from, 0, 0));
  return R;
}

/// Copy of the section by stiffness, with E, G and ρ multiplied in: all matrices agree to rounding.
Section by_stiffness(const Section& s) {
  Section result = s;
  result.by_stiffness = true;
  result.shape.clear();
  result.area *= E;
  result.second_moment_y *= E;
  result.second_moment_z *= E;
  result.polar_moment = result.second_moment_y + result.second_moment_z;
  result.torsion_constant *= G;
  result.shear_area_y *= G;
  result.shear_area_z *= G;
  result.mass_per_length = rho * s.area;
  result.rotary_inertia_y = rho * s.second_moment_y;
  result.rotary_inertia_z = rho * s.second_moment_z;
  return result;
}

TEST(BeamByStiffness, MatricesAreThoseOfShapeAndMaterial) {
  const Section wide = formats::rectangle_section(0.05, 0.1), thin = formats::rectangle_section(0.03, 0.08);
  for (const bool tapered : {false, true})
    for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped})
      for (const RotaryInertia rotary : {RotaryInertia::with, RotaryInertia::without}) {
        BeamElementData shape = beam_with(wide, 0.7);
        shape.mass_matrix = mass;
        shape.rotary_inertia = rotary;
        BeamElementData stiffness = shape;
        stiffness.section = by_stiffness(wide);
        stiffness.material = formats::unit_material("");
        if (tapered) {
          shape.stations = {wide, thin};  // linear constants, as those by stiffness
          stiffness.stations = taper_stations(by_stiffness(wide), by_stiffness(thin));
        }
        const auto matrices = [&](const BeamElementData& beam) {
          return tapered ? general_beam(beam) : BeamMatrices{beam_stiffness(beam), beam_mass(beam)};
        };
        const BeamMatrices a = matrices(shape), b = matrices(stiffness);
        EXPECT_LT((a.stiffness - b.stiffness).norm(), 1e-13 * a.stiffness.norm());
        EXPECT_LT((a.mass - b.mass).norm(), 1e-13 * a.mass.norm());
      }
}

void expect_the_plain_one(const BeamElementData& beam) {
  ASSERT_TRUE(is_plain(beam));
  const BeamMatrices general = general_beam(beam);
  const Matrix12 S = beam_stiffness(beam), M = beam_mass(beam);
  EXPECT_LT((general.stiffness - S).cwiseAbs().maxCoeff(), 1e-13 * S.cwiseAbs().maxCoeff());
  EXPECT_LT((general.mass - M).cwiseAbs().maxCoeff(), 1e-13 * M.cwiseAbs().maxCoeff());
}

/// Two derivations of the same theory: closed formulas and integrals along the beam. A shear area of zero means rigid
/// in shear, in its direction alone.
TEST(GeneralBeam, OfAPlainBeamIsThePlainOne) {
  for (const auto& [A_y, A_z] : {std::pair(1.1e-3, 0.9e-3), {0.0, 0.9e-3}, {1.1e-3, 0.0}, {0.0, 0.0}})
    for (const BeamTheory theory : {BeamTheory::timoshenko, BeamTheory::euler_bernoulli})
      for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped})
        for (const RotaryInertia rotary : {RotaryInertia::with, RotaryInertia::without}) {
          BeamElementData beam = beam_with({"s", 2e-3, 3e-6, 8e-6, 6e-6, 11e-6, A_y, A_z, ""}, 0.7);
          beam.theory = theory;
          beam.mass_matrix = mass;
          beam.rotary_inertia = rotary;
          expect_the_plain_one(beam);
        }
}

TEST(GeneralBeam, HasSixMotionsWithoutEnergyAndTheMassOfTheBody) {
  BeamElementData beam = beam_with(odd_section(), 0.8);
  beam.added_mass = {3.0, 5.0, 0.02, 0.04, 0.05};
  const double L = beam.length, m = rho * beam.section.area;
  for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped}) {
    beam.mass_matrix = mass;
    const BeamMatrices matrices = general_beam(beam);
    EXPECT_LT((matrices.stiffness * rigid(L, 0.3)).cwiseAbs().maxCoeff(),
              1e-12 * matrices.stiffness.cwiseAbs().maxCoeff());
    const Matrix6 M = rigid(L, 0.0).transpose() * matrices.mass * rigid(L, 0.0);
    // ∫ of mass, first moments m c and moments of inertia along the beam; added mass 3 + 2x/L.
    const double total = m * L + 4.0 * L;
    EXPECT_NEAR(M(0, 0), total, 1e-12 * total);
    EXPECT_NEAR(M(1, 1), total, 1e-12 * total);
    EXPECT_NEAR(M(2, 3), m * L * 0.01 + 4.0 * L * 0.04, 1e-12 * total);  // ∫y dm
    EXPECT_NEAR(M(1, 3), m * L * 0.02 - 4.0 * L * 0.05, 1e-12 * total);  // −∫z dm
    const double inertia_x = L * (rho * beam.section.polar_moment + m * 5e-4 + 0.02 + 4.0 * 0.0041);
    EXPECT_NEAR(M(3, 3), inertia_x, 1e-12 * total);
    if (mass == MassMatrix::lumped) continue;
    EXPECT_NEAR(M(1, 5), m * L * L / 2 + L * L * (3.0 / 6 + 5.0 / 3), 1e-12 * total);  // ∫x dm
    const double inertia_y = rho * L * beam.section.second_moment_y + m * L * 4e-4 + 4.0 * L * 0.0025;
    EXPECT_NEAR(M(4, 4), m * L * L * L / 3 + L * L * L * (3.0 / 12 + 5.0 / 4) + inertia_y, 1e-12 * total);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrices.mass).eigenvalues()[0], 0.0);
  }
}

/// The constants of a section seen in axes that are turned by φ about x.
Section turned(const Section& s, double phi) {
  const double c = std::cos(phi), d = std::sin(phi);
  const Eigen::Matrix2d R{{c, d}, {-d, c}};  // components in the new axes
  const Eigen::Matrix2d Q{{s.second_moment_z, s.second_moment_yz}, {s.second_moment_yz, s.second_moment_y}};
  const Eigen::Matrix2d C{{1.0 / s.shear_area_y, s.shear_coupling}, {s.shear_coupling, 1.0 / s.shear_area_z}};
  const Eigen::Matrix2d Q2 = R * Q * R.transpose(), C2 = R * C * R.transpose();
  const Eigen::Vector2d centroid = R * Eigen::Vector2d(s.centroid_y, s.centroid_z);
  const Eigen::Vector2d shear = R * Eigen::Vector2d(s.shear_center_y, s.shear_center_z);
  Section t = s;
  t.second_moment_z = Q2(0, 0), t.second_moment_y = Q2(1, 1), t.second_moment_yz = Q2(0, 1);
  t.shear_area_y = 1.0 / C2(0, 0), t.shear_area_z = 1.0 / C2(1, 1), t.shear_coupling = C2(0, 1);
  t.centroid_y = centroid.x(), t.centroid_z = centroid.y();
  t.shear_center_y = shear.x(), t.shear_center_z = shear.y();
  return t;
}

TEST(GeneralBeam, DoesNotDependOnTheAxesOfTheSection) {
  const double phi = 0.7;
  const BeamMatrices matrices = general_beam(beam_with(odd_section(), 0.8));
  const BeamMatrices other = general_beam(beam_with(turned(odd_section(), phi), 0.8));
  const Matrix3d R = Eigen::AngleAxisd(phi, Vector3d::UnitX()).toRotationMatrix();  // new axes in the old ones
  EXPECT_LT((to_part_axes(other.stiffness, R) - matrices.stiffness).cwiseAbs().maxCoeff(),
            1e-12 * matrices.stiffness.cwiseAbs().maxCoeff());
  EXPECT_LT((to_part_axes(other.mass, R) - matrices.mass).cwiseAbs().maxCoeff(),
            1e-12 * matrices.mass.cwiseAbs().maxCoeff());
}

/// Cantilever of an angle section, force P along z at the centroid of its end: unsymmetric bending
/// [v; w] = L³/3E [Iy −Iyz; −Iyz Iz]/(Iy Iz − Iyz²) [0; P] in which ∫y² belongs to v (Pilkey 2002, chapter 1), shear by
/// the compliance of the section, and twist by P times its arm about the shear centre.
TEST(GeneralBeam, AngleSectionBendsAsideAndTwists) {
  const double L = 1.5;
  const Section s = formats::profile_section("angle", {0.1, 0.06, 0.006, 0.008});
  const Matrix6 f = flexibility(general_beam(beam_with(s, L)).stiffness);
  const double D = s.second_moment_y * s.second_moment_z - s.second_moment_yz * s.second_moment_yz;
  const double twist = -s.shear_center_y * L / (G * s.torsion_constant);  // P along z acts at y = −y_s from it
  const double v = -s.second_moment_yz / D * L * L * L / (3 * E) + s.shear_coupling * L / G;
  const double w = s.second_moment_z / D * L * L * L / (3 * E) + L / (G * s.shear_area_z);
  EXPECT_NEAR(f(3, 2), twist, 1e-12 * std::abs(twist));
  EXPECT_NEAR(f(1, 2), v + s.shear_center_z * twist, 1e-11 * std::abs(w));  // the axis turns about the shear centre
  EXPECT_NEAR(f(2, 2), w - s.shear_center_y * twist, 1e-11 * std::abs(w));
  EXPECT_GT(std::abs(f(1, 2)), 0.1 * f(2, 2)) << "the coupling counts";
}

/// NASTRAN's PBEAM with its axis through the shear centres is the same beam, moved by rigid arms.
TEST(GeneralBeam, AxisThroughShearCentresIsTheSameBeam) {
  const Section s = formats::profile_section("channel", {0.1, 0.06, 0.005, 0.008});
  Section moved = s;
  moved.centroid_y = -s.shear_center_y;
  moved.centroid_z = -s.shear_center_z;
  const BeamMatrices at_centroid = general_beam(beam_with(s, 0.9)), at_shear = general_beam(beam_with(moved, 0.9));
  Matrix12 T = Matrix12::Identity();  // motion of the shear centre from that of the centroid
  for (const int end : {0, 6})
    T.block<3, 3>(end, end + 3) = -skew<double>(Vector3d(0, s.shear_center_y, s.shear_center_z));
  EXPECT_LT((T.transpose() * at_shear.stiffness * T - at_centroid.stiffness).cwiseAbs().maxCoeff(),
            1e-12 * at_centroid.stiffness.cwiseAbs().maxCoeff());
  EXPECT_LT((T.transpose() * at_shear.mass * T - at_centroid.mass).cwiseAbs().maxCoeff(),
            1e-12 * at_centroid.mass.maxCoeff());
}

/// Cantilever whose depth falls from h to 1, width b, force at the thin end, s from there: ∫12 s²/(E b (1 + k s)³) ds =
/// 12/(E b k³) [ln h + 2/h − 1/(2h²) − 3/2] with k = (h − 1)/L; axially ln h/(E b k).
TEST(TaperedBeam, WedgeIsExact) {
  const double L = 5.0, b = 0.3;
  for (const double h : {1.5, 3.0, 10.0}) {
    BeamElementData beam = beam_with(formats::rectangle_section(b, h), L);
    beam.stations = taper_stations(beam.section, formats::rectangle_section(b, 1.0));
    beam.theory = BeamTheory::euler_bernoulli;
    const Matrix6 f = flexibility(general_beam(beam).stiffness);
    const double k = (h - 1.0) / L;
    const double deflection = 12.0 / (E * b * k * k * k) * (std::log(h) + 2.0 / h - 0.5 / (h * h) - 1.5);
    EXPECT_NEAR(f(2, 2) / deflection, 1.0, 1e-9) << h;
    EXPECT_NEAR(f(0, 0) / (std::log(h) / (E * b * k)), 1.0, 1e-9) << h;
  }
}

/// A cone of circular sections, radius r(x) from 2a to a: twist ∫2/(G π r⁴) dx = 2/(3 G π k)(1/a³ − 1/(2a)³), k = a/L;
/// its mass ρπL(4a² + 2a² + a²)/3, first moment ρπ∫x r² dx, r = 2a − kx.
TEST(TaperedBeam, ConeHasItsTorsionAndMass) {
  const double L = 1.2, a = 0.02, k = a / L;
  BeamElementData beam = beam_with(formats::circle_section(2 * a), L);
  beam.stations = taper_stations(beam.section, formats::circle_section(a));
  const BeamMatrices matrices = general_beam(beam);
  const double twist = 2.0 / (3.0 * G * std::numbers::pi * k) * (1.0 - 1.0 / 8.0) / (a * a * a);
  EXPECT_NEAR(flexibility(matrices.stiffness)(3, 3) / twist, 1.0, 1e-10);
  const Matrix6 M = rigid(L, 0.0).transpose() * matrices.mass * rigid(L, 0.0);
  const double mass = rho * std::numbers::pi * L * a * a * 7.0 / 3.0;
  const double first = rho * std::numbers::pi * L * L * a * a * (2.0 - 4.0 / 3.0 + 1.0 / 4.0);
  EXPECT_NEAR(M(0, 0) / mass, 1.0, 1e-12);
  EXPECT_NEAR(M(1, 5) / first, 1.0, 1e-12);
}

/// One exact element equals several exact elements whose inner nodes are condensed.
TEST(TaperedBeam, PiecesMakeTheWhole) {
  const Section thick = formats::rectangle_section(0.04, 0.09), thin = formats::rectangle_section(0.03, 0.02);
  const std::vector<Section> stations = taper_stations(thick, thin);
  BeamElementData whole = beam_with(thick, 1.1);
  whole.stations = stations;
  Eigen::Matrix<double, 18, 18> S = Eigen::Matrix<double, 18, 18>::Zero();
  for (int piece = 0; piece < 2; ++piece) {
    BeamElementData half = beam_with(thick, piece == 0 ? 0.44 : 0.66);
    half.stations = stations_between(stations, piece == 0 ? 0.0 : 0.4, piece == 0 ? 0.4 : 1.0);
    S.block<12, 12>(6 * piece, 6 * piece) += general_beam(half).stiffness;
  }
  const std::vector<int> outer{0, 1, 2, 3, 4, 5, 12, 13, 14, 15, 16, 17}, inner{6, 7, 8, 9, 10, 11};
  const Eigen::MatrixXd condensed =
      S(outer, outer) -
      S(outer, inner) * Eigen::MatrixXd(S(inner, inner)).ldlt().solve(Eigen::MatrixXd(S(inner, outer)));
  const Matrix12 expected = general_beam(whole).stiffness;
  EXPECT_LT((condensed - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
}

TEST(TaperedBeam, StationsHoldTheShapesOnTheWay) {
  const std::vector<Section> stations =
      taper_stations(formats::rectangle_section(0.04, 0.09), formats::rectangle_section(0.03, 0.02));
  const Section expected = formats::rectangle_section(0.04 - 0.3 * 0.01, 0.09 - 0.3 * 0.07);
  const Section s = constants_at(stations, 0.3);
  EXPECT_NEAR(s.area / expected.area, 1.0, 1e-13);
  EXPECT_NEAR(s.second_moment_y / expected.second_moment_y, 1.0, 1e-12);
  EXPECT_NEAR(s.torsion_constant / expected.torsion_constant, 1.0, 0.02);  // no polynomial
  Section own = stations[0];
  own.shape.clear();
  EXPECT_EQ(taper_stations(own, stations[4]).size(), 2u);
}

TEST(Rod, HasAxialAndTorsionalStiffnessAlone) {
  Section s;
  s.area = 2e-4;
  s.torsion_constant = 3e-9;
  s.polar_moment = 0.0;
  BeamElementData beam = beam_with(s, 1.3);
  beam.added_mass = {0.5, 0.5, 0.0, 0.0, 0.0};
  ASSERT_TRUE(is_rod(beam));
  ASSERT_FALSE(is_plain(beam));
  const BeamMatrices matrices = general_beam(beam);
  Matrix12 expected = Matrix12::Zero();
  for (const auto& [i, k] : {std::pair{0, E * 2e-4 / 1.3}, std::pair{3, G * 3e-9 / 1.3}}) {
    expected(i, i) = expected(i + 6, i + 6) = k;
    expected(i, i + 6) = expected(i + 6, i) = -k;
  }
  EXPECT_LT((matrices.stiffness - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.maxCoeff());
  const double m = (rho * 2e-4 + 0.5) * 1.3;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(matrices.mass(i, i), m / 3, 1e-14);
    EXPECT_NEAR(matrices.mass(i, i + 6), m / 6, 1e-14);
  }
  EXPECT_EQ(matrices.mass.diagonal().segment<3>(3).cwiseAbs().maxCoeff(), 0.0);
}

TEST(GeneralBeam, NamesWhatIsNotPositive) {
  BeamElementData beam = beam_with(odd_section(), 1.0);
  EXPECT_FALSE(general_beam_fault(beam));
  beam.section.second_moment_yz = 6e-6;  // more than √(Iy Iz)
  EXPECT_NE(general_beam_fault(beam)->find("principal second moment"), std::string::npos);
  beam = beam_with(odd_section(), 1.0);
  beam.section.torsion_constant = 0.0;
  EXPECT_NE(general_beam_fault(beam)->find("torsion constant is 0 "), std::string::npos);
  beam.stations = {odd_section(), odd_section()};
  beam.stations[1].area = -1e-3;
  EXPECT_NE(general_beam_fault(beam)->find("area"), std::string::npos);
}

}  // namespace
}  // namespace tisserand::reducer::beam_general_test
