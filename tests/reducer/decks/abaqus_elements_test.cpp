// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes and elements of Abaqus decks: coordinate systems, node orders, types, ids.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/abaqus/element_types.hpp"
#include "tests/reducer/decks/abaqus_deck.hpp"

namespace tisserand::reducer::abaqus_elements_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Corners of the reference elements of Abaqus and the corners between which its middle nodes lie, counted from 1
/// (Abaqus, "Three-dimensional solid element library", node ordering).
struct SolidCase {
  std::string type;
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::array<int, 2>> edges;  ///< of Abaqus' middle nodes, in their order
  std::vector<std::array<int, 2>> gmsh;   ///< of gmsh's middle nodes, in their order (gmsh, "Node ordering")
};

const std::vector<SolidCase> kSolids = {
    {"C3D10",
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
     {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}},
     {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}},
    {"C3D20R",
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
     {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7}, {7, 8}, {8, 5}, {1, 5}, {2, 6}, {3, 7}, {4, 8}},
     {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}},
    {"C3D15",
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
     {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}},
     {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}},
};

std::string solid_deck(const SolidCase& solid) {
  std::vector<Eigen::Vector3d> nodes = solid.corners;
  for (const auto& [a, b] : solid.edges) nodes.push_back(0.5 * (solid.corners[a - 1] + solid.corners[b - 1]));
  std::string text = "*NODE\n", element = "*ELEMENT, TYPE=" + solid.type + ", ELSET=Block\n5";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    text += fmt::format("{}, {}, {}, {}\n", 10 * (i + 1), nodes[i].x(), nodes[i].y(), nodes[i].z());
    element += fmt::format(",{}{}", i == 14 ? "\n" : " ", 10 * (i + 1));  // two lines as Abaqus writes them
  }
  return text + element + "\n" + abaqus_steel + "*SOLID SECTION, ELSET=Block, MATERIAL=steel\n,\n";
}

TEST(AbaqusElements, QuadraticSolidsComeInTheOrderOfGmsh) {
  for (const SolidCase& solid : kSolids) {
    const Deck deck = abaqus_deck(solid_deck(solid));
    ASSERT_EQ(deck.mesh.solids.size(), 1u) << solid.type;
    const SolidElement& element = deck.mesh.solids[0];
    ASSERT_EQ(node_count(element.shape), static_cast<int>(solid.corners.size() + solid.edges.size()));
    for (std::size_t k = 0; k < solid.corners.size(); ++k)
      EXPECT_EQ(deck.mesh.position.col(element.nodes[k]), solid.corners[k]) << solid.type << " corner " << k;
    for (std::size_t k = 0; k < solid.gmsh.size(); ++k) {
      const Eigen::Vector3d middle = 0.5 * (solid.corners[solid.gmsh[k][0]] + solid.corners[solid.gmsh[k][1]]);
      EXPECT_EQ(deck.mesh.position.col(element.nodes[solid.corners.size() + k]), middle) << solid.type << " edge " << k;
    }
  }
}

TEST(AbaqusElements, FacesTurnInwardsAndTheirMiddleNodesLieOnTheirEdges) {
  for (const SolidCase& solid : kSolids) {
    const Deck deck = abaqus_deck(solid_deck(solid));
    const SolidShape shape = deck.mesh.solids[0].shape;
    const Eigen::Vector3d center =
        deck.mesh.position.leftCols(static_cast<Eigen::Index>(solid.corners.size())).rowwise().mean();
    int faces = 0;
    for (int face = 0; face < 6; ++face) {
      const auto nodes = abaqus::face_nodes(shape, face);
      if (nodes.empty()) continue;
      ++faces;
      const std::size_t n = nodes.size() / 2;
      const auto x = [&](std::size_t i) { return Eigen::Vector3d(deck.mesh.position.col(nodes[i])); };
      for (std::size_t k = 0; k < n; ++k)
        EXPECT_EQ(x(n + k), 0.5 * (x(k) + x((k + 1) % n))) << solid.type << " face " << face + 1;
      // Abaqus numbers the corners of each face clockwise as seen from outside.
      const Eigen::Vector3d normal = (x(1) - x(0)).cross(x(2) - x(0)).normalized();
      for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR((x(k) - x(0)).dot(normal), 0.0, 1e-15);
      EXPECT_GT((center - x(0)).dot(normal), 0.1);
    }
    EXPECT_EQ(faces, solid.corners.size() == 4 ? 4 : solid.corners.size() == 6 ? 5 : 6);
  }
}

