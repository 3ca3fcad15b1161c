// SPDX-License-Identifier: GPL-3.0-or-later
// Nastran decks: coordinate systems and the grid points in them, against positions computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "reducer/decks/nastran/coordinates.hpp"
#include "tests/reducer/decks/nastran_deck.hpp"

namespace tisserand::testing::nastran_coordinates_test {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using namespace reducer;

/// Grid points made part of the mesh by point masses.
Vector3d position(const std::string& text, long id) {
  const Deck deck = read_deck(text + "CONM2,9001," + std::to_string(id) + ",,1.\n");
  return deck.mesh.position.col(deck.node_of_id.at(id));
}

void expect_near(const Vector3d& a, const Vector3d& b) { EXPECT_LT((a - b).norm(), 1e-12 * (1.0 + b.norm())) << a; }

TEST(NastranCoordinates, EveryKindByThreePoints) {
  // Origin (1, 2, 3), z along basic x, x along basic y.
  const std::string points = ",0,1.,2.,3.,2.,2.,3.\n,1.,3.,3.\n";
  expect_near(position("CORD2R,5" + points + "GRID,7,5,10.,20.,30.\n", 7), {31.0, 12.0, 23.0});
  expect_near(position("CORD2C,5" + points + "GRID,7,5,2.,30.,4.\n", 7), {5.0, 2.0 + std::sqrt(3.0), 4.0});
  // ρ = 2, θ = 60° from z, φ = 90°: local (0, √3, 1).
  expect_near(position("CORD2S,5" + points + "GRID,7,5,2.,60.,90.\n", 7), {2.0, 2.0, 3.0 + std::sqrt(3.0)});
}

TEST(NastranCoordinates, EveryKindByGridPoints) {
  const std::string grids = "GRID,1,,1.,2.,3.\nGRID,2,,2.,2.,3.\nGRID,3,,1.,3.,3.\n";
  expect_near(position(grids + "CORD1R,5,1,2,3\nGRID,7,5,10.,20.,30.\n", 7), {31.0, 12.0, 23.0});
  expect_near(position(grids + "CORD1R,4,1,3,2,5,1,2,3\nGRID,7,5,10.,20.,30.\n", 7), {31.0, 12.0, 23.0});
  expect_near(position(grids + "CORD1C,5,1,2,3\nGRID,7,5,2.,30.,4.\n", 7), {5.0, 2.0 + std::sqrt(3.0), 4.0});
  expect_near(position(grids + "CORD1S,5,1,2,3\nGRID,7,5,2.,60.,90.\n", 7), {2.0, 2.0, 3.0 + std::sqrt(3.0)});
}

TEST(NastranCoordinates, ChainsInAnyOrder) {
  // 3 in cylindrical 2 in 1, shifted by (1, 0, 0); GRIDs of system 3 define system 4, with its z along the y of 3.
  const std::string text =
      "CORD1R,4,11,12,13\nGRID,11,3\nGRID,12,3,0.,1.,0.\nGRID,13,3,0.,0.,1.\n"
      "CORD2R,3,2,1.,90.,0.,1.,90.,1.\n,2.,90.,0.\n"
      "CORD2C,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
      "CORD2R,1,,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\nGRID,7,4,1.,2.,3.\n";
  // Origin of 3 and 4: (1, 1, 0); x of 3 is basic y, y of 3 is basic −x: z of 4 is −x, x of 4 is z, y of 4 = z × x is
  // y.
  expect_near(position(text, 7), {1.0 - 3.0, 1.0 + 2.0, 1.0});
}

TEST(NastranCoordinates, DefaultsOfGrdset) {
  const std::string text =
      "GRDSET,,5,,,,5\nCORD2R,5,,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\nGRID,7,,1.,2.,3.\nGRID,8,0,1.,2.,3.\n";
  expect_near(position(text, 7), {2.0, 2.0, 3.0});
  expect_near(position(text, 8), {1.0, 2.0, 3.0});
}

TEST(NastranCoordinates, FaultsNameTheSystem) {
  EXPECT_THAT(fault_of("GRID,7,5\n"), HasSubstr("main.bdf:1: GRID 7: CP names coordinate system 5, which is missing"));
  EXPECT_THAT(fault_of("CORD2R,5,6,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,7\n"),
              HasSubstr("RID names coordinate system 6"));
  EXPECT_THAT(fault_of("CORD2R,5,6,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2R,6,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,7\n"),
              HasSubstr("depends on itself"));
  EXPECT_THAT(fault_of("CORD1R,5,7,8,9\nGRID,7,5\nGRID,8,,0.,0.,1.\nGRID,9,,1.\n"), HasSubstr("depends on itself"));
  EXPECT_THAT(fault_of("CORD2R,5,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,7\n"), HasSubstr("lie on a line"));
  EXPECT_THAT(fault_of("CORD2R,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2C,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,7\n"),
              HasSubstr("coordinate system 5 is defined twice"));
}

TEST(NastranCoordinates, AxesFollowThePosition) {
  NastranFrame frame;
  frame.origin = {1.0, 0.0, 0.0};
  for (const FrameKind kind : {FrameKind::cylindrical, FrameKind::spherical}) {
    frame.kind = kind;
    const Eigen::Vector3d x(0.7, 40.0, 65.0);
    const Eigen::Matrix3d axes = frame_axes_at(frame, frame_point(frame, x));
    EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
    for (int i = 0; i < 3; ++i) {  // central difference of the position along coordinate i
      const Vector3d d = 1e-6 * Vector3d::Unit(i);
      const Vector3d tangent = (frame_point(frame, x + d) - frame_point(frame, x - d)).normalized();
      EXPECT_LT((tangent - axes.col(i)).norm(), 1e-8);
    }
  }
}

}  // namespace
}  // namespace tisserand::testing::nastran_coordinates_test
