// SPDX-License-Identifier: GPL-3.0-or-later
// Plates, discs, cylinders and extrusions: places, areas, normals, groups of edges, connections, and what is refused.
#include <cmath>
#include <numbers>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/reducer/sources/part_text.hpp"

namespace tisserand::testing::patches_test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Half the cross product of the diagonals (edges of a triangle): area times normal.
Vector3d directed_area(const reducer::Mesh& mesh, const reducer::ShellElement& shell) {
  const auto at = [&](int k) -> Vector3d { return mesh.position.col(shell.nodes[k]); };
  if (shell.corners() == 3) return 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
  return 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
}

Vector3d center(const reducer::Mesh& mesh, const reducer::ShellElement& shell) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < shell.corners(); ++k) sum += mesh.position.col(shell.nodes[k]);
  return sum / shell.corners();
}

double area(const reducer::Mesh& mesh) {
  return std::accumulate(mesh.shells.begin(), mesh.shells.end(), 0.0,
                         [&](double sum, const auto& shell) { return sum + directed_area(mesh, shell).norm(); });
}

const std::string wall = ", thickness: 0.01, material: steel}";

std::string plate(const std::string& name, const std::string& corners, const std::string& elements) {
  return name + ": {corners: " + corners + ", elements: " + elements + wall;
}

