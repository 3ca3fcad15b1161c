// SPDX-License-Identifier: GPL-3.0-or-later
// Nastran decks: materials and properties against formulas.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "reducer/properties/laminate.hpp"
#include "tests/reducer/decks/nastran_deck.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::testing::nastran_properties_test {
namespace {

using Eigen::Matrix3d;
using ::testing::HasSubstr;
using namespace reducer;

const std::string grids = "GRID,1\nGRID,2,,2.\nGRID,3,,2.,2.\nGRID,4,,0.,2.\n";
const std::string steel = "MAT1,7,2.1+11,,.3,7800.\n";

BeamElementData bar(const std::string& cards) {
  return read_deck(grids + cards + "CBAR,11,5,1,2,0.,1.,0.\n").mesh.beam_properties.at(0).data;
}

BeamElementData beam(const std::string& cards) {
  return read_deck(grids + cards + "CBEAM,11,5,1,2,0.,1.,0.\n").mesh.beam_properties.at(0).data;
}

TEST(NastranMaterials, TwoOfThreeConstants) {
  const std::string section = "PBAR,5,7,.02,3.-4,4.-4,5.-4\n";
  const double E = 2.1e11, nu = 0.3, G = E / 2.6;
  for (const char* card :
       {"MAT1,7,2.1+11,,.3\n", "MAT1,7,2.1+11,8.0769230769230769+10\n", "MAT1,7,,8.0769230769230769+10,.3\n"}) {
    const formats::Material m = bar(section + card).material;
    EXPECT_NEAR(m.youngs_modulus / E, 1.0, 1e-12) << card;
    EXPECT_NEAR(m.shear_modulus() / G, 1.0, 1e-12) << card;
    EXPECT_NEAR(m.poisson_ratio, nu, 1e-12) << card;
  }
  EXPECT_NEAR(bar(section + "MAT1,7,2.1+11,5.+10,.3\n").material.shear_modulus() / 5e10, 1.0, 1e-12);  // beams use G
  const std::string fault = fault_of(grids + section + "MAT1,7,2.1+11\nCBAR,11,5,1,2,0.,1.,0.\n");
  EXPECT_THAT(fault, HasSubstr("PBAR 5: MAT1 7 gives no E and G"));
  EXPECT_THAT(fault_of(grids + section + "MAT1,7,-1.,,.3\nCBAR,11,5,1,2,0.,1.,0.\n"),
              HasSubstr("MAT1 7: E -1 must be positive"));
  EXPECT_THAT(fault_of(grids + section + "CBAR,11,5,1,2,0.,1.,0.\n"),
              HasSubstr("PBAR 5: MID names material 7, which is missing"));
}

TEST(NastranBeamProperties, PbarByConstants) {
  const BeamElementData data = bar("PBAR,5,7,.02,3.-4,4.-4,5.-4,1.5\n,,,,,,,,\n,.8,.9\n" + steel);
  EXPECT_EQ(data.section.area, 0.02);
  EXPECT_EQ(data.section.second_moment_z, 3e-4);  // plane 1 is x-y
  EXPECT_EQ(data.section.second_moment_y, 4e-4);
  EXPECT_EQ(data.section.torsion_constant, 5e-4);
  EXPECT_DOUBLE_EQ(data.section.polar_moment, 7e-4);
  EXPECT_DOUBLE_EQ(data.section.shear_area_y, 0.016);
  EXPECT_DOUBLE_EQ(data.section.shear_area_z, 0.018);
  EXPECT_EQ(data.added_mass.first, 1.5);
  EXPECT_EQ(data.added_mass.second, 1.5);
  EXPECT_EQ(data.mass_matrix, formats::MassMatrix::lumped);
  const BeamElementData plain = bar("PARAM,COUPMASS,1\nPARAM,WTMASS,.001\nPBAR,5,7,.02,3.-4,4.-4,5.-4,1.5\n" + steel);
  EXPECT_EQ(plain.section.shear_area_y, 0.0);
  EXPECT_EQ(plain.mass_matrix, formats::MassMatrix::consistent);
  EXPECT_EQ(plain.rotary_inertia, RotaryInertia::without);
  EXPECT_DOUBLE_EQ(plain.material.density, 7.8);
  EXPECT_DOUBLE_EQ(plain.added_mass.first, 1.5e-3);
  // With I12 Nastran ignores K1 and K2.
  const BeamElementData turned = bar("PBAR,5,7,.02,3.-4,4.-4,5.-4\n,,,,,,,,\n,.8,.9,1.-4\n" + steel);
  EXPECT_EQ(turned.section.second_moment_yz, 1e-4);
  EXPECT_EQ(turned.section.shear_area_y, 0.0);
}

TEST(NastranBeamProperties, PbarlByShape) {
  // BAR: DIM1 along z, DIM2 along y of the element (QRG): I1 = DIM1 DIM2³/12.
  const BeamElementData data = bar("PBARL,5,7,,BAR\n,.02,.03,1.5\n" + steel);
  EXPECT_NEAR(data.section.area, 6e-4, 1e-15);
  EXPECT_NEAR(data.section.second_moment_z, 0.02 * std::pow(0.03, 3) / 12.0, 1e-18);
  EXPECT_NEAR(data.section.second_moment_y, 0.03 * std::pow(0.02, 3) / 12.0, 1e-18);
  EXPECT_EQ(data.added_mass.first, 1.5);
  EXPECT_NEAR(bar("PBARL,5,7,,ROD\n,.1\n" + steel).section.area, std::numbers::pi * 0.01, 1e-9);
  const std::string element = "CBAR,11,5,1,2,0.,1.,0.\n" + grids + steel;
  EXPECT_THAT(fault_of("PBARL,5,7,,STAR\n,.1\n" + element), HasSubstr("main.bdf:1: PBARL 5"));
  EXPECT_THAT(fault_of("PBARL,5,7,,BAR\n,.1\n" + element), HasSubstr("PBARL 5: DIM2 is blank"));
}

TEST(NastranBeamProperties, PbeamPrismaticAndTapered) {
  const BeamElementData plain = beam("PBEAM,5,7,.02,3.-4,4.-4,,5.-4,1.5\n" + steel);
  EXPECT_TRUE(plain.stations.empty());
  EXPECT_EQ(plain.section.shear_area_y, 0.02);  // K1 and K2 are 1 if blank
  EXPECT_EQ(plain.section.second_moment_z, 3e-4);
  const BeamElementData tapered = beam(
      "PBEAM,5,7,.02,3.-4,4.-4,,5.-4,1.5\n,1.,2.\n,YES,1.,.01,2.-4,3.-4,,4.-4,.5\n,1.,2.\n,.8,.9,,,.6,.4\n,.1,.2,.1,.2,"
      ".01,.02,.03,.04\n" +
      steel);
  ASSERT_EQ(tapered.stations.size(), 2u);
  EXPECT_EQ(tapered.stations[1].area, 0.01);
  EXPECT_EQ(tapered.stations[1].second_moment_z, 2e-4);
  EXPECT_EQ(tapered.stations[1].second_moment_y, 3e-4);
  EXPECT_DOUBLE_EQ(tapered.stations[1].shear_area_z, 0.009);
  EXPECT_EQ(tapered.stations[0].centroid_y, 0.01);
  EXPECT_EQ(tapered.stations[1].centroid_z, 0.04);
  EXPECT_EQ(tapered.stations[1].shear_center_z, -0.04);
  EXPECT_EQ(tapered.added_mass.second, 0.5);
  EXPECT_DOUBLE_EQ(tapered.added_mass.inertia, 0.5);
  EXPECT_DOUBLE_EQ(tapered.added_mass.offset_y, 0.1);
  const BeamElementData shaped = beam("PBEAML,5,7,,BAR\n,.02,.03,1.5,NO,1.,.01,.02,.5\n" + steel);
  ASSERT_GE(shaped.stations.size(), 2u);
  EXPECT_NEAR(shaped.stations.back().area, 2e-4, 1e-15);
  EXPECT_EQ(shaped.added_mass.second, 0.5);
}

ShellSection shell(const std::string& cards) {
  return read_deck(grids + cards + "CQUAD4,11,5,1,2,3,4\n").mesh.shell_properties.at(0).section;
}

void expect_close(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  EXPECT_LT((a - b).norm(), 1e-12 * b.norm() + 1e-300) << a << "\ninstead of\n" << b;
}

TEST(NastranShellProperties, PshellOfOneMaterialIsAnIsotropicSheet) {
  const ShellSection expected = isotropic_shell(2.1e11, 0.3, 7800.0, 0.01, 5.0 / 6.0);
  for (const char* card :
       {"PSHELL,5,7,.01,7,,7\n", "PSHELL,5,7,.01,7\n", "PSHELL,5,7,.01,7,1.,7,.8333333333333333\n"}) {
    const ShellSection s = shell(card + steel);
    expect_close(s.A, expected.A);
    expect_close(s.D, expected.D);
    expect_close(s.As, expected.As);
    EXPECT_TRUE(s.B.isZero());
    EXPECT_DOUBLE_EQ(s.mass, expected.mass);
    EXPECT_DOUBLE_EQ(s.rotary_inertia, expected.rotary_inertia);
  }
  const ShellSection other = shell("PSHELL,5,7,.01,7,2.5,7,.5,3.\n" + steel);
  expect_close(other.D, 2.5 * expected.D);
  expect_close(other.As, 0.6 * expected.As);
  EXPECT_DOUBLE_EQ(other.mass, 81.0);
}

TEST(NastranShellProperties, PshellByMatricesEqualsThePcompThatTheyDescribe) {
  // QRG of PCOMP: G1 = ∫G dz/T, G2 = 12 ∫z² G dz/T³, G4 = −∫z G dz/T²: two layers of 0.004 and 0.006.
  const std::string plies = "PCOMP,5\n,7,.004,0.,,8,.006,0.\nMAT1,7,2.1+11,,.3\nMAT1,8,7.+10,,.3\n";
  const ShellSection expected = shell(plies);
  const auto card = [](int id, const Matrix3d& G) {
    return fmt::format("MAT2,{},{:.16g},{:.16g},{:.16g},{:.16g},{:.16g},{:.16g}\n", id, G(0, 0), G(0, 1), G(0, 2),
                       G(1, 1), G(1, 2), G(2, 2));
  };
  const double T = 0.01;
  const std::string cards = card(21, expected.A / T) + card(22, 12.0 / (T * T * T) * expected.D) +
                            card(24, -1.0 / (T * T) * expected.B) + "PSHELL,5,21,.01,22,,22\n,,,24\n";
  const ShellSection s = shell(cards);
  expect_close(s.A, expected.A);
  expect_close(s.B, expected.B);
  expect_close(s.D, expected.D);
  EXPECT_GT(expected.B.norm(), 0.0);
}

TEST(NastranShellProperties, PcompStacks) {
  const std::string carbon = "MAT8,7,1.4+11,1.+10,.3,5.+9,5.+9,3.5+9,1600.\n";
  const auto ply = [](double angle) {
    return Ply{1.4e11, 1e10, 0.3, 5e9, 5e9, 3.5e9, 1600.0, 1e-3, angle * std::numbers::pi / 180.0};
  };
  const ShellSection full = shell("PCOMP,5\n,7,1.-3,0.,,7,1.-3,45.\n,7,1.-3,45.,,7,1.-3,0.\n" + carbon);
  const ShellSection expected = laminate({ply(0), ply(45), ply(45), ply(0)}, -2e-3);
  for (const ShellSection& s : {full, shell("PCOMP,5,,,,,,,SYM\n,7,1.-3,0.,,,,45.\n" + carbon)}) {
    expect_close(s.A, expected.A);
    expect_close(s.D, expected.D);
    expect_close(s.As, expected.As);
    EXPECT_DOUBLE_EQ(s.mass, 6.4);
  }
  const Deck deck = read_deck(grids + "PCOMP,5,.001\n,7,1.-3,0.\n" + carbon + "CQUAD4,11,5,1,2,3,4,,.25\n");
  EXPECT_DOUBLE_EQ(deck.mesh.shells[0].offset, 0.25 + 0.001 + 0.5e-3);
  const std::string element = "CQUAD4,11,5,1,2,3,4\n" + grids + carbon;
  EXPECT_THAT(fault_of("PCOMP,5,,,,,,,SMEAR\n,7,1.-3\n" + element), HasSubstr("PCOMP 5: LAM 'SMEAR'"));
  EXPECT_THAT(fault_of("PCOMP,5\n,7,-1.-3\n" + element), HasSubstr("main.bdf:1: PCOMP 5"));
  EXPECT_THAT(fault_of("PCOMP,5\n" + element), HasSubstr("no plies"));
  EXPECT_THAT(fault_of("PSHELL,5,7,.01,-1\n" + element), HasSubstr("plane strain"));
  EXPECT_THAT(fault_of("PSHELL,5,7,,7\n" + element), HasSubstr("PSHELL 5: T is blank"));
}

TEST(NastranSolidProperties, IsotropicAndAnisotropic) {
  const std::string tetra = "GRID,5,,0.,0.,1.\nCTETRA,11,5,1,2,4,5\n" + grids;
  const SolidMaterial steel_solid = isotropic_solid(2.1e11, 0.3, 7800.0);
  expect_close(read_deck(tetra + steel + "PSOLID,5,7\n").mesh.solid_properties.at(0).material.C, steel_solid.C);
  // The same by MAT9; then with different stiffness along 1, in a system whose x is basic y.
  const double a = steel_solid.C(0, 0), b = steel_solid.C(0, 1), g = steel_solid.C(3, 3);
  const auto mat9 = [&](double first) {
    return fmt::format(
        "MAT9,7,{0:.17g},{1:.17g},{1:.17g},,,,{2:.17g}\n,{1:.17g},,,,{2:.17g},,,\n,{3:.17g},,,{3:.17g},,{3:.17g},7800."
        "\n",
        first, b, a, g);
  };
  const std::string frame = "CORD2R,9,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n";
  expect_close(read_deck(tetra + mat9(a) + "PSOLID,5,7\n").mesh.solid_properties.at(0).material.C, steel_solid.C);
  Eigen::Matrix<double, 6, 6> turned = steel_solid.C;
  turned(1, 1) = 2.0 * a;
  expect_close(read_deck(tetra + frame + mat9(2.0 * a) + "PSOLID,5,7,9\n").mesh.solid_properties.at(0).material.C,
               turned);
  EXPECT_THAT(fault_of(tetra + mat9(a) + "PSOLID,5,7,8\n"), HasSubstr("PSOLID 5: CORDM names coordinate system 8"));
  EXPECT_THAT(fault_of(tetra + mat9(-a) + "PSOLID,5,7\n"), HasSubstr("PSOLID 5: MAT9 7"));
}

/// MID2 blank: no bending; MID1 blank: no membrane. Each has its part of the stiffness of the whole sheet.
TEST(NastranShellProperties, MembraneOrBendingAlone) {
  const auto stiffness = [](const std::string& property) {
    return Eigen::MatrixXd(
        assemble_small(read_deck(grids + steel + property + "CQUAD4,11,5,1,2,3,4\nCTRIA3,12,5,1,2,3\n").mesh).S);
  };
  const Eigen::MatrixXd whole = stiffness("PSHELL,5,7,.1,7\n"), membrane = stiffness("PSHELL,5,7,.1\n"),
                        bending = stiffness("PSHELL,5,,.1,7\n");
  EXPECT_LT((membrane + bending - whole).norm(), 1e-14 * whole.norm());
  for (Eigen::Index i = 0; i < whole.rows(); ++i) {
    const bool in_plane = i % 6 < 2 || i % 6 == 5;
    EXPECT_EQ((in_plane ? bending : membrane).row(i).norm(), 0.0) << i;
    EXPECT_GT((in_plane ? membrane : bending).row(i).norm(), 0.0) << i;
  }
}

}  // namespace
}  // namespace tisserand::testing::nastran_properties_test
