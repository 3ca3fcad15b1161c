// SPDX-License-Identifier: GPL-3.0-or-later
// One structure through every way in: the reduced stiffness and mass are the same.
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/sections/shapes.hpp"
#include "reducer/mesh/gmsh_file.hpp"
#include "reducer/reduce.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/sources/part_text.hpp"

namespace tisserand::testing::every_way_test {
namespace {

using formats::Superelement;

const std::string meshes = std::string(TISSERAND_SOURCE_DIR) + "/meshes/";

/// Reduced numbers may differ by the round-off of the condensation in another order of nodes: 2e-16 times the condition
/// of S_II. For the plate that is membrane over bending, (L/t)² = 4e3, times the fourth power of cells per side, 1e3,
/// with some margin for the modes; for the bracket below that.
constexpr double round_off = 1e-8;

void expect_same(const Superelement& actual, const Superelement& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  EXPECT_EQ(actual.dof_component, expected.dof_component);
  EXPECT_LT(relative_difference(actual.node_position, expected.node_position), 1e-12);
  // Blocks have units of their own.
  const Eigen::Index n_B = expected.size() - 6, n_I = 6;
  for (const auto& [a, e] : {std::pair{&actual.stiffness, &expected.stiffness}, {&actual.mass, &expected.mass}}) {
    EXPECT_LT(relative_difference(a->topLeftCorner(n_B, n_B), e->topLeftCorner(n_B, n_B)), round_off);
    EXPECT_LT(relative_difference(a->bottomRightCorner(n_I, n_I), e->bottomRightCorner(n_I, n_I)), round_off);
  }
  EXPECT_LT(relative_difference(actual.mass.topRightCorner(n_B, n_I), expected.mass.topRightCorner(n_B, n_I)),
            100.0 * round_off)
      << "modes: round-off over the gap between neighbours";
}

Superelement reduced(const PartText& part) { return reduce(part.read()).superelement; }

// --- a plate with a beam along its edge ----------------------------------------------------------------------------

const std::string ends = "boundary: {o: {near: [0, 0, 0]}, tip: {near: [0.6, 0.4, 0]}}\nmodes: 6\n";
/// Local y along the plate's normal, as the decks have it below. Rotary inertia of bending: Nastran's bars have none.
std::string edge_beam(const char* rotary_inertia) {
  return fmt::format(
      "section: rod, material: steel, theory: euler_bernoulli, orientation: [0, 0, 1], rotary_inertia: {}",
      rotary_inertia);
}

/// `mass`: of plate and beam.
Superelement drawn_plate_and_beam(const std::string& mass, const char* rotary_inertia) {
  return reduced(
      PartText("points: {o: [0, 0, 0], p: [0.6, 0, 0], tip: [0.6, 0.4, 0]}\n"
               "plates: {deck: {corners: [[0, 0, 0], [0.6, 0, 0], [0.6, 0.4, 0], [0, 0.4, 0]], elements: [6, 4], "
               "thickness: 0.01, material: steel, mass_matrix: " +
               mass + "}}\nbeams: {edge: {from: p, to: tip, elements: 4, mass_matrix: " + mass + ", " +
               edge_beam(rotary_inertia) + "}}\nboundary: [o, tip]\nmodes: 6\n"));
}

class PlateFile : public ::testing::TestWithParam<const char*> {};

TEST_P(PlateFile, GivesTheSameReducedMatrices) {
  expect_same(
      reduced(PartText("mesh: {file: " + meshes + GetParam() +
                       "}\nshells: {deck: {on: deck, thickness: 0.01, material: steel}}\nbeams: {edge: {on: right, " +
                       edge_beam("on") + "}}\n" + ends)),
      drawn_plate_and_beam("consistent", "on"));
}

INSTANTIATE_TEST_SUITE_P(EveryWay, PlateFile,
                         ::testing::Values("plate.geo", "plate-2.2.msh", "plate-2.2-binary.msh", "plate-4.1.msh",
                                           "plate-4.1-binary.msh"));

/// The deck of meshes/ with more cards before `end`, or at its own end.
std::string plate_deck(const std::string& file, const std::string& end, const std::string& cards) {
  std::ifstream stream(meshes + file);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t at = end.empty() ? text.size() : text.rfind(end);
  return text.insert(at, cards);
}

Superelement nastran_plate_and_beam(const std::string& parameter) {
  const PartText part("mesh: {file: plate.bdf}\n" + ends);
  const formats::Section rod = formats::rectangle_section(0.02, 0.04);
  const std::string bars = fmt::format(
      "PBAR,2,1,{:.17g},{:.17g},{:.17g},{:.17g}\nCBAR,101,2,7,14,0.,0.,1.\nCBAR,102,2,14,21,0.,0.,1.\n"
      "CBAR,103,2,21,28,0.,0.,1.\nCBAR,104,2,28,35,0.,0.,1.\n",
      rod.area, rod.second_moment_z, rod.second_moment_y, rod.torsion_constant);
  write_text_file(part.file("plate.bdf"), plate_deck("plate.bdf", "ENDDATA", parameter + bars));
  return reduced(part);
}

/// Coupled masses are consistent, without rotary inertia of bars in bending; others are lumped with it (NASTRAN.md).
TEST(EveryWay, NastranPlate) {
  expect_same(nastran_plate_and_beam("PARAM,COUPMASS,1\n"), drawn_plate_and_beam("consistent", "off"));
  expect_same(nastran_plate_and_beam(""), drawn_plate_and_beam("lumped", "on"));
}

TEST(EveryWay, AbaqusPlate) {
  const PartText part("mesh: {file: plate.inp}\n" + ends);
  const formats::Section rod = formats::rectangle_section(0.02, 0.04);
  write_text_file(
      part.file("plate.inp"),
      plate_deck("plate.inp", "",
                 fmt::format("\n*ELEMENT, TYPE=B33, ELSET=EDGE\n101, 7, 14\n102, 14, 21\n103, 21, 28\n104, "
                             "28, 35\n*BEAM GENERAL SECTION, SECTION=GENERAL, ELSET=EDGE, DENSITY=7800\n"
                             "{}, {}, 0, {}, {}\n0, 0, 1\n2.1e11, {}\n",
                             rod.area, rod.second_moment_y, rod.second_moment_z, rod.torsion_constant, 2.1e11 / 2.6)));
  expect_same(reduced(part), drawn_plate_and_beam("consistent", "on"));
}

// --- a bracket of tetrahedra from CAD ------------------------------------------------------------------------------

const std::string corners =
    "boundary: {a: {near: [0, 0, 0], keep: translations}, b: {near: [40, 0, 0], keep: translations}, "
    "c: {near: [0, 20, 10], keep: translations}}\nmodes: 6\n";
const std::string body = "solids: {body: {on: all, material: steel}}\n";

std::string bracket_mesh(const std::string& file, const std::string& more) {
  return "units: consistent\nmesh: {file: " + file + more + "}\n";
}

std::string msh22(const reducer::Mesh& mesh) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.nodes());
  for (int n = 0; n < mesh.nodes(); ++n)
    text += fmt::format("{} {} {} {}\n", n + 1, mesh.position(0, n), mesh.position(1, n), mesh.position(2, n));
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.solids.size());
  for (std::size_t e = 0; e < mesh.solids.size(); ++e) {
    text += fmt::format("{} 4 2 1 1", e + 1);
    for (std::size_t k = 0; k < 4; ++k) text += fmt::format(" {}", mesh.solids[e].nodes[k] + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

std::string bdf(const reducer::Mesh& mesh) {
  std::string text = "BEGIN BULK\nPARAM,COUPMASS,1\nMAT1,1,2.1+11,,.3,7800.\nPSOLID,1,1\n";
  for (int n = 0; n < mesh.nodes(); ++n)
    text += fmt::format("GRID,{},,{:.17g},{:.17g},{:.17g}\n", n + 1, mesh.position(0, n), mesh.position(1, n),
                        mesh.position(2, n));
  for (std::size_t e = 0; e < mesh.solids.size(); ++e) {
    text += fmt::format("CTETRA,{},1", e + 1);
    for (std::size_t k = 0; k < 4; ++k) text += fmt::format(",{}", mesh.solids[e].nodes[k] + 1);
    text += "\n";
  }
  return text + "ENDDATA\n";
}

std::string inp(const reducer::Mesh& mesh) {
  std::string text = "*NODE\n";
  for (int n = 0; n < mesh.nodes(); ++n)
    text += fmt::format("{}, {}, {}, {}\n", n + 1, mesh.position(0, n), mesh.position(1, n), mesh.position(2, n));
  text += "*ELEMENT, TYPE=C3D4, ELSET=BODY\n";
  for (std::size_t e = 0; e < mesh.solids.size(); ++e) {
    text += fmt::format("{}", e + 1);
    for (std::size_t k = 0; k < 4; ++k) text += fmt::format(", {}", mesh.solids[e].nodes[k] + 1);
    text += "\n";
  }
  return text +
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7800\n*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n";
}

TEST(EveryWay, BracketFromCadThroughMeshFilesAndDecks) {
  const PartText step(bracket_mesh(meshes + "bracket.step", ", size: 8") + body + corners);
  const reducer::Mesh mesh = step.mesh();
  const Superelement expected = reduced(step);
  const PartText old(bracket_mesh("bracket.msh", "") + body + corners);
  write_text_file(old.file("bracket.msh"), msh22(mesh));
  expect_same(reduced(old), expected);
  const PartText gmsh(bracket_mesh("bracket.msh", "") + body + corners);
  reducer::write_gmsh_file(mesh, gmsh.file("bracket.msh"));
  expect_same(reduced(gmsh), expected);
  const PartText nastran(bracket_mesh("bracket.bdf", "") + corners);
  write_text_file(nastran.file("bracket.bdf"), bdf(mesh));
  expect_same(reduced(nastran), expected);
  const PartText abaqus(bracket_mesh("bracket.inp", "") + corners);
  write_text_file(abaqus.file("bracket.inp"), inp(mesh));
  expect_same(reduced(abaqus), expected);
}

}  // namespace
}  // namespace tisserand::testing::every_way_test