TEST(Plates, AreDividedEquallyAndTurnAboutTheirNormal) {
  const reducer::Mesh mesh =
      mesh_of("plates: {" + plate("p", "[[0, 0, 1], [3, 0, 1], [3, 2, 1], [0, 2, 1]]", "[6, 4]") +
              "}\npoints: {o: [0, 0, 1]}\nboundary: [o]\n");
  ASSERT_EQ(mesh.shells.size(), 24u);
  EXPECT_EQ(mesh.nodes(), 35);
  for (const reducer::ShellElement& shell : mesh.shells)
    EXPECT_LT((directed_area(mesh, shell) - 0.25 * Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(mesh.node_label[mesh.boundary[0].node], "o");
}

TEST(Plates, ThreeCornersMakeAParallelogramAndTrianglesHalveTheCells) {
  const std::string text = "plates: {p: {corners: [[0, 0, 0], [2, 0, 0], [3, 1, 0]], size: 0.5, cells: triangles" +
                           wall + "}\npoints: {d: [1, 1, 0]}\nboundary: [d]\n";
  const reducer::Mesh mesh = mesh_of(text);
  // Sides of 2 and sqrt 2: four and three divisions.
  ASSERT_EQ(mesh.shells.size(), 2u * 4u * 3u);
  EXPECT_EQ(mesh.shells[0].corners(), 3);
  EXPECT_NEAR(area(mesh), 2.0, 1e-14);
}

TEST(Plates, ThatShareAnEdgeAreConnectedThereAlsoWithBeams) {
  const reducer::Mesh mesh = mesh_of(
      "points: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0], e: [1, 0, 1], f: [1, 1, 1], g: [1, 2, 0]}\n"
      "plates: {" +
      plate("floor", "[a, b, c, d]", "[2, 4]") + ", " + plate("web", "[b, c, f, e]", "[4, 3]") +
      "}\n"
      "beams:\n  stiffener: {from: b, to: c, section: rod, material: steel, elements: 4}\n"
      "  arm: {from: c, to: g, section: rod, material: steel, elements: 2}\nboundary: [a, g]\n");
  EXPECT_EQ(mesh.nodes(), 3 * 5 + 5 * 4 - 5 + 2);
  reducer::check_connected(mesh, "part");
}

// A place given by coordinates on a node of the plate is that node, as a point would be.
TEST(Plates, CarryBeamsBetweenPlacesOnTheirNodes) {
  const reducer::Mesh mesh =
      mesh_of("plates: {" + plate("p", "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]", "[2, 2]") +
              "}\nbeams: {rib: {from: [0.5, 0, 0], to: [0.5, 1, 0], section: rod, material: steel, elements: 2}}\n"
              "points: {o: [0, 0, 0]}\nboundary: [o]\n");
  EXPECT_EQ(mesh.nodes(), 9);
  EXPECT_EQ(mesh.beams.size(), 2u);
}

TEST(Plates, ThatTouchWithOtherDivisionsAreRefused) {
  const std::string points =
      "points: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0], e: [1, 0, 1], f: [1, 1, 1]}\n";
  const std::string floor = plate("floor", "[a, b, c, d]", "[2, 4]"), ends = "boundary: [a, c]\n";
  EXPECT_THAT(
      error_of(points + "plates: {" + floor + ", " + plate("web", "[b, c, f, e]", "[3, 3]") + "}\n" + ends),
      AllOf(HasSubstr("part.yaml:7:"), HasSubstr("lies on the edge from"), HasSubstr("the same number of elements")));
  EXPECT_THAT(error_of(points + "plates: {" + floor +
                       "}\nbeams: {s: {from: b, to: c, section: rod, material: steel, elements: 3}}\n" + ends),
              HasSubstr("lies on the edge from"));
  // A beam of half the divisions has no node where the plate has one.
  EXPECT_THAT(error_of(points + "plates: {" + floor +
                       "}\nbeams: {s: {from: b, to: c, section: rod, material: steel, elements: 2}}\n" + ends),
              HasSubstr("lies on the edge from"));
}

TEST(Discs, HaveTheAreaOfTheirPolygonAndJoinCylinders) {
  for (const char* inner : {"0", "0.4"}) {
    const reducer::Mesh mesh = mesh_of(
        std::string("discs: {lid: {center: [0, 0, 2], radius: 1, inner_radius: ") + inner + ", elements: [16, 3]" +
        wall + "}\nboundary: {a: {centroid: lid/rim}}\nspiders: {h: {kind: rigid, on: lid/rim}}\n");
    // Regular polygon of 16 corners: n/2 sin(2 pi/n) per radius².
    const double r = std::stod(inner), polygon = 8.0 * std::sin(std::numbers::pi / 8.0);
    EXPECT_NEAR(area(mesh), polygon * (1.0 - r * r), 1e-13);
    for (const reducer::ShellElement& shell : mesh.shells) EXPECT_GT(directed_area(mesh, shell).z(), 0.0);
    EXPECT_EQ(mesh.spiders[0].nodes.size(), 16u);
    EXPECT_LT((mesh.position.col(mesh.spiders[0].reference) - Vector3d(0, 0, 2)).norm(), 1e-14);
  }
  const reducer::Mesh can =
      mesh_of("discs: {lid: {center: [0, 0, 2], radius: 1, elements: [16, 3]" + wall +
              "}\ncylinders: {side: {from: [0, 0, 0], to: [0, 0, 2], radius: 1, elements: [16, 4]" + wall +
              "}\nspiders: {foot: {kind: rigid, on: side/start}}\nboundary: [foot]\n");
  reducer::check_connected(can, "part");
  EXPECT_EQ(can.nodes(), (16 * 3 + 25) + 16 * 4 + 1);
}

TEST(Cylinders, HaveTheirNormalOutwards) {
  const reducer::Mesh mesh = mesh_of(
      "cylinders: {c: {from: [1, 0, 0], to: [1, 0, 3], radius: 1, end_radius: 0.5, angle_deg: 90, start: [0, 2, 1],"
      " elements: [8, 5]" +
      wall + "}\npoints: {p: [1, 1, 0], q: [0.5, 0, 3]}\nboundary: [p, q]\n");
  ASSERT_EQ(mesh.shells.size(), 40u);
  EXPECT_EQ(mesh.nodes(), 9 * 6);
  for (const reducer::ShellElement& shell : mesh.shells) {
    const Vector3d out = center(mesh, shell) - Vector3d(1, 0, 0);
    EXPECT_GT(directed_area(mesh, shell).dot(Vector3d(out.x(), out.y(), 0.0)), 0.0);
  }
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3d x = mesh.position.col(n);
    EXPECT_NEAR(std::hypot(x.x() - 1.0, x.y()), 1.0 - x.z() / 6.0, 1e-14);
  }
}

TEST(Extrusions, FollowLinesAndArcs) {
  const std::string profile = "profile: [[1, 0, 0], [2, 0, 0], [2, 0, 1]], ";
  const reducer::Mesh line = mesh_of("extrusions: {e: {" + profile + "along: [0, 4, 0], elements: [2, 6]" + wall +
                                     "}\npoints: {p: [1, 0, 0]}\nboundary: [p]\n");
  EXPECT_NEAR(area(line), 8.0, 1e-13);
  EXPECT_EQ(line.nodes(), 5 * 7);
  // profile × path: x × y = z for the first wall.
  EXPECT_GT(directed_area(line, line.shells[0]).z(), 0.0);
  const reducer::Mesh arc =
      mesh_of("extrusions: {e: {" + profile + "arc: {through: [0, 0, 0], angle_deg: 90}, elements: [2, 6]" + wall +
              "}\nspiders: {s: {kind: rigid, on: e/end}}\nboundary: [s]\n");
  for (const int n : arc.spiders[0].nodes) EXPECT_NEAR(arc.position(0, n), 0.0, 1e-14);
  EXPECT_EQ(arc.spiders[0].nodes.size(), 5u);
  // A closed box: the last node of the profile is the first.
  const reducer::Mesh box = mesh_of(
      "extrusions: {e: {profile: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0]], along: [0, 0, 2], "
      "elements: [2, 3]" +
      wall + "}\npoints: {p: [0, 0, 0]}\nboundary: [p]\n");
  EXPECT_EQ(box.nodes(), 8 * 4);
}

TEST(Extrusions, ThatTouchTheirAxisEndInTriangles) {
  const reducer::Mesh mesh = mesh_of(
      "extrusions: {cone: {profile: [[0, 0, 0], [2, 0, 1]], arc: {through: [0, 0, 0], angle_deg: 360}, "
      "elements: [2, 8]" +
      wall + "}\npoints: {p: [0, 0, 0]}\nboundary: [p]\n");
  int triangles = 0;
  for (const reducer::ShellElement& shell : mesh.shells) triangles += shell.corners() == 3 ? 1 : 0;
  EXPECT_EQ(triangles, 8);
  EXPECT_EQ(mesh.nodes(), 1 + 2 * 8);
}

TEST(ShellProperties, ComeFromThePatchOrFromAShellOnIt) {
  const std::string ends = "points: {a: [0, 0, 0]}\nboundary: [a]\n";
  const std::string corners = "corners: [[0, 0, 0], [1, 0, 0], [1, 1, 0]], elements: [1, 1]";
  const reducer::Mesh mesh =
      mesh_of("plates: {p: {" + corners +
              "}}\nshells: {skin: {on: p, offset: 0.1, x: [1, 1, 0], "
              "mass_matrix: lumped, laminate: [{material: carbon, thickness: 0.002, angle_deg: 90}, "
              "{material: steel, thickness: 0.001}]}}\n" +
              ends);
  ASSERT_EQ(mesh.shell_properties.size(), 1u);
  const reducer::ShellProperty& skin = mesh.shell_properties[0];
  EXPECT_EQ(skin.name, "skin");
  EXPECT_EQ(skin.mass_matrix, formats::MassMatrix::lumped);
  EXPECT_NEAR(skin.section.mass, 1600.0 * 0.002 + 7800.0 * 0.001, 1e-12);
  // Both isotropic and turned plies: A22 holds E1 of the carbon, for 90 degrees.
  EXPECT_GT(skin.section.A(1, 1), 1.3e11 * 0.002);
  EXPECT_NEAR(mesh.shells[0].offset, 0.1, 0.0);
  EXPECT_EQ(mesh.shells[0].material_x, Vector3d(1, 1, 0));
  EXPECT_THAT(error_of("plates: {p: {" + corners +
                       "}, q: {corners: [[5, 0, 0], [6, 0, 0], [6, 1, 0]], elements: [1, 1]}}\n"
                       "shells: {skin: {on: p, thickness: 0.1, material: steel}}\n" +
                       ends),
              AllOf(HasSubstr("'q' has no thickness and material"), HasSubstr("part.yaml:6:")));
  EXPECT_THAT(error_of("plates: {p: {" + corners + wall +
                       "}\nshells: {skin: {on: p, thickness: 0.1, material: steel}}\n" + ends),
              HasSubstr("p already belongs to 'p'"));
}

}  // namespace
}  // namespace tisserand::testing::patches_test
