// SPDX-License-Identifier: GPL-3.0-or-later
// Published statics of plates and shells: coarse meshes within 3 to 7 %, fine ones within 1 to 2 %.
#include <gtest/gtest.h>

#include "reducer/elements/shell/stiffness.hpp"
#include "tests/problems/shell_statics.hpp"
#include "tests/reducer/elements/shell_cases.hpp"

namespace tisserand::reducer::shell_benchmarks_test {
namespace {

using Eigen::VectorXd;
using std::numbers::pi;

constexpr auto quads = Facets::quadrilaterals;
constexpr auto triangles = Facets::triangles;

struct Expectation {
  ShellMesh mesh;
  double error;  ///< accepted, relative
};

void expect_near(double value, double target, const Expectation& e) {
  EXPECT_NEAR(value / target, 1.0, e.error) << (e.mesh.facets == quads ? "quadrilaterals " : "triangles ") << e.mesh.n;
}

/// Refined shell meshes give 0.3020 at the middle of the free edge (FinEtoolsFlexStructures, commit d7ccda5).
TEST(ShellBenchmark, ScordelisLoRoof) {
  for (const Expectation& e : {Expectation{{quads, 4}, 0.07},
                               {{quads, 8}, 0.02},
                               {{quads, 16}, 0.01},
                               {{triangles, 4}, 0.05},
                               {{triangles, 16}, 0.01}})
    expect_near(scordelis_lo_roof(e.mesh), 0.3020, e);
}

/// 1.8248e-5 (FinEtoolsFlexStructures; the classical double series).
TEST(ShellBenchmark, PinchedCylinderWithDiaphragms) {
  for (const Expectation& e : {Expectation{{quads, 16}, 0.06}, {{quads, 32}, 0.01}, {{triangles, 16}, 0.01}})
    expect_near(pinched_cylinder(e.mesh), 1.8248e-5, e);
}

/// Thick: Zupan and Saje 2004; t = 0.05 and t = 0.0032: values that go with the MITC4+ shell (unit load).
TEST(ShellBenchmark, TwistedBeam) {
  for (const Expectation& e : {Expectation{{quads, 1}, 0.005}, {{triangles, 1}, 0.01}}) {
    expect_near(twisted_beam(e.mesh, 0.32, TipLoad::in_plane), 0.005424534868469, e);
    expect_near(twisted_beam(e.mesh, 0.32, TipLoad::out_of_plane), 0.001753248285256, e);
  }
  const Expectation coarse{{quads, 1}, 0.01};
  expect_near(twisted_beam(coarse.mesh, 0.05, TipLoad::in_plane), 1.3879, coarse);
  expect_near(twisted_beam(coarse.mesh, 0.05, TipLoad::out_of_plane), 0.3431, coarse);
  expect_near(twisted_beam(coarse.mesh, 0.0032, TipLoad::in_plane), 5256.0, coarse);
  expect_near(twisted_beam(coarse.mesh, 0.0032, TipLoad::out_of_plane), 1294.0, coarse);
  const Expectation finer{{triangles, 2}, 0.03};
  expect_near(twisted_beam(finer.mesh, 0.05, TipLoad::in_plane), 1.3879, finer);
}

/// Hemisphere with an 18° hole under two pairs of unit forces, 0.0930 to 0.0940 in print for R/t = 250.
TEST(ShellBenchmark, PinchedHemisphere) {
  for (const Expectation& e : {Expectation{{quads, 8}, 0.04}, {{quads, 16}, 0.01}, {{triangles, 24}, 0.03}})
    expect_near(pinched_hemisphere(e.mesh, 0.04), 0.0940, e);
}

/// Bending without stretching grows with t⁻³. Flat facets on a doubly curved surface need h² of the order of R t.
TEST(ShellBenchmark, ThinHemisphereConverges) {
  const double limit = 0.0935 * std::pow(0.04 / 0.004, 3.0);
  EXPECT_GT(pinched_hemisphere({quads, 16}, 0.004) / limit, 0.9);
  EXPECT_NEAR(pinched_hemisphere({quads, 32}, 0.004) / limit, 1.0, 0.03);
}

/// A slit ring under two opposite forces at the slit opens by 3π F R³/(E I) without stretching, whatever R/t
/// (Castigliano, I = b t³/12; ν = 0). 36 facets on the circle; thick: shear and stretch add about 0.2 (t/R)².
TEST(ShellBenchmark, RingOpensAlikeFromThickToThin) {
  for (const Facets facets : {quads, triangles})
    for (const double thinness : {20.0, 1e2, 1e3, 1e4})
      EXPECT_NEAR(ring_opening(facets, thinness) / (3.0 * pi), 1.0, 0.01) << "R/t " << thinness;
}

/// 23.96 at the middle of the loaded edge.
TEST(ShellBenchmark, CooksMembrane) {
  for (const Expectation& e :
       {Expectation{{quads, 4}, 0.03}, {{quads, 16}, 0.006}, {{triangles, 8}, 0.04}, {{triangles, 32}, 0.01}})
    expect_near(cooks_membrane(e.mesh), 23.96, e);
}

TEST(ShellBenchmark, StraightBeamOfSixElements) {
  for (const Distortion distortion : {Distortion::none, Distortion::trapezoids, Distortion::parallelograms}) {
    EXPECT_NEAR(straight_beam({quads, 1}, distortion, TipLoad::extension) / 3.0e-5, 1.0, 0.02);
    // membranes without drilling: 0.05 to 0.9
    EXPECT_NEAR(straight_beam({quads, 1}, distortion, TipLoad::in_plane) / 0.1081, 1.0, 0.03);
    EXPECT_NEAR(straight_beam({quads, 1}, distortion, TipLoad::out_of_plane) / 0.4321, 1.0, 0.04);
  }
}

/// Torsion: Saint-Venant's 6/(G J) = 0.03411 with J = 4.574e-5 of the rectangle 0.2 x 0.1 (series). [MH85] prints
/// 0.03208, 6 % less, which refined meshes pass. Shear strains live within t/√10 of the edges, so cells of 0.025 are
/// not yet fine; the triangles are still near 0.0234, torsion without them.
TEST(ShellBenchmark, TwistOfTheStraightBeam) {
  EXPECT_NEAR(straight_beam({quads, 8}, Distortion::none, TipLoad::twist) / 0.03411, 1.0, 0.01);
  EXPECT_NEAR(straight_beam({triangles, 16}, Distortion::none, TipLoad::twist) / 0.03411, 1.0, 0.07);
}

/// In plane: exact plane stress of the bar bent by a radial force at its end, π (a² + b²)/(E t ((a² - b²) + (a² + b²)
/// ln(b/a))) = 0.088566 (Timoshenko and Goodier, Theory of Elasticity, article 33); [MH85] prints 0.08734, 1.4 % less.
/// Out of plane: 0.5022 ([MH85]; beams without shear 0.5003), with torsion, which converges slowly as above.
TEST(ShellBenchmark, CurvedBeam) {
  for (const Expectation& e : {Expectation{{quads, 1}, 0.01}, {{quads, 4}, 0.003}, {{triangles, 4}, 0.005}})
    expect_near(curved_beam(e.mesh, TipLoad::in_plane), 0.088566, e);
  for (const Expectation& e : {Expectation{{quads, 1}, 0.05}, {{quads, 16}, 0.01}, {{triangles, 16}, 0.035}})
    expect_near(curved_beam(e.mesh, TipLoad::out_of_plane), 0.5022, e);
}

struct PlateCase {
  RectangularPlate plate;
  double target;
};

/// Square plate a = 2, unit of [MH85]: clamped or simply supported, centre force or pressure; thin: t/L = 5e-5.
TEST(ShellBenchmark, ThinSquarePlates) {
  for (const Expectation& e :
       {Expectation{{quads, 4}, 0.03}, {{quads, 16}, 0.01}, {{triangles, 4}, 0.04}, {{triangles, 16}, 0.01}})
    for (const PlateCase& c : {PlateCase{{2.0, PlateEdges::simply_supported, PlateLoad::pressure}, 4.062},
                               {{2.0, PlateEdges::simply_supported, PlateLoad::force}, 11.60},
                               {{2.0, PlateEdges::clamped, PlateLoad::pressure}, 1.265},
                               {{2.0, PlateEdges::clamped, PlateLoad::force}, 5.612}})
      expect_near(plate_deflection(e.mesh, c.plate), c.target, e);
}

/// Plate with b = 10. Simply supported: Navier's series, 12.971 and 16.961. Clamped: ends do not matter for b = 5 a
/// (e^-10), the pressure bends a strip, q a⁴/(384 D) = 2.604 ([MH85]: 2.56). Force: 7.23 in [MH85].
TEST(ShellBenchmark, ThinLongPlates) {
  for (const Expectation& e : {Expectation{{quads, 8}, 0.06}, {{quads, 24}, 0.01}, {{triangles, 24}, 0.01}})
    for (const PlateCase& c : {PlateCase{{10.0, PlateEdges::simply_supported, PlateLoad::pressure}, 12.971},
                               {{10.0, PlateEdges::simply_supported, PlateLoad::force}, 16.961},
                               {{10.0, PlateEdges::clamped, PlateLoad::pressure}, 2.604},
                               {{10.0, PlateEdges::clamped, PlateLoad::force}, 7.23}})
      expect_near(plate_deflection(e.mesh, c.plate), c.target, e);
}

/// Target -111.2 MPa, converged (FinEtoolsFlexStructures). NAFEMS gives -108 MPa with a coarse mesh.
TEST(ShellBenchmark, ZSectionUnderTorque) {
  for (const Expectation& e : {Expectation{{quads, 2}, 0.05}, {{quads, 4}, 0.015}, {{triangles, 4}, 0.02}})
    expect_near(z_section_stress(e.mesh), -111.2e6, e);
}

/// Targets 0.014444 = π C and 0.013793 = C L/R with T = 4π D (1-ν) C/R (Morris; NAFEMS P12).
TEST(ShellBenchmark, SlitCylinderWarps) {
  for (const Expectation& e : {Expectation{{quads, 2}, 0.005}, {{triangles, 2}, 0.01}}) {
    const SlitCylinder ours = slit_cylinder(e.mesh);
    expect_near(ours.axial, 0.014444, e);
    expect_near(ours.circumferential, 0.013793, e);
  }
}

/// The stabilisation factors of the membrane hardly change the in-plane bending energy of one distorted element. Ten
/// times less or more of the quadratic modes changes it by less than 1 %. Three times less or more of the mean drilling
/// rotation changes it by less than 3 %.
TEST(ShellDrilling, FactorsHardlyMatter) {
  const Mesh mesh = one_shell(distorted_quad(), steel(0.01));
  const ShellGeometry<4> geometry = shell_geometry<4>(mesh, mesh.shells[0]);
  VectorXd u = VectorXd::Zero(24);  // pure bending: u = xy, v = -(x² + ν y²)/2, θ = -x
  for (int i = 0; i < 4; ++i) {
    const double px = geometry.corner(0, i), py = geometry.corner(1, i);
    u[6 * i] = px * py;
    u[6 * i + 1] = -0.5 * (px * px + 0.3 * py * py);
    u[6 * i + 5] = -px;
  }
  const auto energy = [&](double mean, double quadratic) {
    return u.dot(quad_stiffness(geometry, steel(0.01), {mean, quadratic}) * u);
  };
  const double usual = energy(usual_drilling.mean, usual_drilling.quadratic);
  for (const double factor : {0.1, 10.0})
    EXPECT_NEAR(energy(usual_drilling.mean, usual_drilling.quadratic * factor) / usual, 1.0, 0.01);
  for (const double factor : {0.3, 3.0})
    EXPECT_NEAR(energy(usual_drilling.mean * factor, usual_drilling.quadratic) / usual, 1.0, 0.03);
}

}  // namespace
}  // namespace tisserand::reducer::shell_benchmarks_test
