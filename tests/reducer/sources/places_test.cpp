// SPDX-License-Identifier: GPL-3.0-or-later
// Places, groups, spiders, springs, masses and boundary nodes on a mesh file and on drawn walls.
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/reduce.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/sources/part_text.hpp"

namespace tisserand::testing::places_test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string meshes = std::string(TISSERAND_SOURCE_DIR) + "/meshes/";
/// 6 x 4 shells on 0.6 x 0.4 with the groups deck, left, right.
const std::string plate =
    "mesh: {file: " + meshes + "plate-4.1.msh}\nshells: {deck: {on: deck, thickness: 0.01, material: steel}}\n";

Vector3d boundary_position(const reducer::Mesh& mesh, std::size_t k) {
  return mesh.position.col(mesh.boundary[k].node);
}

TEST(Places, BoundaryByNumberNearCentroidAndSpider) {
  const reducer::Mesh mesh =
      mesh_of(plate +
              "spiders: {pin: {kind: rigid, on: left}}\n"
              "boundary:\n  corner: {node: 3, keep: translations}\n  by: {near: [0.21, 0.1, 0], tolerance: 0.02}\n"
              "  middle: {centroid: right, keep: rotations}\n  pin: all\n  other: {at: [1, 1, 1]}\n");
  ASSERT_EQ(mesh.boundary.size(), 5u);
  EXPECT_LT((boundary_position(mesh, 0) - Vector3d(0.6, 0.4, 0)).norm(), 1e-14);  // Point(3) of plate.geo
  EXPECT_FALSE(mesh.boundary[0].rotations);
  EXPECT_LT((boundary_position(mesh, 1) - Vector3d(0.2, 0.1, 0)).norm(), 1e-8);
  EXPECT_LT((boundary_position(mesh, 2) - Vector3d(0.6, 0.2, 0)).norm(), 1e-8);
  EXPECT_FALSE(mesh.boundary[2].translations);
  EXPECT_LT((boundary_position(mesh, 3) - Vector3d(0, 0.2, 0)).norm(), 1e-8);
  EXPECT_EQ(boundary_position(mesh, 4), Vector3d(1, 1, 1));
}

TEST(Places, ThatHaveNoNodeSayWhatIsNear) {
  const auto message = [](const std::string& boundary) {
    return error_of(plate + "boundary: {b: {" + boundary + "}}\n");
  };
  EXPECT_THAT(
      message("near: [0.25, 0.12, 0]"),
      AllOf(HasSubstr("part.yaml:8:"), HasSubstr("boundary node 'b': the node nearest to [0.25, 0.12, 0] is node"),
            HasSubstr("away; the tolerance is 0.000721")));  // 1e-3 of the diagonal
  EXPECT_THAT(message("near: [0.25, 0.1, 0], tolerance: 0.06"), HasSubstr("equally near"));
  EXPECT_THAT(message("node: 4711"), AllOf(HasSubstr("no node 4711"), HasSubstr("numbers from 1 to 35")));
  EXPECT_THAT(message("centroid: lift"),
              AllOf(HasSubstr("there is no group 'lift'"), HasSubstr("did you mean 'left'?")));
  EXPECT_THAT(error_of(plate + "points: {p: [0, 0, 0]}\nboundary: [p]\n"), HasSubstr("{near: p}"));
  EXPECT_THAT(error_of(plate), HasSubstr("the part has no boundary node"));
}

TEST(Places, PointsMayBeNodesOfTheMeshFile) {
  const reducer::Mesh mesh = mesh_of(
      plate +
      "points: {end: [1, 0, 0], corner: {near: [0.6, 0, 0]}}\n"
      "beams: {arm: {from: corner, to: end, section: rod, material: steel, elements: 2}}\nboundary: [corner, end]\n");
  EXPECT_EQ(mesh.nodes(), 35 + 2);
  EXPECT_EQ(mesh.beams[0].first, mesh.boundary[0].node);
  reducer::check_connected(mesh, "part");
}

