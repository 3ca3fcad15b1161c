// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of part.yaml by shape, and what readers and scenes refuse.
#include <cmath>

#include <gtest/gtest.h>

#include "formats/part/part.hpp"
#include "formats/scene/scene.hpp"
#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"
#include "formats/sections/walls.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::section_reader_test {
namespace {

std::string part_with(const std::string& section) {
  return "part: p\nmaterials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}\nsections:\n  s: " + section +
         "\npoints: {a: [0, 0, 0], b: [1, 0, 0]}\nbeams: {l: {from: a, to: b, section: s, material: steel, elements: "
         "2}}\n"
         "boundary: [a, b]\nmodes: 2\n";
}

Section read(const std::string& section) {
  const Folder folder;
  return read_part(folder.file("p.yaml", part_with(section)), {}).sections.at(0);
}

void expect_same(const Section& a, const Section& b) {
  for (const auto value :
       {&Section::area, &Section::second_moment_y, &Section::second_moment_z, &Section::second_moment_yz,
        &Section::torsion_constant, &Section::shear_area_y, &Section::shear_area_z, &Section::centroid_y,
        &Section::centroid_z, &Section::shear_center_y, &Section::shear_center_z, &Section::shear_coupling})
    EXPECT_DOUBLE_EQ(a.*value, b.*value);
}

TEST(SectionReader, Profiles) {
  expect_same(read("{shape: I, height: 0.2, width: 0.1, web: 0.006, flange: 0.009}"),
              profile_section("I", {0.2, 0.1, 0.006, 0.009, 0.1, 0.009}));
  expect_same(read("{shape: I, height: 0.2, width: 0.1, web: 0.006, flange: 0.009, bottom_width: 0.05, "
                   "bottom_flange: 0.01}"),
              profile_section("I", {0.2, 0.1, 0.006, 0.009, 0.05, 0.01}));
  for (const std::string shape : {"channel", "tee", "zed"})
    expect_same(read("{shape: " + shape + ", height: 0.2, width: 0.1, web: 0.006, flange: 0.009}"),
                profile_section(shape, {0.2, 0.1, 0.006, 0.009}));
  expect_same(read("{shape: box, height: 0.2, width: 0.1, top: 0.01, bottom: 0.02, left: 0.003, right: 0.004}"),
              profile_section("box", {0.2, 0.1, 0.01, 0.02, 0.003, 0.004}));
  expect_same(read("{shape: hat, height: 0.05, width: 0.04, brim: 0.015, thickness: 0.002}"),
              profile_section("hat", {0.05, 0.04, 0.015, 0.002}));
  const Section section =
      read("{shape: angle, height: 0.2, width: 0.1, web: 0.006, flange: 0.009, axis: shear_center}");
  EXPECT_DOUBLE_EQ(section.centroid_y, -section.shear_center_y);
  EXPECT_NE(section.centroid_y, 0.0);
  EXPECT_EQ(section.shape, "angle");
}

TEST(SectionReader, PolygonsAndWalls) {
  expect_same(read("{shape: polygon, outline: [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]}"),
              polygon_section({{{0, 0}, {0.2, 0}, {0.2, 0.1}, {0, 0.1}}, {}}));
  const Section hole = read(
      "{shape: polygon, axis: origin, outline: [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]],\n"
      "    holes: [[[0.05, 0.02], [0.15, 0.02], [0.15, 0.08]]]}");
  EXPECT_NEAR(hole.area, 0.02 - 0.003, 1e-12);
  EXPECT_NEAR(hole.centroid_y, (0.02 * 0.1 - 0.003 * 0.35 / 3) / 0.017, 1e-12);
  const Section walls = read(
      "{shape: walls, axis: origin, walls: [{along: [[0.05, 0], [0, 0], [0, 0.1]], thickness: 0.002},\n"
      "    {along: [[0, 0.1], [0.05, 0.1]], thickness: 0.003}]}");
  const std::vector<WallLine> lines{{{{0.05, 0}, {0, 0}, {0, 0.1}}, 0.002}, {{{0, 0.1}, {0.05, 0.1}}, 0.003}};
  EXPECT_DOUBLE_EQ(walls.torsion_constant, walls_section(lines).torsion_constant);
  EXPECT_DOUBLE_EQ(walls.centroid_y, walls_centroid(lines).x());
}

TEST(SectionReader, ConstantsOutOfPrincipalAxes) {
  const Section s = read(
      "{A: 1, Iy: 2, Iz: 3, J: 4, Iyz: -1, shear_area_y: 0.5, shear_area_z: 0.6, centroid: [0.1, 0.2],\n"
      "    shear_center: [-0.3, 0.4]}");
  EXPECT_EQ(s.second_moment_yz, -1.0);
  EXPECT_EQ(s.centroid_z, 0.2);
  EXPECT_EQ(s.shear_center_y, -0.3);
  const Section rod = read("{shape: rod, A: 2e-4}");
  EXPECT_EQ(rod.area, 2e-4);
  EXPECT_EQ(rod.second_moment_y, 0.0);
  EXPECT_EQ(rod.torsion_constant, 0.0);
}

std::string error(const std::string& section) {
  const Folder folder;
  return error_of(folder, [&] { read_part(folder.file("p.yaml", part_with(section)), {}); });
}

TEST(SectionReader, FaultsAreNamed) {
  EXPECT_EQ(
      error("{shape: I, height: 0.2, width: 0.1, web: 0.6, flange: 0.009}"),
      "p.yaml:4:3: section 's': web 0.6 is not less than width 0.1; correct the sizes; heights and widths are outer "
      "ones");
  EXPECT_EQ(error("{shape: tee, height: 0.2, width: 0.1, web: -1, flange: 0.009}"),
            "p.yaml:4:49: section 's': web -1 m must be positive");
  EXPECT_EQ(error("{shape: tea, height: 0.2}"), "p.yaml:4:14: section 's': unknown shape 'tea'; did you mean 'tee'?");
  EXPECT_EQ(
      error("{shape: polygon, outline: [[0, 0], [1, 1], [1, 0], [0, 1]]}"),
      "p.yaml:4:32: section 's': the side from (0, 0) to (1, 1) touches or crosses the side from (1, 0) to (0, 1); "
      "give the corners in order, such that sides do not cross and holes lie inside the outline");
  EXPECT_EQ(error("{shape: polygon, outline: [[0, 0], [1, 1, 2], [1, 0]]}"),
            "p.yaml:4:41: section 's': a point of outline has 3 numbers; write [y, z]");
  EXPECT_EQ(error("{shape: walls, walls: [{along: [[0, 0], [1, 0]], thickness: 0.1}]}"),
            "p.yaml:4:28: section 's': all walls lie on one straight line; to join two lines, write the shared point "
            "in both");
  EXPECT_NE(error("{shape: walls, walls: 3}"), "");
  EXPECT_NE(error("{shape: walls, walls: [{along: 7, thickness: 1}]}"), "");
  EXPECT_NE(error("{shape: polygon, outline: [[0, 0], [1, 0], [1, 1]], holes: 3}"), "");
  EXPECT_NE(error("{shape: polygon, outline: [[0, 0], [1e200, 0], [1e200, 1e200]]}"), "");
  EXPECT_NE(error("{shape: polygon, outline: [[0, 0], [1e-200, 0], [1e-200, 1e-200]]}"), "");
  EXPECT_EQ(error("{shape: polygon, outline: [[0, 0], [1, 0], [1, 1e-7]]}"),
            "p.yaml:4:3: section 's': parts of the section are too thin or too small, compared with the whole, to "
            "compute its torsion constant; give it as `walls`, or give its constants");
  EXPECT_EQ(error("{A: 1, Iy: 2, Iz: 3, J: 4, Iyz: 3, shear_area_y: 1, shear_area_z: 1}"),
            "p.yaml:4:38: section 's': Iyz 3 is not less than sqrt(Iy Iz) 2.44949");
  EXPECT_EQ(error("{A: 1, Iy: 2, Iz: 3, J: 4, centroid: [3], shear_area_y: 1, shear_area_z: 1}"),
            "p.yaml:4:43: section 's': centroid has 1 numbers; give [y, z]");
  EXPECT_EQ(error("{shape: rod, A: 1, J: -1}"), "p.yaml:4:28: section 's': J -1 must be positive or 0");
}

const std::string by_stiffness =
    "{stiffness: {EA: 1e7, GAy: 3e6, GAz: 2e6, EIy: 40, EIz: 50, GJ: 60}, mass_per_length: 0.3, rotary_inertia: [2e-4, "
    "5e-4]}";

TEST(SectionReader, ByStiffness) {
  const Folder folder;
  const auto part = [&folder](const std::string& section, const std::string& material) {
    return read_part(folder.file("p.yaml", "part: p\nsections:\n  s: " + section +
                                               "\nmaterials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}\npoints: {a: "
                                               "[0, 0, 0], b: [1, 0, 0]}\nbeams: {l: {from: a, to: b, section: s, " +
                                               material + "elements: 2}}\nboundary: [a, b]\nmodes: 2\n"),
                     {});
  };
  const Section s = part(by_stiffness, "").sections.at(0);
  EXPECT_TRUE(s.by_stiffness);
  EXPECT_EQ(s.area, 1e7);
  EXPECT_EQ(s.shear_area_y, 3e6);
  EXPECT_EQ(s.shear_area_z, 2e6);
  EXPECT_EQ(s.second_moment_y, 40.0);
  EXPECT_EQ(s.second_moment_z, 50.0);
  EXPECT_EQ(s.torsion_constant, 60.0);
  const SectionInertia inertia = section_inertia(s, unit_material(""));
  EXPECT_EQ(inertia.mass, 0.3);
  EXPECT_EQ(inertia.about_y, 2e-4);
  EXPECT_EQ(inertia.about_z, 5e-4);
  EXPECT_EQ(inertia.about_x, 7e-4);
  EXPECT_EQ(unit_material("").shear_modulus(), 1.0);

  const auto error = [&](const std::string& section, const std::string& material) {
    return error_of(folder, [&] { part(section, material); });
  };
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = by_stiffness;
    return text.replace(text.find(from), from.size(), to);
  };
  const auto has = [&](const std::string& section, const std::string& words) {
    const std::string text = error(section, "");
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  EXPECT_EQ(error(by_stiffness, "material: steel, "),
            "p.yaml:6:51: beam 'l': 'material' cannot be combined with a section by stiffness; remove it: the section "
            "needs none");
  has("{shape: circle, radius: 0.1}", "beam 'l' has no 'material'; add it, or give the section by stiffness");
  has(changed("EA: 1e7, ", ""), "EA");
  has(changed("GJ: 60", "GJ: -60"), "section 's': stiffness.GJ -60 must be positive");
  has(changed("GAy: 3e6, ", ""), "section 's': only one of GAy and GAz is given");
  has(changed("mass_per_length: 0.3, ", ""), "mass_per_length");
  has(changed("mass_per_length: 0.3", "mass_per_length: -1"), "mass_per_length -1 must be positive");
  has(changed(", rotary_inertia: [2e-4, 5e-4]", ""), "rotary_inertia");
  has(changed("[2e-4, 5e-4]", "[2e-4, -5e-4]"), "rotary_inertia [0.0002, -0.0005] must be positive");
  has(changed("[2e-4, 5e-4]", "[2e-4]"), "rotary_inertia has 1 numbers");
  has("{stiffness: 3, mass_per_length: 1, rotary_inertia: [1, 1]}", "stiffness is not a map");
  has(changed("mass_per_length", "A: 1, mass_per_length"), "'A'");
}

TEST(SectionReader, BeamsOfScenesByStiffness) {
  const Folder folder;
  const auto text = [](const std::string& more) {
    return "scene: s\nbodies:\n  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 2, " + more +
           "section: " + by_stiffness + "}\nintegrator: {step: 0.01, end: 0.1}\n";
  };
  const Scene scene = read_scene(folder.file("s.yaml", text("")), {});
  const auto& rod = std::get<BeamBodySpec>(scene.bodies.at(0));
  EXPECT_EQ(rod.section.area, 1e7);
  EXPECT_EQ(rod.material.youngs_modulus, 1.0);
  EXPECT_NE(
      error_of(folder,
               [&] { read_scene(folder.file("s.yaml", text("material: {E: 1e11, nu: 0.3, density: 7800}, ")), {}); })
          .find("body 'rod': 'material' has no effect with a section by stiffness; remove it"),
      std::string::npos);
}

/// The geometrically exact beams of `mechanism` know one axis for bending, torsion and mass.
TEST(SectionReader, NonlinearBeamsNeedPrincipalAxes) {
  const Folder folder;
  const auto scene_error = [&folder](const std::string& section) {
    const std::string text =
        "scene: s\nbodies:\n  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 2, material: "
        "{E: 1e11, nu: 0.3, density: 7800},\n    section: " +
        section + "}\nintegrator: {step: 0.01, end: 0.1}\n";
    return error_of(folder, [&] { read_scene(folder.file("s.yaml", text), {}); });
  };
  EXPECT_EQ(scene_error("{shape: I, height: 0.2, width: 0.1, web: 0.006, flange: 0.009}"), "");
  EXPECT_EQ(
      scene_error("{shape: zed, height: 0.2, width: 0.1, web: 0.006, flange: 0.009}")
          .find("s.yaml:4:14: body 'rod': the section does not fit a nonlinear beam: its axes are not principal axes"),
      0u);
  EXPECT_NE(scene_error("{shape: channel, height: 0.2, width: 0.1, web: 0.006, flange: 0.009}").find("shear centre"),
            std::string::npos);
  EXPECT_NE(scene_error("{shape: rod, A: 0.01}"), "");
}

}  // namespace
}  // namespace tisserand::formats::section_reader_test
