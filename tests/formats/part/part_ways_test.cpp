// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the ways in of part.yaml: mesh files, groups, patches, shells, solids, springs, spiders, places: every key,
// every default, and the text of every error.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/part/part.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::part_ways_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string whole = R"(part: all
mesh: {file: sub/a.step, size: 4, smallest: 1, curvature: 12, sizes: {bore: 0.5}, order: 2, cells: triangles, scale: 2, unknown: ignore, ignore: [aux]}
materials:
  steel: {E: 2.1e11, nu: 0.3, density: 7800}
  ply: {E1: 1.3e11, E2: 9e9, nu12: 0.3, G12: 5e9, G13: 4e9, G23: 3e9, density: 1600}
sections: {rod: {shape: circle, radius: 0.01}, thin: {shape: circle, radius: 0.005}}
points: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], n: {node: 17}, m: {near: a, tolerance: 0.1}}
groups:
  bore: {faces: [3, 4]}
  top: {of: edges, box: [[1, 1, 1], [0, 0, 0]], near: b, tolerance: 0.5, groups: bore}
  hole: {cylinder: {from: a, to: [0, 0, 1], radius: 2}}
plates: {deck: {corners: [a, b, c], elements: [2, 3], thickness: 0.1, material: steel, offset: -0.05}}
discs: {lid: {center: a, radius: 2, inner_radius: 1, normal: [0, 1, 0], start: [1, 0, 0], size: 0.5, cells: triangles}}
cylinders: {tube: {from: a, to: [0, 0, 3], radius: 1, end_radius: 2, angle_deg: 90, elements: [4, 5]}}
extrusions:
  rail: {profile: [a, b, c], along: [0, 0, 1], size: 0.5}
  bow: {profile: [b, c], arc: {through: a, axis: [0, 0, 2], angle_deg: -45}, size: 0.5}
shells:
  skin: {on: [lid, tube, rail, bow], laminate: [{material: ply, thickness: 0.2, angle_deg: 45}, {material: steel, thickness: 0.1}], x: [1, 0, 0], mass_matrix: lumped}
solids: {body: {on: all, material: steel, mass_matrix: lumped}}
beams:
  rib: {on: [top], section: rod, material: steel, orientation: [0, 0, 1]}
  arm: {from: n, to: {near: [1, 2, 3]}, section: rod, to_section: thin, material: steel, elements: 3, angle_deg: 30, offset: [0, 0, 1], to_offset: [0, 0, 2], releases: {start: ry, end: [x, rz]}}
point_masses: {m: {at: [1, 2, 3], mass: 2, offset: [0, 0, 1]}}
springs: {k: {from: a, to: pin, stiffness: [1, 2, 3, 4, 5, 6], axes: {axis: [0, 0, 1], angle_deg: 90}}}
spiders:
  pin: {kind: rigid, on: bore}
  mean: {kind: averaging, at: {centroid: top}, on: [top, 7, 8], weights: equal}
boundary: {pin: all, b: translations, far: {near: [9, 9, 9], tolerance: 0.25, keep: rotations}, id: {node: 5}, c: {at: a}}
)";

Part read(const std::string& text) {
  const Folder folder;
  return read_part(folder.file("part.yaml", text), {});
}

std::string error(const std::string& text) {
  const Folder folder;
  const std::string path = folder.file("part.yaml", text);
  return error_of(folder, [&] { read_part(path, {}); });
}

TEST(WaysIn, MeshFile) {
  const MeshFile mesh = read(whole).mesh;
  EXPECT_THAT(mesh.file, ::testing::EndsWith("/sub/a.step"));
  EXPECT_THAT((std::vector<double>{mesh.size, mesh.smallest, mesh.scale}), ElementsAre(4, 1, 2));
  EXPECT_EQ(mesh.curvature, 12);
  EXPECT_EQ(mesh.sizes.at(0).group, "bore");
  EXPECT_EQ(mesh.sizes[0].size, 0.5);
  EXPECT_EQ(mesh.order, 2);
  EXPECT_EQ(mesh.cells, Cells::triangles);
  EXPECT_EQ(mesh.unknown, UnknownContent::ignore);
  EXPECT_THAT(mesh.ignore, ElementsAre("aux"));
  const MeshFile plain = read("part: p\nmesh: {file: /x.msh}\n").mesh;
  EXPECT_EQ(plain.file, "/x.msh");
  EXPECT_THAT((std::vector<double>{plain.size, plain.smallest, plain.scale}), ElementsAre(0, 0, 1));
  EXPECT_EQ(plain.order + plain.curvature, 0);
  EXPECT_EQ(plain.cells, std::nullopt);
  EXPECT_EQ(plain.unknown, UnknownContent::refuse);
}