TEST(Spiders, WeighNodesByTheirShareOfTheEdge) {
  const reducer::Mesh mesh =
      mesh_of(plate +
              "spiders: {e: {kind: averaging, on: left}, f: {kind: averaging, at: [0, 0, 1], "
              "on: deck, weights: equal}, n: {kind: averaging, on: [1, 4]}}\nboundary: [e, f, n]\n");
  const reducer::Spider& edge = mesh.spiders[0];
  ASSERT_EQ(edge.nodes.size(), 5u);
  EXPECT_NEAR(std::accumulate(edge.weight.begin(), edge.weight.end(), 0.0), 0.4, 1e-8);
  for (std::size_t k = 0; k < 5; ++k) {
    const double y = mesh.position(1, edge.nodes[k]);
    EXPECT_NEAR(edge.weight[k], y < 1e-6 || y > 0.4 - 1e-6 ? 0.05 : 0.1, 1e-8);
  }
  EXPECT_EQ(mesh.spiders[1].node_components, reducer::translations_only);
  EXPECT_EQ(mesh.spiders[1].nodes.size(), 35u);
  for (const double weight : mesh.spiders[1].weight) EXPECT_EQ(weight, 1.0);
  EXPECT_THAT(mesh.spiders[2].weight, ::testing::ElementsAre(1.0, 1.0)) << "no element lies between the two corners";
}

/// Translations on a straight line do not tell how it turns about itself; with the rotations of the shells the spiders
/// follow every rigid motion.
TEST(Spiders, AverageStraightEdges) {
  const PartText part(plate +
                      "spiders: {e: {kind: averaging, on: left}, f: {kind: averaging, on: right}}\nboundary: [e, f]\n");
  start_solvers();
  const reducer::Reduction reduction = reducer::reduce(part.read(), [](const std::string&) {});
  EXPECT_EQ(reduction.superelement.size(), 12 + reduction.model.modes_kept);
  EXPECT_LT(reduction.model.rigid_residual_before_projection, 1e-9);  // round-off of the condensation
  EXPECT_GT(reduction.superelement.stiffness.diagonal().minCoeff(), 0.0);
}

TEST(Spiders, ThatGrabNothingAreRefused) {
  EXPECT_THAT(error_of(plate + "spiders: {s: {kind: rigid, on: hole}}\nboundary: [s]\n"),
              AllOf(HasSubstr("spider 's': there is no group 'hole'"), HasSubstr("known are left, right, deck"),
                    HasSubstr("part.yaml:8:")));
  EXPECT_THAT(error_of(plate + "groups: {away: {of: nodes, box: [[5, 5, 5], [6, 6, 6]]}}\n"
                               "spiders: {s: {kind: rigid, on: away}}\nboundary: [s]\n"),
              HasSubstr("group 'away' selects nothing"));
  EXPECT_THAT(error_of("mesh: {file: " + meshes +
                       "plate.geo, ignore: [deck]}\npoints: {a: [0, 0, 0], b: [1, 0, 0]}\n"
                       "beams: {rib: {on: left, section: rod, material: steel}}\n"
                       "spiders: {s: {kind: rigid, on: right}}\nboundary: [s]\n"),
              HasSubstr("spider 's' connects no nodes"));
}

TEST(Groups, ByBoxCylinderNearNumberAndUnion) {
  const auto count = [](const std::string& group) {
    return mesh_of(plate + "groups: {g: {" + group +
                   "}}\nspiders: {s: {kind: rigid, at: [0, 0, 1], on: g}}\nboundary: [s]\n")
        .spiders[0]
        .nodes.size();
  };
  EXPECT_EQ(count("of: nodes, box: [[0.15, 0.05, 0], [0.35, 0.25, 0]]"), 4u);
  EXPECT_EQ(count("of: edges, box: [[0.6, 0, 0], [0.6, 1, 0]]"), 5u);
  EXPECT_EQ(count("of: edges, near: [0.61, 0.1, 0]"), 5u);
  EXPECT_EQ(count("edges: [2, 4]"), 10u);
  EXPECT_EQ(count("faces: 1"), 35u);
  EXPECT_EQ(count("nodes: [1, 2, 3]"), 3u);
  EXPECT_EQ(count("groups: [left, right], nodes: 2"), 10u);
  EXPECT_EQ(count("of: nodes, near: [0.3, 0.21, 0], tolerance: 0.02"), 1u);
  EXPECT_EQ(count("of: nodes, cylinder: {from: [0.3, 0.2, -1], to: [0.3, 0.2, 1], radius: 0.1}"), 4u);
  const auto message = [](const std::string& group) {
    return error_of(plate + "groups: {g: {" + group + "}}\nspiders: {s: {kind: rigid, on: g}}\nboundary: [s]\n");
  };
  EXPECT_THAT(message("faces: [7]"), AllOf(HasSubstr("face 7 does not exist"), HasSubstr("numbers up to 1")));
  EXPECT_THAT(message("groups: [g]"), HasSubstr("contains itself"));
  EXPECT_THAT(message("of: edges, near: [0.3, 0.1, 0], tolerance: 1"), HasSubstr("equally near"));
  EXPECT_THAT(message("of: edges, near: [5, 0, 0]"), HasSubstr("the tolerance is"));
}