TEST(AbaqusElements, FaceWeightsArePositiveAndSumToOne) {
  for (const std::size_t n : {3u, 4u, 6u, 8u}) {
    double sum = 0.0;
    for (const double w : abaqus::face_weights(n)) {
      EXPECT_GT(w, 0.0);
      sum += w;
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
  }
}

TEST(AbaqusElements, NodesInCylindricalAndLocalSystems) {
  const Deck deck = abaqus_deck(
      "*NODE, SYSTEM=C\n1, 2., 90., 3.\n"
      "*SYSTEM\n10., 0., 0., 10., 1., 0.\n9., 0., 0.\n"  // origin (10, 0, 0), x along global y, y along global -x
      "*NODE\n2, 1., 2., 3.\n"
      "*SYSTEM\n"
      "*NODE\n3, 1., 2., 3.\n"
      "*ELEMENT, TYPE=MASS, ELSET=m\n1, 1\n2, 2\n3, 3\n*MASS, ELSET=m\n2.5\n");
  EXPECT_LT((deck.mesh.position.col(0) - Eigen::Vector3d(0.0, 2.0, 3.0)).norm(), 1e-15);
  EXPECT_LT((deck.mesh.position.col(1) - Eigen::Vector3d(8.0, 1.0, 3.0)).norm(), 1e-14);
  EXPECT_EQ(deck.mesh.position.col(2), Eigen::Vector3d(1.0, 2.0, 3.0));
  ASSERT_EQ(deck.mesh.masses.size(), 3u);
  EXPECT_EQ(deck.mesh.masses[1].mass, 2.5);
  EXPECT_EQ(deck.node_of_id.at(3), 2);
  EXPECT_EQ(deck.mesh.node_label[2], "node 3");
}

TEST(AbaqusElements, ShellsWithTwoEqualNeighboursAreTriangles) {
  const std::string head = abaqus_plate.substr(0, abaqus_plate.find("*ELEMENT"));
  const Deck deck = abaqus_deck(
      head + "*ELEMENT, TYPE=S4R, ELSET=p\n1, 1, 2, 3, 3\n2, 1, 1, 3, 4\n*ELEMENT, TYPE=S3, ELSET=p\n3, 1, 2, 3\n" +
      abaqus_steel + "*SHELL SECTION, ELSET=p, MATERIAL=steel\n0.5\n");
  ASSERT_EQ(deck.mesh.shells.size(), 3u);
  for (const ShellElement& shell : deck.mesh.shells) EXPECT_EQ(shell.corners(), 3);
  // Nodes in their cyclic order.
  EXPECT_EQ(deck.mesh.shells[0].nodes, (std::array<int, 4>{2, 0, 1, -1}));
  EXPECT_EQ(deck.mesh.shells[1].nodes, (std::array<int, 4>{0, 2, 3, -1}));
}

TEST(AbaqusElements, ErrorsNameElementAndLine) {
  EXPECT_THAT(abaqus_error(abaqus_plate + "*NODE\n4, 9., 9., 9.\n"),
              AllOf(HasSubstr("deck.inp:16"), HasSubstr("node 4 is defined twice")));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=S4, ELSET=plate\n1, 1, 2, 3, 4\n"),
              AllOf(HasSubstr("element 1 is defined twice"), HasSubstr("deck.inp:7")));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=S4, ELSET=plate\n2, 1, 2, 3, 99\n"),
              HasSubstr("element 2: node '99' does not exist"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=S4, ELSET=plate\n2, 1, 2, 3\n"),
              HasSubstr("3 of the 4 nodes"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=S3, ELSET=plate\n2, 1, 2, 3, 4\n"),
              HasSubstr("4 nodes, but type S3 has 3"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=S4\n2, 1, 2, 3, 4\n"),
              HasSubstr("element 2 (S4) has no section"));
  const std::string many = abaqus_error(abaqus_plate +
                                        "*ELEMENT, TYPE=S4, ELSET=skin\n2, 1, 2, 3, 4\n3, 1, 2, 3, 4\n"
                                        "*ELEMENT, TYPE=S3\n4, 1, 2, 3\n5, 1, 2, 3\n");
  EXPECT_THAT(many, AllOf(HasSubstr("set 'skin': 2 elements have no section, the first is element 2 (S4)"),
                          HasSubstr("2 elements in no set have no section, the first is element 4 (S3)"),
                          Not(HasSubstr("element 3")), Not(HasSubstr("element 5"))));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT\n2, 1, 2, 3, 4\n"), HasSubstr("without TYPE"));
  EXPECT_THAT(abaqus_error("*NODE\n1, 1., nan, 0.\n"), HasSubstr("'nan' is not a coordinate"));
  EXPECT_THAT(abaqus_error("*NODE, SYSTEM=S\n1, 1., 0., 0.\n"), HasSubstr("SYSTEM=S"));
  EXPECT_THAT(abaqus_error("*SYSTEM\n0,0,0, 1,0,0\n2,0,0\n*NODE\n1\n"), HasSubstr("do not define a plane"));
}

TEST(AbaqusElements, TypesWithoutCounterpartAreRefusedWithARemedy) {
  for (const std::string type : {"S8R", "S6", "S8", "STRI65"})
    EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=" + type + "\n9, 1, 2, 3, 4, 1, 2, 3, 4\n"),
                AllOf(HasSubstr("TYPE=" + type), HasSubstr("S3 and S4")));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=B32\n9, 1, 2, 3\n"), HasSubstr("mesh with B31"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*ELEMENT, TYPE=B31OS\n9, 1, 2\n"), HasSubstr("warping"));
}

}  // namespace
}  // namespace tisserand::reducer::abaqus_elements_test
