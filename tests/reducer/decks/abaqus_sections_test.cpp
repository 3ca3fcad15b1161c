// SPDX-License-Identifier: GPL-3.0-or-later
// Materials and sections of Abaqus decks: every form gives the property that the manual of its keyword describes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "formats/sections/shapes.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/properties/solid_anisotropic.hpp"
#include "tests/reducer/decks/abaqus_deck.hpp"

namespace tisserand::reducer::abaqus_sections_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The plate of abaqus_plate with another section.
std::string plate(const std::string& section) {
  return abaqus_plate.substr(0, abaqus_plate.find("*SHELL SECTION")) + section;
}
std::string carbon() {
  return "*MATERIAL, NAME=ply\n*ELASTIC, TYPE=LAMINA\n140e3, 9e3, 0.3, 5e3, 4e3, 3e3\n*DENSITY\n1.6e-9\n";
}

/// A tetrahedron in the set block.
std::string block(const std::string& rest) {
  return "*NODE\n1, 0,0,0\n2, 1,0,0\n3, 0,1,0\n4, 0,0,1\n*ELEMENT, TYPE=C3D4, ELSET=Block\n1, 1,2,3,4\n" + rest;
}

TEST(AbaqusSections, IsotropicShell) {
  const Deck deck = abaqus_deck(abaqus_plate);
  ASSERT_EQ(deck.mesh.shells.size(), 1u);
  EXPECT_EQ(deck.mesh.shells[0].nodes, (std::array<int, 4>{0, 1, 2, 3}));
  EXPECT_EQ(deck.mesh.shells[0].offset, 0.0);
  EXPECT_TRUE(deck.mesh.shells[0].material_x.isZero());
  const ShellSection& section = deck.mesh.shell_properties[0].section;
  EXPECT_NEAR(section.D(0, 0), 2.1e5 * 0.125 / (12.0 * 0.91), 1e-9);  // E t³/(12 (1 − ν²))
  EXPECT_NEAR(section.As(0, 0), 5.0 / 6.0 * 2.1e5 / 2.6 * 0.5, 1e-9);
  EXPECT_NEAR(section.mass, 7.85e-9 * 0.5, 1e-20);
  EXPECT_EQ(deck.mesh.shell_properties[0].name, "plate");
}

TEST(AbaqusSections, OffsetIsMeasuredFromTheMiddleToTheNodesInThicknesses) {
  const auto offset = [](const std::string& value) {
    return abaqus_deck(plate("*SHELL SECTION, ELSET=plate, MATERIAL=steel, OFFSET=" + value + "\n0.5\n"))
        .mesh.shells[0]
        .offset;
  };
  EXPECT_EQ(offset("SPOS"), -0.25);  // nodes on the positive face: the middle lies below them
  EXPECT_EQ(offset("sneg"), 0.25);
  EXPECT_EQ(offset("0.2"), -0.1);
  EXPECT_THAT(abaqus_error(plate("*SHELL SECTION, ELSET=plate, MATERIAL=steel, OFFSET=up\n0.5\n")),
              HasSubstr("OFFSET=up"));
}

TEST(AbaqusSections, CompositeIsALaminateInTheAxesOfItsOrientation) {
  const Deck deck = abaqus_deck(plate(carbon() + "*ORIENTATION, NAME=Fibre\n0., 1., 0., -1., 0., 0.\n3, 30.\n"
                                                 "*SHELL SECTION, ELSET=plate, COMPOSITE, ORIENTATION=fibre\n"
                                                 "0.2, 3, Ply, 0.\n0.1, 3, Ply, 90.\n0.3, , steel, \n"));
  std::vector<Ply> plies(3);
  plies[0] = {140e3, 9e3, 0.3, 5e3, 4e3, 3e3, 1.6e-9, 0.2, 0.0};
  plies[1] = plies[0];
  plies[1].thickness = 0.1;
  plies[1].angle = M_PI / 2.0;
  const double G = 2.1e5 / 2.6;
  plies[2] = {2.1e5, 2.1e5, 0.3, G, G, G, 7.85e-9, 0.3, 0.0};
  const ShellSection expected = laminate(plies, -0.3);
  const ShellSection& section = deck.mesh.shell_properties[0].section;
  EXPECT_LT((section.A - expected.A).norm(), 1e-14 * expected.A.norm());
  EXPECT_LT((section.B - expected.B).norm(), 1e-14 * expected.B.norm());
  EXPECT_LT((section.D - expected.D).norm(), 1e-14 * expected.D.norm());
  EXPECT_EQ(section.mass, expected.mass);
  // Axis 3 is chosen, so x, which is the global y turned by 30° about z, is projected.
  const double c = std::cos(M_PI / 6.0), s = 0.5;
  EXPECT_LT((deck.mesh.shells[0].material_x - Eigen::Vector3d(-s, c, 0.0)).norm(), 1e-15);
}

