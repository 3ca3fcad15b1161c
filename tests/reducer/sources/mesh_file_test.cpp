// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry and mesh files: the same plate through every way in gives the same matrices; CAD files; damaged files.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "reducer/elements/checks.hpp"
#include "reducer/mesh/gmsh_file.hpp"
#include "tests/reducer/sources/part_text.hpp"
#include "tests/reducer/sources/sorted_matrices.hpp"

namespace tisserand::testing::mesh_file_test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string meshes = std::string(TISSERAND_SOURCE_DIR) + "/meshes/";

std::string content(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class SamePlate : public ::testing::TestWithParam<const char*> {};

TEST_P(SamePlate, GivesTheSameMatrices) {
  const Sorted drawn = sorted_matrices(mesh_of(drawn_plate));
  const reducer::Mesh mesh =
      mesh_of("mesh: {file: " + meshes + GetParam() +
              "}\nshells: {s: {on: all, thickness: 0.01, material: steel}}\nboundary: {o: {node: 1}}\n");
  ASSERT_EQ(mesh.shells.size(), 24u);
  const Sorted read = sorted_matrices(mesh);
  ASSERT_EQ(read.S.rows(), drawn.S.rows());
  // gmsh places inner nodes to about 1e-10 of the lengths, and text files hold 16 digits.
  EXPECT_LT((read.S - drawn.S).norm(), 1e-8 * drawn.S.norm());
  EXPECT_LT((read.M - drawn.M).norm(), 1e-8 * drawn.M.norm());
}

INSTANTIATE_TEST_SUITE_P(Files, SamePlate,
                         ::testing::Values("plate.geo", "plate-2.2.msh", "plate-4.1.msh", "plate-2.2-binary.msh",
                                           "plate-4.1-binary.msh"));

TEST(Cad, FaceIsConvertedToTheUnitsOfThePart) {
  for (const auto& [file, unit, size, length] : {std::tuple{"square.step", "mm", 60.0, 600.0},
                                                 {"square.step", "m", 0.06, 0.6},
                                                 {"square.step", "km", 6e-5, 6e-4},  // read in mm: see below
                                                 {"square.igs", "cm", 6.0, 60.0}}) {
    const reducer::Mesh mesh = mesh_of(fmt::format(
        "units: {{length: {}, mass: kg, time: s}}\nmesh: {{file: {}{}, size: {}, cells: quadrilaterals}}\n"
        "shells: {{s: {{on: face 1, thickness: {}, material: steel}}}}\nboundary: {{o: {{near: [0, 0, 0]}}}}\n",
        unit, meshes, file, size, 0.01 * size));
    EXPECT_NEAR(mesh.position.row(0).maxCoeff(), length, 1e-9 * length) << file;
    EXPECT_NEAR(mesh.position.row(1).maxCoeff(), length / 1.5, 1e-9 * length);
    EXPECT_GE(mesh.shells.size(), 70u) << "600/60 x 400/60 elements";
    EXPECT_LE(mesh.shells.size(), 160u);
  }
}

TEST(Cad, FacesByLabel) {
  const std::string text = "mesh: {file: " + meshes + "square.igs, size: 0.1}\nboundary: {o: {near: [0, 0, 0]}}\n";
  EXPECT_GT(mesh_of(text + "shells: {s: {on: FACE(0), thickness: 0.1, material: steel}}\n").shells.size(), 0u);
  EXPECT_THAT(error_of(text + "shells: {s: {on: FACE(1), thickness: 0.1, material: steel}}\n"),
              HasSubstr("there is no group 'FACE(1)'"));
}

/// The bracket is a block of 40 x 20 x 10 with a bore of radius 4: volume 8000 - 160 pi.
std::string bracket(const std::string& file, const std::string& mesh, const std::string& more) {
  return "units: {length: mm, mass: t, time: s}\nmesh: {file: " + meshes + file + ", " + mesh +
         "}\nsolids: {body: {on: all, material: steel}}\n"
         "groups: {bore: {of: faces, cylinder: {from: [20, 10, 0], to: [20, 10, 10], radius: 4}}}\n"
         "spiders: {pin: {kind: averaging, on: bore}}\nboundary: [pin]\n" +
         more;
}

double volume(const reducer::Mesh& mesh) {
  double sum = 0.0;
  for (const reducer::SolidElement& e : mesh.solids) {
    const auto at = [&](std::size_t k) -> Vector3d { return mesh.position.col(e.nodes[k]); };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
  }
  return sum;
}

class Bracket : public ::testing::TestWithParam<const char*> {};

TEST_P(Bracket, IsMeshedWithSolidsAndHeldAtItsBore) {
  const reducer::Mesh mesh = mesh_of(bracket(GetParam(), "size: 5, curvature: 12", ""));
  EXPECT_EQ(mesh.solids[0].shape, reducer::SolidShape::tetrahedron4);
  // The bore is a polygon of 12 sides, whose area lies by 4.5 % below that of the circle.
  EXPECT_NEAR(volume(mesh), 8000.0 - 160.0 * std::numbers::pi, 0.06 * 160.0 * std::numbers::pi);
  const reducer::Spider& pin = mesh.spiders[0];
  EXPECT_LT((mesh.position.col(pin.reference) - Vector3d(20, 10, 5)).norm(), 0.2);
  for (const int n : pin.nodes)
    EXPECT_NEAR((mesh.position.col(n).head<2>() - Eigen::Vector2d(20, 10)).norm(), 4.0, 1e-6);
  // Area of the bore's wall, 2 pi r h, of a polygon of 12 sides.
  EXPECT_NEAR(std::accumulate(pin.weight.begin(), pin.weight.end(), 0.0), 80.0 * std::numbers::pi,
              0.03 * 80.0 * std::numbers::pi);
  reducer::check_connected(mesh, "part");
}

INSTANTIATE_TEST_SUITE_P(Files, Bracket, ::testing::Values("bracket.step", "bracket.brep", "bracket.geo"));

/// Two of 684 tetrahedra of second order are folded when the bores of the crank are meshed with edges of 25 mm.
TEST(Geometry, ElementsThatCurvedFacesFoldAreUnfolded) {
  const reducer::Mesh mesh = mesh_of("units: {length: mm, mass: t, time: s}\nmesh: {file: " + meshes +
                                     "crank.step, size: 25, order: 2}\nsolids: {body: {on: all, material: steel}}\n"
                                     "boundary: {o: {near: [-62, 0, 0], tolerance: 100}}\n");
  EXPECT_THAT(mesh.warnings, ::testing::Contains(HasSubstr("elements of second order; their nodes were moved")));
  EXPECT_NO_THROW(reducer::check_shapes(mesh, "part"));
}

TEST(Geometry, OrderSizesAndScaleAreObeyed) {
  const reducer::Mesh coarse = mesh_of(bracket("bracket.step", "size: 8", ""));
  const reducer::Mesh second = mesh_of(bracket("bracket.step", "size: 8, order: 2", ""));
  EXPECT_EQ(second.solids[0].shape, reducer::SolidShape::tetrahedron10);
  EXPECT_EQ(second.solids.size(), coarse.solids.size());
  const reducer::Mesh fine = mesh_of(bracket("bracket.step", "size: 8, sizes: {bore: 1.5}", ""));
  EXPECT_GT(fine.spiders[0].nodes.size(), 3 * coarse.spiders[0].nodes.size());
  const reducer::Mesh larger =
      mesh_of("mesh: {file: " + meshes +
              "plate-4.1.msh, scale: 1000}\n"
              "shells: {s: {on: deck, thickness: 10, material: steel}}\nboundary: {o: {near: [600, 400, 0]}}\n");
  EXPECT_NEAR(larger.position.maxCoeff(), 600.0, 1e-9);
  EXPECT_THAT(error_of("mesh: {file: " + meshes +
                       "plate-4.1.msh, size: 1}\n"
                       "shells: {s: {on: deck, thickness: 10, material: steel}}\nboundary: {o: {node: 1}}\n"),
              HasSubstr("'size' has no effect on a .msh file"));
}

TEST(Geometry, SecondOrderFacesAreNoShells) {
  EXPECT_THAT(error_of("mesh: {file: " + meshes +
                       "square.step, order: 2}\n"
                       "shells: {s: {on: all, thickness: 10, material: steel}}\nboundary: {o: {near: [0, 0, 0]}}\n"),
              AllOf(HasSubstr("is of second order (6 nodes)"), HasSubstr("order: 1")));
}

TEST(Geometry, WhatTheTolerancesOfGmshDoNotResolveIsRefused) {
  const PartText part(
      "mesh: {file: chip.geo}\nshells: {s: {on: all, thickness: 1e-6, material: steel}}\n"
      "boundary: {o: {near: [0, 0, 0]}}\n");
  write_text_file(part.file("chip.geo"), "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 3e-5, 4e-5};\n");
  EXPECT_THAT(part.error(), AllOf(HasSubstr("chip.geo"), HasSubstr("the geometry has the size 5.03e-05 of its units"),
                                  HasSubstr("`scale` under mesh")));
  EXPECT_THAT(error_of("mesh: {file: " + meshes +
                       "square.step, size: 1e-6}\n"
                       "shells: {s: {on: all, thickness: 0.1, material: steel}}\nboundary: {o: {near: [0, 0, 0]}}\n"),
              AllOf(HasSubstr("would make about"), HasSubstr("the geometry has the size 0.72")));  // of 0.6 x 0.4 m
  // 0.24 m^2 in equal triangles of edge 1e-12 m: 0.24/(sqrt(3)/4 1e-24) = 5.5e23.
  EXPECT_THAT(error_of("mesh: {file: " + meshes +
                       "square.step, size: 1e-12}\n"
                       "shells: {s: {on: all, thickness: 0.1, material: steel}}\nboundary: {o: {near: [0, 0, 0]}}\n"),
              AllOf(HasSubstr("below the tolerance of the geometry"), HasSubstr("would make about 5.5e+23 elements")));
}

/// The error for a file with this content and name.
std::string error_of_file(const std::string& name, const std::string& text) {
  const PartText part("mesh: {file: " + name +
                      "}\nshells: {s: {on: all, thickness: 1, material: steel}}\nboundary: {o: {node: 1}}\n");
  if (!text.empty()) write_text_file(part.file(name), text);
  return part.error();
}

TEST(DamagedFiles, AreNamedWithWhatIsWrong) {
  const std::string msh = content(meshes + "plate-4.1.msh"), old = content(meshes + "plate-2.2.msh");
  const std::string step = content(meshes + "square.step"), brep = content(meshes + "bracket.brep");
  EXPECT_THAT(error_of_file("no.msh", ""), AllOf(HasSubstr("cannot open mesh file"), HasSubstr("No such file")));
  EXPECT_THAT(error_of_file("no.txt", "x"), HasSubstr("the ending '.txt' is unknown"));
  EXPECT_THAT(error_of_file("a.msh", msh.substr(0, msh.size() * 2 / 3)), HasSubstr("the file is truncated"));
  EXPECT_THAT(error_of_file("a.msh", old.substr(0, old.size() / 3)), HasSubstr("the file is truncated"));
  EXPECT_THAT(error_of_file("a.msh", step), HasSubstr("no $MeshFormat"));
  EXPECT_THAT(error_of_file("a.msh", "$MeshFormat\n3.0 0 8\n$EndMeshFormat\n"), HasSubstr("has version 3.0"));
  EXPECT_THAT(
      error_of_file("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999999\n$EndNodes\n$Elements\n"),
      HasSubstr("99999999999 Nodes do not fit into"));
  EXPECT_THAT(error_of_file("a.step", step.substr(0, step.size() / 2)), HasSubstr("END-ISO-10303-21 is missing"));
  EXPECT_THAT(error_of_file("a.step", msh), HasSubstr("this is not a STEP file"));
  EXPECT_THAT(error_of_file("a.igs", step), HasSubstr("this is not an IGES file"));
  EXPECT_THAT(error_of_file("a.brep", msh), HasSubstr("this is not a BREP file"));
  EXPECT_THAT(error_of_file("a.brep", brep.substr(0, 300)), HasSubstr("TShapes is missing"));
  EXPECT_THAT(error_of_file("a.geo", "Point(1) = {0, 0, 0};\nSystemCall \"ls\";\n"),
              HasSubstr("tries to start a program"));
  EXPECT_THAT(error_of_file("a.geo", "// Exit\nPoint(1) = {0, 0, 0;\n"), HasSubstr("gmsh: "));
  EXPECT_THAT(error_of_file("a.geo", "Point(1) = {0, 0, 0};\n"),
              HasSubstr("the geometry has no edges, faces or volumes"));
}

TEST(MeshOfAnySource, IsWrittenToLookAtAndReadAgain) {
  const PartText part(bracket("bracket.step", "size: 8", "point_masses: {m: {at: pin, mass: 1}}\n"));
  const reducer::Mesh mesh = part.mesh();
  reducer::write_gmsh_file(mesh, part.file("out.msh"));
  EXPECT_THAT(content(part.file("out.msh")),
              AllOf(HasSubstr("\"pin\""), HasSubstr("\"m\""), HasSubstr("$MeshFormat\n4.1")));
  const PartText again("mesh: {file: " + part.file("out.msh") +
                       ", ignore: [pin]}\nsolids: {body: {on: body, "
                       "material: steel}}\nboundary: {a: {node: 1}}\n");
  EXPECT_EQ(again.mesh().solids.size(), mesh.solids.size());
}

}  // namespace
}  // namespace tisserand::testing::mesh_file_test