TEST(WaysIn, PlacesAndGroups) {
  const Part part = read(whole);
  EXPECT_EQ(part.points[3].place->kind, PlaceKind::node);
  EXPECT_EQ(part.points[3].place->node, 17);
  EXPECT_EQ(part.points[4].place->kind, PlaceKind::near);
  EXPECT_EQ(part.points[4].place->tolerance, 0.1);
  EXPECT_THAT(part.groups[0].numbers, ElementsAre(3, 4));
  EXPECT_EQ(part.groups[0].of, Dimension::face);
  const GroupDefinition& top = part.groups[1];
  EXPECT_EQ(top.of, Dimension::edge);
  EXPECT_EQ(top.box->low, Eigen::Vector3d::Zero());
  EXPECT_EQ(top.box->high, Eigen::Vector3d::Ones());
  EXPECT_EQ(*top.near, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(top.tolerance, 0.5);
  EXPECT_THAT(top.groups, ElementsAre("bore"));
  EXPECT_EQ(part.groups[2].cylinder->radius, 2.0);
  EXPECT_EQ(part.groups[2].cylinder->to, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(part.groups[2].tolerance, std::nullopt);
  const std::vector<BoundaryNode>& b = part.boundary;
  EXPECT_EQ(b[0].at.name, "pin");
  EXPECT_FALSE(b[1].rotations);
  EXPECT_EQ(b[2].at.position, Eigen::Vector3d(9, 9, 9));
  EXPECT_FALSE(b[2].translations);
  EXPECT_EQ(b[3].at.node, 5);
  EXPECT_EQ(b[4].at.name, "a");
}

TEST(WaysIn, Patches) {
  const Part part = read(whole);
  ASSERT_EQ(part.patches.size(), 5u);
  const auto& plate = std::get<Plate>(part.patches[0].shape);
  EXPECT_EQ(plate.corners.at(3), Eigen::Vector3d(0, 1, 0)) << "of the parallelogram";
  EXPECT_THAT(part.patches[0].elements, ElementsAre(2, 3));
  EXPECT_EQ(part.patches[0].layout->offset, -0.05);
  EXPECT_EQ(part.patches[0].layout->thickness, 0.1);
  const auto& disc = std::get<Disc>(part.patches[1].shape);
  EXPECT_EQ(disc.normal, Eigen::Vector3d::UnitY());
  EXPECT_EQ(*disc.start, Eigen::Vector3d::UnitX());
  EXPECT_EQ(disc.inner_radius, 1.0);
  EXPECT_EQ(part.patches[1].cells, Cells::triangles);
  EXPECT_FALSE(part.patches[1].layout);
  const auto& tube = std::get<Cylinder>(part.patches[2].shape);
  EXPECT_EQ(tube.end_radius, 2.0);
  EXPECT_NEAR(tube.angle, 0.5 * M_PI, 1e-15);
  const auto& rail = std::get<Extrusion>(part.patches[3].shape);
  EXPECT_EQ(std::get<Eigen::Vector3d>(rail.path), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(rail.section.size(), 3u);
  EXPECT_NEAR(std::get<ArcPath>(std::get<Extrusion>(part.patches[4].shape).path).angle, -0.25 * M_PI, 1e-15);
}

TEST(WaysIn, ShellsSolidsAndMaterials) {
  const Part part = read(whole);
  EXPECT_EQ(part.materials.size(), 1u);
  const OrthotropicMaterial& ply = part.orthotropic.at(0);
  EXPECT_THAT((std::vector<double>{ply.E1, ply.E2, ply.nu12, ply.G12, ply.G13, ply.G23, ply.density}),
              ElementsAre(1.3e11, 9e9, 0.3, 5e9, 4e9, 3e9, 1600));
  const ShellGroup& skin = part.shells.at(0);
  EXPECT_THAT(skin.on, ElementsAre("lid", "tube", "rail", "bow"));
  EXPECT_NEAR(skin.layout.plies.at(0).angle, 0.25 * M_PI, 1e-15);
  EXPECT_EQ(skin.layout.plies.at(1).angle, 0.0);
  EXPECT_NEAR(skin.layout.thickness, 0.3, 1e-15);
  EXPECT_EQ(*skin.layout.x, Eigen::Vector3d::UnitX());
  EXPECT_EQ(skin.layout.mass_matrix, MassMatrix::lumped);
  EXPECT_THAT(part.solids.at(0).on, ElementsAre("all"));
  EXPECT_EQ(part.solids[0].mass_matrix, MassMatrix::lumped);
}

TEST(WaysIn, BeamsMassesSpringsSpiders) {
  const Part part = read(whole);
  EXPECT_THAT(part.beams[0].on, ElementsAre("top"));
  const BeamLine& arm = part.beams[1];
  EXPECT_EQ(arm.to.kind, PlaceKind::near);
  EXPECT_EQ(arm.to_section, "thin");
  EXPECT_NEAR(arm.angle, M_PI / 6.0, 1e-15);
  EXPECT_EQ(arm.from_offset, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(arm.to_offset, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(arm.releases.start, 0b010000u);
  EXPECT_EQ(arm.releases.end, 0b100001u);
  EXPECT_EQ(part.point_masses[0].at.kind, PlaceKind::position);
  EXPECT_EQ(part.point_masses[0].offset, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(part.springs[0].stiffness(5, 5), 6.0);
  EXPECT_NEAR(part.springs[0].axes(1, 0), 1.0, 1e-15) << "x of the spring is y of the part";
  EXPECT_EQ(part.spiders[0].type, SpiderType::rigid);
  EXPECT_EQ(part.spiders[0].at.kind, PlaceKind::centroid);
  EXPECT_EQ(part.spiders[0].at.name, "");
  EXPECT_EQ(part.spiders[1].at.name, "top");
  EXPECT_THAT(part.spiders[1].nodes, ElementsAre(7, 8));
  EXPECT_EQ(part.spiders[1].weights, SpiderWeights::equal);
}

/// `from` becomes `to`, in which ^ stands before the character that the message must point at (^ in the message).
struct Change {
  const char* from;
  const char* to;
  const char* message;  ///< a piece of it
};

class BadWayIn : public ::testing::TestWithParam<Change> {};

TEST_P(BadWayIn, SaysWhat) {
  EXPECT_THAT(error(replaced(whole, GetParam().from, GetParam().to)), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    MeshGroupsPlaces, BadWayIn,
    ::testing::Values(Change{"size: 4", "size: -4", "part.yaml:2:32: mesh: size -4 must be positive"},
                      Change{"order: 2", "order: 3", "mesh: order 3 must be 1 or 2"},
                      Change{"curvature: 12", "curvature: 5000", "curvature 5000 must be between 0 and 1000"},
                      Change{"scale: 2", "scale: 0", "scale 0 must be positive"},
                      Change{"bore: 0.5", "bore: 0", "size 0 of 'bore' must be positive"},
                      Change{"file: sub/a.step, ", "", "missing key 'file'"},
                      Change{"unknown: ignore", "unknown: skip", "unknown unknown 'skip'"},
                      Change{"{node: 17}", "{node: 17, near: a}", "more than one of 'node', 'near', 'centroid'"},
                      Change{"{node: 17}", "{node: 17, tolerance: 1}", "'tolerance' has no effect without 'near'"},
                      Change{"{node: 17}", "{}", "none of 'node', 'near', 'centroid' is given"},
                      Change{"near: a, tolerance: 0.1", "near: n", "point 'n' is a node of the mesh file"},
                      Change{"faces: [3, 4]", "faces: [3, 4], edges: [1]", "entities of different kinds"},
                      Change{"faces: [3, 4]", "faces: [3, 4], of: faces",
                             "'of' cannot be combined with numbers of entities"},
                      Change{"bore: {faces: [3, 4]}", "bore: {of: faces}", "group 'bore': selects nothing"},
                      Change{"box: [[1, 1, 1], [0, 0, 0]]", "box: [1, 1, 1]", "box must be two corners"},
                      Change{"to: [0, 0, 1], radius", "to: a, radius", "the axis of the cylinder has zero length"},
                      Change{"[0, 0, 1], radius: 2", "[0, 0, 1], radius: 0", "radius 0 must be positive"},
                      Change{"tolerance: 0.5", "tolerance: -1", "tolerance -1 must not be negative"},
                      Change{"c: {at: a}", "c: {at: a, node: 3}", "both 'at' and another place"},
                      Change{"c: {at: a}", "c: {at: aa}", "there is no point 'aa'"},
                      Change{"keep: rotations", "keep: none", "unknown keep 'none'"}));

INSTANTIATE_TEST_SUITE_P(
    Shells, BadWayIn,
    ::testing::Values(
        Change{"nu12: 0.3", "nu12: 4", "nu12 4 must be below sqrt(E1/E2) = 3.8"},
        Change{"G23: 3e9", "G23: 0", "material 'ply': G23 0 must be positive"},
        Change{"corners: [a, b, c]", "corners: [a, b]", "2 corners; give four corners in order"},
        Change{"corners: [a, b, c]", "corners: [a, b, b]", "the inner angle at corner"},
        Change{"corners: [a, b, c]", "corners: [a, b, [0, 1, 0], c]", "the inner angle at corner"},
        Change{"elements: [2, 3]", "elements: [2]", "elements must be two counts"},
        Change{"elements: [2, 3]", "elements: [2, 0]", "elements 0 must be 1 or more"},
        Change{"elements: [2, 3]", "elements: [20000, 20000]", "the limit is 1e+07"},
        Change{"elements: [2, 3]", "elements: [2, 3], size: 1", "both 'elements' and 'size'"},
        Change{"thickness: 0.1, material: steel, offset", "thickness: 0, material: steel, offset",
               "'deck': thickness 0 must be positive"},
        Change{"thickness: 0.1, material: steel, offset", "thickness: 1, material: stel, offset",
               "'deck': there is no material 'stel'; did you mean 'steel'?"},
        Change{"inner_radius: 1", "inner_radius: 2", "inner_radius 2 must be at least 0 and below radius 2"},
        Change{"start: [1, 0, 0]", "start: [0, 3, 0]", "start is parallel to the axis"},
        Change{"angle_deg: 90, elements", "angle_deg: 400, elements", "angle_deg 400 must be between -360 and 360"},
        Change{"along: [0, 0, 1]", "along: [0, 0, 0]", "along must be a direction"},
        Change{"along: [0, 0, 1], ", "", "neither 'along' nor 'arc' is given"},
        Change{"profile: [b, c]", "profile: [b, b]", "points 1 and 2 are at the same place"},
        Change{"x: [1, 0, 0], mass", "x: [0, 0, 0], mass", "x must be a direction"},
        Change{"laminate: [{", "thickness: 1, laminate: [{", "both 'laminate' and 'thickness' are given"},
        Change{"thickness: 0.2", "thickness: -0.2", "laminate.0.thickness -0.2 must be positive"},
        Change{"body: {on: all, material: steel", "body: {on: all, material: ply",
               "solid 'body': there is no material 'ply'"}));

INSTANTIATE_TEST_SUITE_P(
    Attachments, BadWayIn,
    ::testing::Values(
        Change{"on: [top], section", "on: [top], elements: 3, section", "'elements' cannot be combined with 'on'"},
        Change{"start: ry", "start: rw", "unknown release 'rw'"},
        Change{"to_section: thin", "to_section: thick", "there is no section 'thick'"},
        Change{"[1, 2, 3, 4, 5, 6]", "[1, 2, 3]", "stiffness has 3 numbers instead of 6"},
        Change{"[1, 2, 3, 4, 5, 6]", "[1, 2, 3, 4, 5, -6]", "a stiffness is negative"},
        Change{"[1, 2, 3, 4, 5, 6]", "[0, 0, 0, 0, 0, 0]", "stiffness is zero"},
        Change{"[1, 2, 3, 4, 5, 6]",
               "[[1, 2, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, "
               "0, 1, 0], [0, 0, 0, 0, 0, 1]]",
               "stiffness is not symmetric"},
        Change{"[1, 2, 3, 4, 5, 6]",
               "[[1, 2, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, "
               "0, 1, 0], [0, 0, 0, 0, 0, 1]]",
               "stiffness is not positive semidefinite"},
        Change{"pin: {kind: rigid, on: bore}", "pin: {kind: rigid, on: []}", "spider 'pin': is attached to nothing"},
        Change{"pin: {kind: rigid, on: bore}", "pin: {on: bore}", "missing key 'kind'"},
        Change{"kind: rigid, on: bore", "kind: rigid, on: bore, weights: equal", "a rigid spider has no weights"},
        Change{"  mean: {", "  a: {", "spider 'a': the name is used twice"}));

TEST(WaysIn, WithoutAMeshFileGroupsMustBeDrawn) {
  const std::string part =
      "part: p\nmaterials: {steel: {E: 1, nu: 0.3, density: 1}}\npoints: {a: [0, 0, 0]}\n"
      "plates: {deck: {corners: [[0, 0, 0], [1, 0, 0], [1, 1, 0]], elements: [1, 1], thickness: 1, material: steel}}\n";
  EXPECT_EQ(error(part + "spiders: {s: {kind: rigid, on: deck/edge2}}\nboundary: [s]\n"), "");
  EXPECT_THAT(error(part + "spiders: {s: {kind: rigid, on: deck/edge5}}\nboundary: [s]\n"),
              HasSubstr("spider 's': there is no group 'deck/edge5'; did you mean 'deck/edge1'?"));
  EXPECT_THAT(error(part + "spiders: {s: {kind: rigid, on: [7]}}\nboundary: [s]\n"),
              HasSubstr("node numbers are given, but there is no mesh file"));
  EXPECT_THAT(error(part + "boundary: {b: {near: [0, 0, 0]}}\n"), HasSubstr("'near' needs a mesh file"));
  EXPECT_THAT(error(part), HasSubstr("missing key 'boundary'"));
  EXPECT_THAT(error(replaced(part, ", thickness: 1, material: steel", "") + "boundary: [a]\n"),
              HasSubstr("neither thickness and material nor a laminate"));
}

}  // namespace
}  // namespace tisserand::formats::part_ways_test