TEST(AbaqusSections, LayersWithOrientationsOfTheirOwn) {
  const std::string layers =
      carbon() +
      "*ORIENTATION, NAME=o1\n0., 1., 0., -1., 0., 0.\n3, 0.\n*ORIENTATION, NAME=o2\n0., 1., 0., -1., 0., 0.\n3, 30.\n"
      "*SHELL SECTION, ELSET=plate, COMPOSITE\n0.2, , ply, o1\n0.1, , ply, o2\n";
  const auto expected = [](double angle) {
    std::vector<Ply> plies(2, {140e3, 9e3, 0.3, 5e3, 4e3, 3e3, 1.6e-9, 0.2, 0.0});
    plies[1].thickness = 0.1;
    plies[1].angle = angle;
    return laminate(plies, -0.15);
  };
  const Deck deck = abaqus_deck(plate(layers));
  EXPECT_LT((deck.mesh.shells[0].material_x - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((deck.mesh.shell_properties[0].section.A - expected(M_PI / 6.0).A).norm(), 1e-9);
  // Seen from the other side the same fibres turn the other way.
  std::string turned = plate(layers);
  turned.replace(turned.find("1, 1, 2, 3, 4"), 13, "1, 4, 3, 2, 1");
  const Deck other = abaqus_deck(turned);
  EXPECT_LT((other.mesh.shell_properties[0].section.A - expected(-M_PI / 6.0).A).norm(), 1e-9);
  const std::string both = "*ELEMENT, TYPE=S4, ELSET=plate\n2, 4, 3, 2, 1\n";
  EXPECT_THAT(abaqus_error(plate(both + layers)), HasSubstr("both sides"));
}

TEST(AbaqusSections, LaminaWithoutOrientationLiesAlongTheGlobalX) {
  const Deck deck = abaqus_deck(plate(carbon() + "*SHELL SECTION, ELSET=plate, MATERIAL=ply\n0.5\n"));
  EXPECT_EQ(deck.mesh.shells[0].material_x, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(deck.mesh.shell_properties[0].section.A(0, 0), 140e3 * 0.5 / (1.0 - 0.09 * 9.0 / 140.0), 1e-6);
}

TEST(AbaqusSections, EngineeringConstantsAndTheirMatrixAreTheSameMaterial) {
  // Spruce-like constants; the second deck has the matrix of the first.
  OrthotropicConstants constants;
  constants.E1 = 12e3, constants.E2 = 0.8e3, constants.E3 = 0.5e3;
  constants.nu12 = 0.4, constants.nu13 = 0.45, constants.nu23 = 0.3;
  constants.G12 = 0.7e3, constants.G31 = 0.6e3, constants.G23 = 0.05e3;
  const Eigen::Matrix<double, 6, 6> C = orthotropic_elasticity(constants, "");
  const std::string end =
      "*DENSITY\n4e-10\n*ORIENTATION, NAME=o\n0,1,0, 0,0,1\n*SOLID SECTION, ELSET=block, MATERIAL=wood, "
      "ORIENTATION=o\n";
  const Deck first =
      abaqus_deck(block("*MATERIAL, NAME=wood\n*ELASTIC, TYPE=ENGINEERING "
                        "CONSTANTS\n12e3,0.8e3,0.5e3,0.4,0.45,0.3,0.7e3,0.6e3\n0.05e3\n" +
                        end));
  const Deck second =
      abaqus_deck(block(fmt::format("*MATERIAL, NAME=wood\n*ELASTIC, TYPE=ORTHOTROPIC\n{},{},{},{},{},{},{},{},\n{}\n",
                                    C(0, 0), C(0, 1), C(1, 1), C(0, 2), C(1, 2), C(2, 2), C(3, 3), C(5, 5), C(4, 4)) +
                        end));
  const auto& a = first.mesh.solid_properties[0].material;
  EXPECT_LT((a.C - second.mesh.solid_properties[0].material.C).norm(), 1e-12 * a.C.norm());
  EXPECT_EQ(a.density, 4e-10);
  // Material 1 is the global y: its modulus is seen there.
  EXPECT_NEAR(1.0 / a.C.inverse()(1, 1), 12e3, 1e-8);
  EXPECT_NEAR(1.0 / a.C.inverse()(2, 2), 0.8e3, 1e-9);
}

TEST(AbaqusSections, TrussesAreRodsWithoutBending) {
  const Deck deck = abaqus_deck("*NODE\n1,0,0,0\n2,0,0,2\n*ELEMENT, TYPE=T3D2, ELSET=rod\n1,1,2\n" + abaqus_steel +
                                "*SOLID SECTION, ELSET=rod, MATERIAL=steel\n3.5\n");
  const BeamElementData& data = deck.mesh.beam_properties[0].data;
  EXPECT_EQ(data.section.area, 3.5);
  EXPECT_EQ(data.section.second_moment_y + data.section.second_moment_z + data.section.torsion_constant, 0.0);
  EXPECT_EQ(data.material.youngs_modulus, 2.1e5);
}

TEST(AbaqusSections, BeamShapesAndTheirAxes) {
  const Deck deck =
      abaqus_deck(abaqus_bar("*BEAM SECTION, SECTION=RECT, ELSET=bar, MATERIAL=steel\n3., 5.\n0., 1., 0.\n"));
  const formats::Section& section = deck.mesh.beam_properties[0].data.section;
  EXPECT_NEAR(section.second_moment_y, 3.0 * 125.0 / 12.0, 1e-12);  // the side 5 lies along n2 = t x n1 = z
  EXPECT_NEAR(section.second_moment_z, 5.0 * 27.0 / 12.0, 1e-12);
  EXPECT_EQ(deck.mesh.beams[0].R_PE, Eigen::Matrix3d::Identity());
  EXPECT_EQ(deck.mesh.beam_properties[0].data.theory, formats::BeamTheory::timoshenko);

  const auto constants = [](const std::string& data) {
    return abaqus_deck(abaqus_bar("*BEAM SECTION, ELSET=bar, MATERIAL=steel, SECTION=" + data))
        .mesh.beam_properties[0]
        .data.section;
  };
  EXPECT_EQ(constants("CIRC\n2.\n").area, formats::circle_section(2.0).area);
  EXPECT_EQ(constants("CIRC\n2., 2.\n").area, formats::circle_section(1.0).area);  // CalculiX: diameters
  EXPECT_EQ(constants("PIPE\n2., 0.5\n").torsion_constant, formats::hollow_circle_section(2.0, 0.5).torsion_constant);
  EXPECT_NEAR(constants("BOX\n4., 6., 1., 1., 1., 1.\n").second_moment_y, (4.0 * 216.0 - 2.0 * 64.0) / 12.0, 1e-9);
  EXPECT_NEAR(constants("BOX\n4., 6., 1., 1., 1., 1.\n").second_moment_z, (6.0 * 64.0 - 4.0 * 8.0) / 12.0, 1e-9);
}

TEST(AbaqusSections, ISectionHangsOnItsNode) {
  // h = 10, lower flange 6 x 2, upper flange 4 x 1, web 7 x 0.5; node at the bottom: l = 0.
  const formats::Section section =
      abaqus_deck(abaqus_bar("*BEAM SECTION, ELSET=bar, MATERIAL=steel, SECTION=I\n0., 10., 6., 4., 2., 1., 0.5\n"))
          .mesh.beam_properties[0]
          .data.section;
  const double A = 12.0 + 4.0 + 3.5;
  const double center = (12.0 * 1.0 + 4.0 * 9.5 + 3.5 * 5.5) / A;
  EXPECT_NEAR(section.area, A, 1e-12);
  EXPECT_NEAR(section.centroid_z, center, 1e-12);
  EXPECT_NEAR(section.centroid_y, 0.0, 1e-12);
  const double I11 = 6.0 * 8.0 / 12.0 + 12.0 * std::pow(center - 1.0, 2) + 4.0 / 12.0 +
                     4.0 * std::pow(9.5 - center, 2) + 0.5 * 343.0 / 12.0 + 3.5 * std::pow(5.5 - center, 2);
  EXPECT_NEAR(section.second_moment_y, I11, 1e-10);
  EXPECT_NEAR(section.second_moment_z, (2.0 * 216.0 + 64.0 + 7.0 * 0.125) / 12.0, 1e-10);
}

TEST(AbaqusSections, GeneralSectionWithCentroidShearCenterAndShearStiffness) {
  const Deck deck = abaqus_deck(
      "*NODE\n1,0,0,0\n2,0,0,4\n*ELEMENT, TYPE=B33, ELSET=bar\n1,1,2\n"
      "*BEAM GENERAL SECTION, SECTION=GENERAL, ELSET=bar, DENSITY=2.\n"
      "10., 20., 3., 30., 40.\n"
      "1., 0., 0.\n"
      "100., 25.\n"
      "*CENTROID\n0.5, 0.25\n*SHEAR CENTER\n0.75, 0.5\n*TRANSVERSE SHEAR STIFFNESS\n50., 75.\n");
  const BeamElementData& data =
      deck.mesh.beam_properties.at(static_cast<std::size_t>(deck.mesh.beams[0].property)).data;
  EXPECT_EQ(data.theory, formats::BeamTheory::euler_bernoulli);
  EXPECT_EQ(data.material.shear_modulus(), 25.0);
  EXPECT_EQ(data.material.density, 2.0);
  EXPECT_EQ(data.section.second_moment_y, 20.0);  // I11 bends about n1
  EXPECT_EQ(data.section.second_moment_yz, 3.0);
  EXPECT_EQ(data.section.second_moment_z, 30.0);
  EXPECT_EQ(data.section.torsion_constant, 40.0);
  EXPECT_EQ(data.section.centroid_y, 0.5);
  EXPECT_EQ(data.section.shear_center_y, 0.25);  // from the centroid
  EXPECT_EQ(data.section.shear_center_z, 0.25);
  EXPECT_EQ(data.section.shear_area_z, 2.0);  // K23 / G
  EXPECT_EQ(data.section.shear_area_y, 3.0);
  EXPECT_EQ(deck.mesh.beams[0].R_PE.col(0), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(deck.mesh.beams[0].R_PE.col(1), Eigen::Vector3d::UnitX());
}

TEST(AbaqusSections, BlankLineKeepsTheUsualDirectionAndAThirdNodeGivesAnother) {
  const std::string section = "*BEAM GENERAL SECTION, SECTION=CIRC, ELSET=bar\n1.\n\n100., 40.\n";
  const Deck usual = abaqus_deck(abaqus_bar(section));
  EXPECT_EQ(usual.mesh.beams[0].R_PE.col(1), Eigen::Vector3d(0.0, 0.0, -1.0));
  const Deck third =
      abaqus_deck("*NODE\n1,0,0,0\n2,2,0,0\n3,0,5,0\n*ELEMENT, TYPE=B31, ELSET=bar\n1,1,2,3\n" + section);
  EXPECT_EQ(third.mesh.beams[0].R_PE.col(1), Eigen::Vector3d::UnitY());
}

TEST(AbaqusSections, MassesAndRotaryInertia) {
  const Deck deck = abaqus_deck(
      "*NODE\n1,0,0,0\n*ELEMENT, TYPE=MASS, ELSET=m\n1,1\n*ELEMENT, TYPE=ROTARYI, ELSET=r\n2,1\n*MASS, ELSET=m\n3.\n"
      "*ORIENTATION, NAME=turned\n0,1,0, -1,0,0\n"
      "*ROTARY INERTIA, ELSET=r, ORIENTATION=turned\n5., 6., 7., 1.\n");
  ASSERT_EQ(deck.mesh.masses.size(), 2u);
  EXPECT_EQ(deck.mesh.masses[0].mass, 3.0);
  Eigen::Matrix3d expected;
  expected << 6, -1, 0, -1, 5, 0, 0, 0, 7;  // x' = y, y' = -x
  EXPECT_LT((deck.mesh.masses[1].inertia - expected).norm(), 1e-14);
}

TEST(AbaqusSections, Springs) {
  const Deck deck = abaqus_deck(
      "*NODE\n1,0,0,0\n2,0,3,0\n3,0,0,0\n*ELEMENT, TYPE=SPRINGA, ELSET=a\n1,1,2\n*SPRING, ELSET=a\n\n50.\n"
      "*ELEMENT, TYPE=SPRING2, ELSET=b\n2,1,3\n*SPRING, ELSET=b\n5, 5\n8.\n");
  ASSERT_EQ(deck.mesh.springs.size(), 2u);
  Eigen::Matrix<double, 12, 1> along = Eigen::Matrix<double, 12, 1>::Zero(), about = along;
  along(1) = 1.0, along(7) = -1.0;
  about(4) = 1.0, about(10) = -1.0;
  EXPECT_LT((deck.mesh.springs[0].stiffness - 50.0 * along * along.transpose()).norm(), 1e-12);
  EXPECT_LT((deck.mesh.springs[1].stiffness - 8.0 * about * about.transpose()).norm(), 1e-12);
  EXPECT_EQ(deck.element_sets.at("b").springs, (std::vector<int>{1}));
}

TEST(AbaqusSections, SpringsThatHoldAgainstTheGroundAreErrors) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,0,3,0\n";
  EXPECT_THAT(abaqus_error(nodes + "*ELEMENT, TYPE=SPRING1, ELSET=a\n1,1\n*SPRING, ELSET=a\n1\n5.\n"),
              AllOf(HasSubstr("element 1 (SPRING1)"), HasSubstr("define the support in the scene")));
  EXPECT_THAT(abaqus_error(nodes + "*ELEMENT, TYPE=SPRING2, ELSET=a\n1,1,2\n*SPRING, ELSET=a\n1,1\n5.\n"),
              AllOf(HasSubstr("element 1 (SPRING2)"), HasSubstr("resists rigid-body motion")));
  EXPECT_EQ(abaqus_error(nodes + "*ELEMENT, TYPE=SPRING2, ELSET=a\n1,1,2\n*SPRING, ELSET=a\n2,2\n5.\n"), "");
}

TEST(AbaqusSections, ErrorsNameValueAndRemedy) {
  EXPECT_THAT(abaqus_error(plate("*SHELL SECTION, ELSET=plate, MATERIAL=stel\n0.5\n")),
              AllOf(HasSubstr("'stel' does not exist"), HasSubstr("'steel'")));
  EXPECT_THAT(abaqus_error(plate("*SHELL SECTION, ELSET=plate, MATERIAL=steel\n-0.5\n")),
              HasSubstr("thickness = -0.5"));
  EXPECT_THAT(abaqus_error(plate("*SHELL SECTION, ELSET=plate, MATERIAL=steel\n")), HasSubstr("thickness is missing"));
  EXPECT_THAT(abaqus_error(plate("*SHELL SECTION, ELSET=plate, MATERIAL=steel, NODAL THICKNESS\n0.5\n")),
              HasSubstr("NODALTHICKNESS"));
  EXPECT_THAT(abaqus_error(plate("*SHELL SECTION, ELSET=plates, MATERIAL=steel\n0.5\n")),
              HasSubstr("'plates' does not exist"));
  EXPECT_THAT(abaqus_error(plate("*SOLID SECTION, ELSET=plate, MATERIAL=steel\n")),
              HasSubstr("does not fit element 1 (S4R)"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*SHELL SECTION, ELSET=plate, MATERIAL=steel\n0.5\n"),
              HasSubstr("two sections"));
  EXPECT_THAT(abaqus_error(plate(
                  carbon() +
                  "*ORIENTATION, NAME=o\n1,0,0,0,1,0\n*SHELL SECTION, ELSET=plate, MATERIAL=ply, ORIENTATION=o\n1.\n")),
              HasSubstr("no second data line"));
  EXPECT_THAT(abaqus_error(plate(carbon() + "*ORIENTATION, NAME=o, SYSTEM=CYLINDRICAL\n1,0,0,0,1,0\n3,0\n*SHELL "
                                            "SECTION, ELSET=plate, MATERIAL=ply, ORIENTATION=o\n1.\n")),
              HasSubstr("not rectangular"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*MATERIAL, NAME=bad\n*ELASTIC\n2e5, 0.5\n"), HasSubstr("nu = 0.5"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*MATERIAL, NAME=bad\n*ELASTIC\n2e5, 0.3, 20.\n1e5, 0.3, 400.\n"),
              HasSubstr("values for several temperatures"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*MATERIAL, NAME=bad\n*ELASTIC, TYPE=LAMINA\n1., 1., 1.5, 1., 1., 1.\n"),
              HasSubstr("nu12"));
  EXPECT_THAT(abaqus_error(abaqus_bar("*BEAM SECTION, SECTION=L, ELSET=bar, MATERIAL=steel\n1.,1.,.1,.1\n")),
              HasSubstr("SECTION=L is not understood"));
  EXPECT_THAT(abaqus_error(abaqus_bar("*BEAM SECTION, SECTION=PIPE, ELSET=bar, MATERIAL=steel\n1., 1.5\n")),
              HasSubstr("thickness 1.5 exceeds radius 1"));
  EXPECT_THAT(abaqus_error(abaqus_bar("*BEAM SECTION, SECTION=RECT, ELSET=bar, MATERIAL=steel\n1., 1.\n1., 0., 0.\n")),
              HasSubstr("is parallel to the beam"));
  EXPECT_THAT(abaqus_error(abaqus_bar("*BEAM SECTION, SECTION=CIRC, ELSET=bar, MATERIAL=steel\n1., 2.\n")),
              HasSubstr("ellipse"));
  EXPECT_THAT(abaqus_error(block(carbon() + "*SOLID SECTION, ELSET=block, MATERIAL=ply\n")),
              HasSubstr("no ORIENTATION"));
}

}  // namespace
}  // namespace tisserand::reducer::abaqus_sections_test
