// SPDX-License-Identifier: GPL-3.0-or-later
// Decks of other programs as the mesh file of a part: the same plate, its sets and numbers, and what belongs to the
// deck.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reducer/sources/part_text.hpp"
#include "tests/reducer/sources/sorted_matrices.hpp"

namespace tisserand::testing::deck_test {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

const std::string meshes = std::string(TISSERAND_SOURCE_DIR) + "/meshes/";

std::string deck(const std::string& file, const std::string& more) {
  return "mesh: {file: " + meshes + file + "}\n" + more;
}

class SamePlateDeck : public ::testing::TestWithParam<const char*> {};

TEST_P(SamePlateDeck, GivesTheSameStiffness) {
  const Sorted drawn = sorted_matrices(mesh_of(drawn_plate));
  const Sorted read = sorted_matrices(mesh_of(deck(GetParam(), "boundary: {o: {node: 1}}\n")));
  ASSERT_EQ(read.S.rows(), drawn.S.rows());
  EXPECT_LT((read.S - drawn.S).norm(), 1e-12 * drawn.S.norm());
  // Total mass; programs differ in how they share it among the nodes.
  const auto total = [](const Eigen::MatrixXd& M) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(M.rows());
    for (Eigen::Index i = 0; i < M.rows(); i += 6) x[i] = 1.0;
    return x.dot(M * x);
  };
  EXPECT_NEAR(total(read.M), 0.6 * 0.4 * 0.01 * 7800.0, 1e-12 * 18.72);
}

INSTANTIATE_TEST_SUITE_P(Files, SamePlateDeck, ::testing::Values("plate.bdf", "plate.inp"));

TEST(Decks, BoundaryIsThatOfTheDeckUnlessThePartNamesOne) {
  const reducer::Mesh own = mesh_of(deck("plate.bdf", ""));
  ASSERT_EQ(own.boundary.size(), 2u);
  EXPECT_LT((own.position.col(own.boundary[0].node) - Vector3d(0.6, 0, 0)).norm(), 1e-14);
  EXPECT_LT((own.position.col(own.boundary[1].node) - Vector3d(0.6, 0.4, 0)).norm(), 1e-14);
  const reducer::Mesh named = mesh_of(deck("plate.bdf", "boundary: {tip: {near: [0.6, 0.2, 0]}}\n"));
  ASSERT_EQ(named.boundary.size(), 1u);
  EXPECT_EQ(named.boundary[0].name, "tip");
  EXPECT_THAT(error_of(deck("plate.inp", "")), HasSubstr("the part has no boundary node"));
}

TEST(Decks, SetsCarrySpidersAndDrawnBeamsJoinNodes) {
  const reducer::Mesh mesh =
      mesh_of(deck("plate.inp",
                   "points: {end: [1, 0, 0], corner: {node: 7}}\n"
                   "beams: {arm: {from: corner, to: end, section: rod, material: steel, elements: 2}}\n"
                   "spiders: {e: {kind: averaging, on: LEFT}, all: {kind: averaging, at: [0, 0, 1], on: "
                   "deck}}\nboundary: [e, end, all]\n"));
  EXPECT_EQ(mesh.nodes(), 35 + 2 + 2);
  const reducer::Spider& edge = mesh.spiders[0];
  ASSERT_EQ(edge.nodes.size(), 5u);
  double sum = 0.0, area = 0.0;
  for (const double weight : edge.weight) sum += weight;
  for (const double weight : mesh.spiders[1].weight) area += weight;
  EXPECT_NEAR(sum, 0.4, 1e-14) << "the nodes of the set share the edges of shells between them";
  EXPECT_NEAR(area, 0.24, 1e-14) << "elements of the set share their area";
  reducer::check_connected(mesh, "part");
}

/// A point that nothing of the deck uses is there for the part file, and leaves if that does not use it either.
TEST(Decks, FreePointsServeThePartFile) {
  const PartText part(
      "mesh: {file: free.bdf}\nspiders: {e: {kind: rigid, at: {node: 100}, on: [1, 4]}}\nboundary: [e]\n");
  const auto write = [&part](const std::string& cards) {
    write_text_file(part.file("free.bdf"),
                    "GRID,100,,7.,7.,7.\nGRID,99,,8.\nGRID,1\nGRID,2,,2.\nGRID,3,,2.,2.\nGRID,4,,0.,2.\n"
                    "MAT1,7,2.1+11,,.3,7800.\nPSHELL,5,7,.1,7\nCQUAD4,11,5,1,2,3,4\n" +
                        cards);
    return part.mesh();
  };
  const reducer::Mesh mesh = write("");
  ASSERT_EQ(mesh.nodes(), 5);
  EXPECT_EQ(mesh.node_label[mesh.spiders.at(0).reference], "node 100");
  EXPECT_EQ(mesh.boundary.at(0).node, mesh.spiders[0].reference);
  EXPECT_THAT(mesh.warnings, ::testing::Contains(HasSubstr("1 nodes of")));
  EXPECT_THAT(mesh.warnings, ::testing::Contains(HasSubstr("are omitted: node 99")));
}

TEST(Decks, BringTheirProperties) {
  EXPECT_THAT(
      error_of(deck("plate.inp", "shells: {s: {on: deck, thickness: 1, material: steel}}\nboundary: {o: {node: 1}}\n")),
      HasSubstr("'deck' is a set of a deck, whose elements already have properties"));
  EXPECT_THAT(error_of("mesh: {file: " + meshes + "plate.inp, scale: 10}\nboundary: {o: {node: 1}}\n"),
              HasSubstr("'scale' has no effect on a deck"));
  EXPECT_THAT(error_of("mesh: {file: " + meshes + "plate.inp, order: 2}\nboundary: {o: {node: 1}}\n"),
              HasSubstr("'order' has no effect on a deck"));
}

}  // namespace
}  // namespace tisserand::testing::deck_test
