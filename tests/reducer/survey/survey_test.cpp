// SPDX-License-Identifier: GPL-3.0-or-later
// What `reducer groups` tells of geometry, meshes and decks, and its pictures.
#include "reducer/survey/survey.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "common/child.hpp"
#include "reducer/survey/labels.hpp"
#include "reducer/survey/picture.hpp"
#include "tests/reducer/sources/part_text.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::survey_test {
namespace {

using Eigen::Vector3d;
using reducer::FaceSide;
using reducer::FormKind;
using reducer::SurveyedFace;
using test_support::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string sources = std::string(TISSERAND_SOURCE_DIR) + "/meshes/";

std::string whole(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A geometry of OpenCASCADE in a folder of its own, in mm. gmsh cannot mesh a torus by two or three triangles.
reducer::Survey survey_of(const std::string& geometry, const std::string& more = "") {
  const PartText part("units: {length: mm, mass: t, time: s}\nmesh: {file: part.geo, size: 2}\n" + more);
  write_text_file(part.file("part.geo"), "SetFactory(\"OpenCASCADE\");\n" + geometry);
  return reducer::survey(part.read());
}

const SurveyedFace& only(const reducer::Survey& survey, FormKind kind) {
  const SurveyedFace* found = nullptr;
  for (const SurveyedFace& face : survey.faces)
    if (face.facts.form.kind == kind) {
      EXPECT_EQ(found, nullptr) << "a second one: " << face.name;
      found = &face;
    }
  if (found == nullptr) throw std::runtime_error("no face of this form");
  return *found;
}

// The block of meshes/bracket.geo: 40 x 20 x 10 with a bore of 8 in the middle.
TEST(Survey, BlockWithABoreHasSixPlanesAndACylinder) {
  for (const char* file : {"bracket.step", "bracket.brep"}) {
    const reducer::Survey survey = reducer::survey(reducer::part_of_file(sources + file));
    ASSERT_EQ(survey.faces.size(), 7u);
    Vector3d sum = Vector3d::Zero();
    for (const SurveyedFace& face : survey.faces) {
      if (face.facts.form.kind != FormKind::plane) continue;
      EXPECT_TRUE(face.facts.is_outward) << face.name;
      // Away from the middle of the block, by half its side.
      const Vector3d out = face.facts.center - Vector3d(20, 10, 5);
      EXPECT_NEAR(face.facts.form.axis.dot(out), out.norm(), 1e-6) << face.name;
      sum += face.facts.form.axis.cwiseAbs();
    }
    EXPECT_LT((sum - Vector3d(2, 2, 2)).norm(), 1e-9);
    const SurveyedFace& bore = only(survey, FormKind::cylinder);
    EXPECT_NEAR(bore.facts.form.radius, 4.0, 1e-6);
    EXPECT_LT((bore.facts.form.axis - Vector3d::UnitZ()).norm(), 1e-9);
    EXPECT_LT((bore.facts.form.point - Vector3d(20, 10, 5)).norm(), 1e-6);
    EXPECT_EQ(bore.facts.side, FaceSide::concave);
    EXPECT_NEAR(bore.facts.area, 80.0 * std::numbers::pi, 1e-6);
    EXPECT_THAT(survey.text, AllOf(HasSubstr("cylinder  concave  4"), HasSubstr("[20, 10, 5]")));
  }
}

TEST(Survey, RoundSolidsOfOpenCascade) {
  const reducer::Survey survey = survey_of(
      "Cone(1) = {0, 0, 0, 0, 0, 10, 6, 2};\nSphere(2) = {30, 0, 0, 4};\nTorus(3) = {60, 10, 5, 10, 3};\n"
      "Cylinder(4) = {0, 50, 0, 3, 4, 0, 2};\n");
  const SurveyedFace& cone = only(survey, FormKind::cone);
  EXPECT_NEAR(cone.facts.form.half_angle, std::atan(0.4), 1e-9);
  EXPECT_LT((cone.facts.form.point - Vector3d(0, 0, 15)).norm(), 1e-6);
  EXPECT_LT((cone.facts.form.axis + Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(cone.facts.area, std::numbers::pi * 8.0 * std::sqrt(116.0), 1e-6);  // (r1 + r2) x slant height
  const SurveyedFace& sphere = only(survey, FormKind::sphere);
  EXPECT_NEAR(sphere.facts.form.radius, 4.0, 1e-6);
  EXPECT_LT((sphere.facts.form.point - Vector3d(30, 0, 0)).norm(), 1e-6);
  const SurveyedFace& torus = only(survey, FormKind::torus);
  EXPECT_NEAR(torus.facts.form.radius, 10.0, 1e-6);
  EXPECT_NEAR(torus.facts.form.minor_radius, 3.0, 1e-6);
  EXPECT_LT((torus.facts.form.point - Vector3d(60, 10, 5)).norm(), 1e-6);
  const SurveyedFace& cylinder = only(survey, FormKind::cylinder);
  EXPECT_LT((cylinder.facts.form.axis - Vector3d(0.6, 0.8, 0)).norm(), 1e-9);
  for (const SurveyedFace* face : {&cone, &sphere, &torus, &cylinder}) EXPECT_EQ(face->facts.side, FaceSide::convex);
  EXPECT_THAT(survey.text, AllOf(HasSubstr("radius [mm]"), HasSubstr("21.8014 deg"), HasSubstr("10, 3")));
}

// STEP is converted to the units of the part, also what is told of forms.
TEST(Survey, FormsAreInTheUnitsOfThePart) {
  const PartText part("units: {length: m, mass: kg, time: s}\nmesh: {file: " + sources + "bracket.step}\n");
  const reducer::Survey survey = reducer::survey(part.read());
  EXPECT_NEAR(only(survey, FormKind::cylinder).facts.form.radius, 0.004, 1e-9);
  EXPECT_NEAR(only(survey, FormKind::cylinder).facts.area, 80e-6 * std::numbers::pi, 1e-12);
  EXPECT_THAT(survey.text, HasSubstr("radius [m]"));
}

// The face of square.igs is a bilinear B-spline surface (meshes/README.md).
TEST(Survey, BSplinesAreWhatTheyDraw) {
  const reducer::Survey survey = reducer::survey(reducer::part_of_file(sources + "square.igs"));
  ASSERT_EQ(survey.faces.size(), 1u);
  EXPECT_EQ(survey.faces[0].facts.form.kind, FormKind::plane);
  EXPECT_FALSE(survey.faces[0].facts.is_outward) << "a face alone bounds no volume";
}

// OpenCASCADE gives shapes without a name that of its translator.
TEST(Survey, NamesOfTheProgramThatWroteAFileAreNoLabels) {
  const reducer::Survey survey = reducer::survey(reducer::part_of_file(sources + "square.step"));
  EXPECT_THAT(survey.text, AllOf(HasSubstr("face 1"), Not(HasSubstr("translator"))));
}

// A hole of two halves is one cylinder as a group.
TEST(Survey, GroupsOfFacesHaveOneForm) {
  const reducer::Survey survey = survey_of(
      "Disk(1) = {0, 0, 0, 5};\nRectangle(2) = {-9, 0, 0, 18, 9};\n"
      "BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }\nExtrude {0, 0, 7} { Surface{:}; }\n",
      "groups: {round: {of: faces, cylinder: {from: [0, 0, 0], to: [0, 0, 7], radius: 5}}}\n");
  ASSERT_EQ(survey.groups.size(), 1u);
  EXPECT_EQ(survey.groups[0].facts.form.kind, FormKind::cylinder);
  EXPECT_NEAR(survey.groups[0].facts.form.radius, 5.0, 1e-6);
  EXPECT_NEAR(survey.groups[0].facts.area, 70.0 * std::numbers::pi, 1e-6);
}

// Faces between two volumes have no outside, those of a hollow ball have theirs inside.
TEST(Survey, FacesInsideHaveNoOutside) {
  const reducer::Survey two = survey_of("Box(1) = {0, 0, 0, 1, 1, 1};\nBox(2) = {1, 0, 0, 1, 1, 1};\nCoherence;\n");
  ASSERT_EQ(two.faces.size(), 11u);
  for (const SurveyedFace& face : two.faces)
    EXPECT_EQ(face.facts.is_outward,
              std::abs(face.facts.center.x() - 1.0) > 1e-6 || std::abs(face.facts.form.axis.x()) < 0.5)
        << face.name;
  const reducer::Survey ball = survey_of(
      "Sphere(1) = {0, 0, 0, 4};\nSphere(2) = {0, 0, 0, 2};\nBooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; "
      "Delete; };\n");
  ASSERT_EQ(ball.faces.size(), 2u);
  for (const SurveyedFace& face : ball.faces)
    EXPECT_EQ(face.facts.side, face.facts.form.radius > 3.0 ? FaceSide::convex : FaceSide::concave);
}

TEST(Survey, MeshesAndDecksAreFittedByTheirCells) {
  const PartText part("mesh: {file: " + sources +
                      "plate-2.2.msh}\ngroups: {g: {edges: [2, 4]}}\nboundary: {a: {node: 1}}\n");
  const reducer::Survey plate = reducer::survey(part.read());
  EXPECT_THAT(plate.text, AllOf(HasSubstr("deck        face           24        0.24  [0.3, 0.2, 0]"),
                                HasSubstr("g           edge            8"),
                                HasSubstr("left        edge            4         0.4"), HasSubstr("plane")));
  ASSERT_EQ(plate.faces.size(), 1u);
  EXPECT_EQ(plate.faces[0].facts.form.kind, FormKind::plane);
  EXPECT_FALSE(plate.faces[0].facts.is_outward) << "a plate bounds no volume";
  EXPECT_NEAR(std::abs(plate.faces[0].facts.form.axis.z()), 1.0, 1e-12);
  for (const char* file : {"plate.bdf", "plate.inp"}) {
    const reducer::Survey deck = reducer::survey(reducer::part_of_file(sources + file));
    EXPECT_FALSE(deck.deck.shells.empty()) << file;
    for (const SurveyedFace& set : deck.groups) EXPECT_EQ(set.facts.form.kind, FormKind::plane) << file;
  }
}

// A pipe of 12 shells around and 2 along, radius 30, along x: written as an Abaqus deck.
TEST(Survey, PipeOfADeckIsACylinder) {
  std::string deck = "*NODE\n", shells = "*ELEMENT, TYPE=S4, ELSET=PIPE\n";
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 3; ++j)
      deck += fmt::format("{}, {:.6f}, {:.6f}, {:.6f}\n", 1 + 3 * i + j, 50.0 * j,
                          30.0 * std::cos(std::numbers::pi * i / 6.0), 30.0 * std::sin(std::numbers::pi * i / 6.0));
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 1 + 3 * i + j, b = 1 + 3 * ((i + 1) % 12) + j;
      shells += fmt::format("{}, {}, {}, {}, {}\n", 1 + 2 * i + j, a, b, b + 1, a + 1);
    }
  test_support::TemporaryFolder folder;
  write_text_file(folder.file("pipe.inp"), deck + shells +
                                               "*MATERIAL, NAME=S\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.85e-9\n"
                                               "*SHELL SECTION, ELSET=PIPE, MATERIAL=S\n2.\n");
  const reducer::Survey survey = reducer::survey(reducer::part_of_file(folder.file("pipe.inp")));
  ASSERT_FALSE(survey.groups.empty());
  EXPECT_EQ(survey.groups[0].name, "pipe");
  EXPECT_EQ(survey.groups[0].facts.form.kind, FormKind::cylinder);
  EXPECT_NEAR(survey.groups[0].facts.form.radius, 30.0, 1e-6);  // of six decimals
  EXPECT_LT((survey.groups[0].facts.form.axis - Vector3d::UnitX()).norm(), 1e-7);
  EXPECT_THAT(survey.text, HasSubstr("cylinder"));
}

TEST(FacesPicture, PageNamesEveryFaceWithItsForm) {
  test_support::TemporaryFolder folder;
  const std::string output = folder.file("faces.html");
  reducer::draw_faces(reducer::survey(reducer::part_of_file(sources + "bracket.step")), sources + "bracket.step",
                      output);
  const std::string page = whole(output);
  for (int face = 1; face <= 7; ++face) EXPECT_THAT(page, HasSubstr(fmt::format("\"name\":\"{}\"", face)));
  EXPECT_THAT(page, AllOf(HasSubstr("cylinder, concave, radius 4"), HasSubstr("tisserand-page")));
}

TEST(FacesPicture, TwoViewsByGnuplot) {
  test_support::TemporaryFolder folder;
  const reducer::Survey survey = reducer::survey(reducer::part_of_file(sources + "bracket.step"));
  if (!is_program("gnuplot")) {
    EXPECT_THAT(error_of([&] { reducer::draw_faces(survey, "b", folder.file("a.png")); }), HasSubstr("gnuplot-nox"));
    return;
  }
  const std::string svg = folder.file("faces.svg"), png = folder.file("faces.png");
  reducer::draw_faces(survey, sources + "bracket.step", svg);
  reducer::draw_faces(survey, sources + "bracket.step", png);
  const std::string text = whole(svg);
  for (int face = 1; face <= 7; ++face) EXPECT_THAT(text, HasSubstr(fmt::format(">{}<", face)));
  EXPECT_THAT(text, AllOf(HasSubstr("bracket.step"), Not(HasSubstr("hidden in both views"))));
  EXPECT_GT(std::filesystem::file_size(png), 10000u);
}

TEST(FacesPicture, SaysWhatCannotBeDrawn) {
  EXPECT_THAT(error_of([] { reducer::check_faces_output("faces.pdf"); }),
              AllOf(HasSubstr("faces.pdf"), HasSubstr(".svg")));
  EXPECT_THAT(error_of([] { reducer::draw_faces({}, "frame.part.yaml", "a.png"); }),
              AllOf(HasSubstr("frame.part.yaml"), HasSubstr("no faces")));
}

/// A square of one cell about (45, 45), at a height over the picture.
reducer::ColouredSurface square(double side, double z, std::vector<Vector3d>& position) {
  reducer::Cell cell;
  cell.shape = reducer::CellShape::quadrilateral4;
  for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    cell.nodes[position.size() % 4] = static_cast<int>(position.size());
    position.emplace_back(45.0 + side * x, 45.0 + side * y, z);
  }
  return {{cell}, {0.5, 0.5, 0.5}};
}

// A square of 30 pixels in the middle of a picture of 90: the number fits; in one of 4 pixels it is led outside. What
// lies behind another one is not seen, and is painted first.
TEST(Labels, AreOnTheirFaceOrBesideIt) {
  for (const int side : {30, 4}) {
    std::vector<Vector3d> position;
    const reducer::ColouredSurface front = square(side, 10.0, position), behind = square(side, -10.0, position);
    const reducer::PictureProjection projection({front, behind}, position, {}, 90, 90);
    const reducer::SeenPlace seen = projection.seen_places()[0];
    EXPECT_NEAR(seen.radius, 0.5 * side, 1e-9);
    EXPECT_LT((seen.place - Eigen::Vector2d(45, 45)).norm(), 1e-9);
    EXPECT_EQ(projection.seen_places()[1].radius, 0.0) << "it is hidden";
    EXPECT_TRUE(projection.covers({45, 45}));
    EXPECT_FALSE(projection.covers({5, 5}));
    EXPECT_EQ(reducer::fits_inside(seen, "7"), side == 30);
    reducer::LabelPlacer placer(projection);
    ASSERT_TRUE(placer.write_beside("7", seen));
    ASSERT_TRUE(placer.write_beside("8", seen));
    EXPECT_GT((placer.labels()[0].at - placer.labels()[1].at).norm(), 8.0) << "they lie over one another";
  }
}

// A square of 30 pixels before one of 60: of that the corners are seen.
TEST(Projection, PaintsFromBackToFront) {
  std::vector<Vector3d> position;
  reducer::ColouredSurface front = square(30, 10.0, position), behind = square(60, -10.0, position);
  front.colour = {0.4, 0, 0};
  behind.colour = {0, 0.4, 0};
  const auto polygons = reducer::PictureProjection({front, behind}, position, {}, 90, 90).polygons();
  std::size_t last_green = 0, first_red = polygons.size();
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i].colour[0] > polygons[i].colour[1]) first_red = std::min(first_red, i);
    if (polygons[i].colour[1] > polygons[i].colour[0]) last_green = i;
  }
  EXPECT_GT(last_green, 0u);
  EXPECT_LT(last_green, first_red);
  EXPECT_LT(first_red, polygons.size());
}

}  // namespace
}  // namespace tisserand::testing::survey_test