TEST(Groups, OfTheWrongKindOrWithoutPropertyAreRefused) {
  const std::string file = "mesh: {file: " + meshes + "plate-4.1.msh}\n", end = "boundary: {a: {node: 1}}\n";
  EXPECT_THAT(error_of(file + "shells: {s: {on: left, thickness: 0.1, material: steel}}\n" + end),
              HasSubstr("'left' holds edges, but faces are needed"));
  EXPECT_THAT(error_of(file + "beams: {s: {on: left, section: rod, material: steel}}\n" + end),
              AllOf(HasSubstr("group 'deck' has 24 elements without a property"), HasSubstr("under shells")));
  EXPECT_THAT(error_of(plate + "solids: {v: {on: all, material: steel}}\n" + end),
              HasSubstr("solid 'v': there are no volumes"));
  EXPECT_THAT(error_of(plate +
                       "beams: {a: {on: [left], section: rod, material: steel}, b: {on: 'edge 4', section: rod, "
                       "material: steel}}\n" +
                       end),
              HasSubstr("edge 4 already belongs to beam 'a'"));
}

TEST(Attachments, SpringsMassesAndReleasesArriveInTheMesh) {
  const reducer::Mesh mesh =
      mesh_of(plate +
              "points: {a: [0, 0, 1], b: [0, 0, 2], c: {node: 1}}\n"
              "beams: {s: {from: a, to: c, section: rod, to_section: rod, material: steel, elements: 2, angle_deg: 90, "
              "from_offset: [0.1, 0, 0], releases: {start: [ry, rz], end: [x]}}}\n"
              "springs: {k: {from: a, to: b, stiffness: [1, 2, 3, 4, 5, 6], axes: {axis: [0, 0, 1], angle_deg: 90}}}\n"
              "point_masses: {m: {at: b, mass: 2, inertia: [1, 1, 1], offset: [0, 0, 0.5]}}\nboundary: [a]\n");
  ASSERT_EQ(mesh.springs.size(), 1u);
  EXPECT_NEAR(mesh.springs[0].stiffness(0, 0), 2.0, 1e-14) << "x of the part is -y of the turned axes";
  EXPECT_NEAR(mesh.springs[0].stiffness(1, 1), 1.0, 1e-14);
  EXPECT_EQ(mesh.masses[0].offset, Vector3d(0, 0, 0.5));
  ASSERT_EQ(mesh.beams.size(), 2u);
  EXPECT_EQ(mesh.beams[0].released, 0b110000);
  EXPECT_EQ(mesh.beams[1].released, 0b000001 << 6);
  EXPECT_EQ(mesh.beams[0].first_offset, Vector3d(0.1, 0, 0));
  EXPECT_NEAR(mesh.beams[0].second_offset.x(), 0.05, 1e-15);
  EXPECT_EQ(mesh.beams[1].second_offset, Vector3d::Zero());
  EXPECT_EQ(mesh.beam_properties.size(), 2u) << "one for each element of a tapered beam";
  EXPECT_FALSE(mesh.beam_properties[0].data.stations.empty());
}

TEST(Attachments, BeamsOnGroupsOfLines) {
  const reducer::Mesh mesh =
      mesh_of(plate +
              "beams: {rib: {on: [left, right], section: rod, material: steel, offset: [0, 0, 0.02]}}\n"
              "boundary: {a: {node: 1}}\n");
  ASSERT_EQ(mesh.beams.size(), 8u);
  for (const reducer::BeamElement& beam : mesh.beams) {
    EXPECT_EQ(beam.first_offset, Vector3d(0, 0, 0.02));
    EXPECT_LT((beam.R_PE.col(1) - Vector3d::UnitZ()).norm(), 1e-14) << "the first of y, z, x that is normal to y";
  }
  EXPECT_EQ(mesh.nodes(), 35);
}

}  // namespace
}  // namespace tisserand::testing::places_test
