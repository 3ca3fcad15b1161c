// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of read_part and check(Part): defaults, every notation, and the text of every error.
#include "formats/part/part.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::part_test {
namespace {

using ::testing::HasSubstr;

const std::string beam_part = R"(part: beam
units: {length: mm, mass: t, time: s}
materials: {steel: {E: 2.1e5, nu: 0.3, density: 7.8e-9}}
sections:
  own: {A: 9, Iy: 6.75, Iz: 6.5, J: 13.5, shear_area_y: 7.5, shear_area_z: 7.25}
points: {base: [0, 0, 0], tip: [141.42, 0, 0], up: [0, 10, 0]}
beams:
  rod: {from: base, to: tip, section: own, material: steel, elements: 40}
point_masses: {engine: {at: tip, mass: 3, inertia: [1, 2, 2.5]}}
boundary: [base, tip]
modes: 4
)";

Part read(const std::string& text, const std::vector<std::string>& changes = {}) {
  const Folder folder;
  return read_part(folder.file("part.yaml", text), overrides(changes));
}

std::string error(const std::string& text, const std::vector<std::string>& changes = {}) {
  const Folder folder;
  const std::string path = folder.file("part.yaml", text);
  return error_of(folder, [&] { read_part(path, overrides(changes)); });
}

TEST(Part, ReadsEveryValue) {
  const Part part = read(beam_part);
  EXPECT_EQ(part.name, "beam");
  EXPECT_EQ(part.units.length.label, "mm");
  EXPECT_EQ(part.units.mass.factor, 1000.0);
  ASSERT_EQ(part.materials.size(), 1u);
  EXPECT_EQ(part.materials[0].youngs_modulus, 2.1e5);
  EXPECT_EQ(part.materials[0].poisson_ratio, 0.3);
  EXPECT_EQ(part.materials[0].density, 7.8e-9);
  const Section& own = part.sections.at(0);
  EXPECT_EQ(own.area, 9.0);
  EXPECT_EQ(own.second_moment_y, 6.75);
  EXPECT_EQ(own.second_moment_z, 6.5);
  EXPECT_EQ(own.torsion_constant, 13.5);
  EXPECT_EQ(own.polar_moment, 13.25);
  EXPECT_EQ(own.shear_area_y, 7.5);
  EXPECT_EQ(own.shear_area_z, 7.25);
  ASSERT_EQ(part.points.size(), 3u);
  EXPECT_EQ(part.points[1].name, "tip");
  EXPECT_EQ(part.points[1].position, Eigen::Vector3d(141.42, 0, 0));
  EXPECT_THAT(part.points[1].where, HasSubstr("part.yaml:6:27"));
  const BeamLine& rod = part.beams.at(0);
  EXPECT_EQ(rod.from.name + rod.to.name + rod.section + rod.material, "basetipownsteel");
  EXPECT_EQ(rod.elements, 40);
  EXPECT_THAT(rod.where, HasSubstr("part.yaml:8:3"));
  EXPECT_EQ(part.point_masses.at(0).inertia, Eigen::Matrix3d(Eigen::Vector3d(1, 2, 2.5).asDiagonal()));
  ASSERT_EQ(part.boundary.size(), 2u);
  EXPECT_EQ(part.boundary[1].at.name, "tip");
  EXPECT_EQ(part.boundary[1].name, "tip");
  EXPECT_TRUE(part.boundary[1].translations && part.boundary[1].rotations);
  EXPECT_EQ(part.modes.count, 4);
  EXPECT_FALSE(part.modes.cutoff);
}

TEST(Part, Defaults) {
  std::string text = replaced(beam_part, "units: {length: mm, mass: t, time: s}\n", "");
  text = replaced(text, "modes: 4\n", "");
  text = replaced(text, ", inertia: [1, 2, 2.5]", "");
  text = replaced(text, ", shear_area_y: 7.5, shear_area_z: 7.25", "");
  text = replaced(text, "elements: 40", "elements: 40, theory: euler_bernoulli");
  const Part part = read(text);
  EXPECT_EQ(part.units.length.label, "m");
  EXPECT_EQ(part.modes.count, 0);
  EXPECT_EQ(part.sections[0].shear_area_y, 0.0);
  EXPECT_EQ(part.point_masses[0].inertia, Eigen::Matrix3d::Zero());
  EXPECT_FALSE(part.beams[0].through);
  EXPECT_FALSE(part.beams[0].orientation);
  EXPECT_EQ(part.beams[0].mass_matrix, MassMatrix::consistent);
  EXPECT_TRUE(part.beams[0].rotary_inertia);
  EXPECT_EQ(read(beam_part).beams[0].theory, BeamTheory::timoshenko);
}

TEST(Part, OtherNotations) {
  std::string text = replaced(beam_part, "units: {length: mm, mass: t, time: s}", "units: consistent");
  text = replaced(text, "modes: 4", "cutoff: 500");
  text = replaced(text, "[base, tip]", "{base: all, tip: translations, up: rotations}");
  text = replaced(text, "[1, 2, 2.5]", "[1, 2, 2.5, 0.1, 0.2, 0.3]");
  text = replaced(text, "elements: 40",
                  "size: 0.5, through: up, orientation: [0, 0, 2], mass_matrix: lumped, rotary_inertia: off");
  const Part part = read(text);
  EXPECT_FALSE(part.units.named());
  EXPECT_EQ(part.modes.cutoff, 500.0);
  EXPECT_FALSE(part.boundary[1].rotations);
  EXPECT_FALSE(part.boundary[2].translations);
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 2.5).finished();
  EXPECT_EQ(part.point_masses[0].inertia, expected);
  EXPECT_EQ(read(replaced(beam_part, "[1, 2, 2.5]", "[[1, 0.1, 0.2], [0.1, 2, 0.3], [0.2, 0.3, 2.5]]"))
                .point_masses[0]
                .inertia,
            expected);
  EXPECT_EQ(part.beams[0].elements, 0);
  EXPECT_EQ(part.beams[0].size, 0.5);
  EXPECT_EQ(part.beams[0].through.value(), Eigen::Vector3d(0, 10, 0));
  EXPECT_EQ(part.beams[0].orientation.value(), Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(part.beams[0].mass_matrix, MassMatrix::lumped);
  EXPECT_FALSE(part.beams[0].rotary_inertia);
  EXPECT_EQ(read(replaced(beam_part, "elements: 40", "elements: 1, through: [70, 5, 0]")).beams[0].through.value(),
            Eigen::Vector3d(70, 5, 0));
}

TEST(Part, ReadsTheModalBody) {
  const auto body = [](const std::string& keys) {
    return *read(beam_part + "modal_body: {" + keys + "}\n").modal_body;
  };
  EXPECT_FALSE(read(beam_part).modal_body.has_value());
  const ModalBodyRequest held = body("reference: tip, modes: 10");
  ASSERT_EQ(held.held.size(), 1u);
  EXPECT_EQ(held.held[0].place, "tip");
  EXPECT_EQ(held.held[0].components, 0b111111U);
  EXPECT_EQ(held.modes, 10);
  EXPECT_FALSE(held.all_nodes);
  EXPECT_EQ(held.damping, 0.0);
  EXPECT_TRUE(body("reference: mean_axis, modes: 1").held.empty());
  const ModalBodyRequest ends =
      body("reference: {base: [x, y, z, rx], tip: [y, z]}, modes: 6, nodes: all, damping: 0.02");
  ASSERT_EQ(ends.held.size(), 2u);
  EXPECT_EQ(ends.held[0].components, 0b001111U);
  EXPECT_EQ(ends.held[1].components, 0b000110U);
  EXPECT_TRUE(ends.all_nodes);
  EXPECT_EQ(ends.damping, 0.02);
}

class BadPart : public ::testing::TestWithParam<BadText> {};

TEST_P(BadPart, SaysWhatAndWhere) {
  const Marked text = take_mark(replaced(beam_part, GetParam().from, GetParam().to), "part.yaml");
  EXPECT_EQ(error(text.text), replaced_all(GetParam().expected, "^", text.place));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BadPart,
    ::testing::Values(
        BadText{"modes: 4", "mods: 4", "part.yaml:11:1: unknown key 'mods'; did you mean 'modes'?"},
        BadText{"modes: 4", "colour: red",
                "part.yaml:11:1: unknown key 'colour'; use one of part, units, mesh, materials, sections, points, "
                "groups, plates, discs, cylinders, extrusions, shells, solids, beams, point_masses, "
                "springs, spiders, boundary, modes, cutoff, accuracy, moments, method, eigensolver, mechanism, "
                "recovery, second_order, double_curvature, modal_body, supports, load_cases"},
        BadText{"modes: 4", "modes: 4\nsecond_order: no\ndouble_curvature: 20",
                "part.yaml:13:1: 'double_curvature' has no effect with second_order: no; remove one of them"},
        BadText{"elements: 40", "elements: 40, ^elements: 41",
                "^: beam 'rod': key 'elements' is given twice (first in line 8); remove one"},
        BadText{"up: [0, 10, 0]", "^tip: [0, 10, 0]",
                "^: point 'tip' is given twice (first in line 6); rename or remove one"},
        BadText{"from: base, ", "", "part.yaml:8:3: beam 'rod': missing key 'from'"},
        BadText{"E: 2.1e5, ", "", "part.yaml:3:13: material 'steel': missing key 'E'"},
        BadText{"part: beam\n", "", "part.yaml:1:1: missing key 'part'"},
        BadText{"boundary: [base, tip]\n", "", "part.yaml:1:1: missing key 'boundary'"},
        BadText{", time: s", "", "part.yaml:2:1: units: missing key 'time'"},
        BadText{"elements: 40", "rotary_inertia: on",
                "part.yaml:8:3: beam 'rod': neither 'elements' nor 'size' is given; give one of them"},
        BadText{"elements: 40", "elements: 40, size: 1",
                "part.yaml:8:3: beam 'rod': both 'elements' and 'size' are given; give one of them"},
        BadText{"modes: 4", "modes: 4\ncutoff: 500",
                "part.yaml:12:1: both 'modes' and 'cutoff' are given; give one of them"}));

INSTANTIATE_TEST_SUITE_P(
    Types, BadPart,
    ::testing::Values(
        BadText{"2.1e5", "^stiff", "^: material 'steel': E must be a number, not 'stiff'"},
        BadText{"2.1e5", "^\"2.1e5\"",
                "^: material 'steel': E must be a number, not the text \"2.1e5\"; remove the quotes"},
        BadText{
            "2.1e5", "^210 GPa",
            "^: material 'steel': E must be a number, not '210 GPa'; give the number alone, in the units of the file"},
        BadText{"E: 2.1e5, nu: 0.3", "nu: 0.3, E: ^'2,1'",
                "^: material 'steel': E must be a number, not the text \"2,1\"; write a decimal point instead of the "
                "comma"},
        BadText{"2.1e5", "^.inf", "^: material 'steel': E must be finite, not '.inf'"},
        BadText{"2.1e5", "^.nan", "^: material 'steel': E must be finite, not '.nan'"},
        BadText{"2.1e5", "^nan", "^: material 'steel': E must be finite, not 'nan'"},
        BadText{"2.1e5", "^1e999", "^: material 'steel': E must be finite, not '1e999'"},
        BadText{"2.1e5", "^[1, 2]", "^: material 'steel': E must be a number, not a list of 2"},
        BadText{"E: 2.1e5", "^E:", "^: material 'steel': E must be a number, not nothing"},
        BadText{"elements: 40", "elements: ^4.5", "^: beam 'rod': elements must be a whole number, not '4.5'"},
        BadText{"elements: 40", "elements: ^99999999999", "^: beam 'rod': elements '99999999999' is too large"},
        BadText{"[0, 10, 0]", "^[0, 10]", "^: point 'up': position has 2 numbers instead of 3; write it as [x, y, z]"},
        BadText{"[0, 10, 0]", "^7",
                "^: point 'up': position must be a list of numbers, not '7'; write it as [1, 2, 3]"},
        BadText{"[0, 10, 0]", "[0, ^ten, 0]", "^: point 'up': position[1] must be a number, not 'ten'"},
        BadText{"from: base", "from: ^[0, 0]", "^: beam 'rod': from has 2 numbers instead of 3; write it as [x, y, z]"},
        BadText{"elements: 40", "elements: 40, theory: ^timoschenko",
                "^: beam 'rod': unknown theory 'timoschenko'; did you mean 'timoshenko'?"},
        BadText{"[1, 2, 2.5]", "^[1, 2]",
                "^: point mass 'engine': inertia has 2 numbers; give [Ixx, Iyy, Izz], [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] "
                "or three rows"},
        BadText{"length: mm", "length: ^mn",
                "^: units: unknown unit of length 'mn'; known units of length are m, mm, cm, km, in, ft"},
        BadText{"units: {length: mm, mass: t, time: s}", "units: ^consitent",
                "^: units: unknown value 'consitent'; did you mean 'consistent'?"},
        BadText{"materials: {steel: {E: 2.1e5, nu: 0.3, density: 7.8e-9}}", "materials: ^steel",
                "^: materials must be a map from names to entries, not 'steel'; write the name of each material, a "
                "colon, and its keys\n"
                "part.yaml:8:54: beam 'rod': there is no material 'steel'; define it; no material is defined"},
        BadText{"[base, tip]", "^base",
                "^: boundary must be a list of points, not 'base'; write it as [base, tip] or {base: all, tip: "
                "translations}"},
        BadText{"[base, tip]", "{base: ^al}", "^: boundary node 'base': unknown value 'al'; did you mean 'all'?"}));

INSTANTIATE_TEST_SUITE_P(
    Meaning, BadPart,
    ::testing::Values(
        BadText{"2.1e5", "^-1", "^: material 'steel': E -1 must be positive"},
        BadText{"7.8e-9", "^0", "^: material 'steel': density 0 must be positive"},
        BadText{"nu: 0.3", "nu: ^0.5", "^: material 'steel': nu 0.5 must lie between -1 and 0.5"},
        BadText{"nu: 0.3", "nu: ^-1", "^: material 'steel': nu -1 must lie between -1 and 0.5"},
        BadText{"A: 9", "A: ^0", "^: section 'own': A 0 must be positive"},
        BadText{"Iy: 6.75", "Iy: ^-6.75", "^: section 'own': Iy -6.75 must be positive"},
        BadText{"shear_area_y: 7.5", "shear_area_y: ^-7", "^: section 'own': shear_area_y -7 must be positive or 0"},
        BadText{"shear_area_y: 7.5, ", "",
                "part.yaml:5:3: section 'own': only one of the two shear areas is given; give both, or neither for "
                "beams without shear deformation"},
        BadText{", shear_area_y: 7.5, shear_area_z: 7.25", "",
                "part.yaml:8:39: beam 'rod': section 'own' has no shear areas; give shear_area_y and shear_area_z, or "
                "set theory: euler_bernoulli"},
        BadText{"{A: 9, Iy: 6.75, Iz: 6.5, J: 13.5, shear_area_y: 7.5, shear_area_z: 7.25}",
                "{shape: hollow_circle, radius: 20, thickness: ^30}",
                "^: section 'own': thickness 30 mm exceeds radius 20 mm; use a solid section or reduce thickness"},
        BadText{"{A: 9, Iy: 6.75, Iz: 6.5, J: 13.5, shear_area_y: 7.5, shear_area_z: 7.25}",
                "{shape: hollow_rectangle, width: 20, height: 30, thickness: ^10}",
                "^: section 'own': thickness 10 mm equals half of the width 20 mm; use a solid section or reduce "
                "thickness"},
        BadText{"{A: 9, Iy: 6.75, Iz: 6.5, J: 13.5, shear_area_y: 7.5, shear_area_z: 7.25}",
                "{shape: circle, radius: ^-2}", "^: section 'own': radius -2 mm must be positive"},
        BadText{"{A: 9, Iy: 6.75, Iz: 6.5, J: 13.5, shear_area_y: 7.5, shear_area_z: 7.25}",
                "{shape: circle, radius: 2, ^thickness: 1}",
                "^: section 'own': unknown key 'thickness'; use one of shape, radius"},
        BadText{"{A: 9, Iy: 6.75, Iz: 6.5, J: 13.5, shear_area_y: 7.5, shear_area_z: 7.25}",
                "{shape: ^cirlce, radius: 2}", "^: section 'own': unknown shape 'cirlce'; did you mean 'circle'?"},
        BadText{"section: own", "section: ^owm", "^: beam 'rod': there is no section 'owm'; did you mean 'own'?"},
        BadText{"material: steel,", "material: ^stel,",
                "^: beam 'rod': there is no material 'stel'; did you mean 'steel'?"},
        BadText{"to: tip", "to: ^top", "^: beam 'rod': there is no point 'top'; did you mean 'tip'?"},
        BadText{"at: tip", "at: ^xyz", "^: point mass 'engine': there is no point 'xyz'; use one of base, tip, up"},
        BadText{"[base, tip]", "[base, ^tipp]",
                "^: boundary node 'tipp': there is no point 'tipp'; did you mean 'tip'?"},
        BadText{"[base, tip]", "[base, ^base]", "^: boundary node 'base': the name is used twice; rename one"},
        BadText{
            "[base, tip]", "^[]",
            "^: the part has no boundary node; list the points at which it is joined or loaded: boundary: [base, tip]"},
        BadText{
            "  rod: {from: base, to: tip, section: own, material: steel, elements: 40}\n", "",
            "part.yaml:7:1: the part has no elements; give beams, plates, discs, cylinders, extrusions, or a mesh file "
            "(mesh: {file: ...})"},
        BadText{"to: tip", "to: base",
                "part.yaml:8:3: beam 'rod': has zero length: both ends are at (0, 0, 0); move one end"},
        BadText{"elements: 40", "elements: ^0", "^: beam 'rod': elements 0 must be 1 or more"},
        BadText{"elements: 40", "size: ^0", "^: beam 'rod': size 0 must be positive"},
        BadText{"elements: 40", "size: ^1e-9",
                "^: beam 'rod': size 1e-09 makes 1.41e+11 elements; the limit is 1e+06; give a larger size"},
        BadText{"elements: 40", "elements: 4, orientation: ^[0, 0, 0]",
                "^: beam 'rod': orientation has zero length; give the direction of the local y axis"},
        BadText{"elements: 40", "elements: 4, orientation: ^[-3, 0, 0]",
                "^: beam 'rod': orientation (-3, 0, 0) is parallel to the beam; give the direction of the local y "
                "axis, not parallel to the beam"},
        BadText{"elements: 40", "elements: 4, through: ^[70, 0, 0]",
                "^: beam 'rod': the point (70, 0, 0) of the arc lies on the line through its ends; move it off the "
                "line, or remove 'through' for a straight beam"},
        BadText{"elements: 40", "elements: 4, through: ^base",
                "^: beam 'rod': the point (0, 0, 0) of the arc lies on the line through its ends; move it off the "
                "line, or remove 'through' for a straight beam"},
        BadText{"elements: 40", "elements: 4, through: ^upp", "^: beam 'rod': unknown point 'upp'; did you mean 'up'?"},
        BadText{"mass: 3", "mass: ^-3", "^: point mass 'engine': mass -3 must not be negative"},
        BadText{
            "[1, 2, 2.5]", "^[1, 2, 4]",
            "^: point mass 'engine': the largest of the principal moments of inertia 1, 2, 4 exceeds the sum of the "
            "other two, which is impossible for a body; check values, order and units"},
        BadText{"[1, 2, 2.5]", "^[1, 2, -1]",
                "^: point mass 'engine': inertia has the negative principal moment -1; check values, order and units"},
        BadText{"[1, 2, 2.5]", "^[[1, 0.2, 0], [0, 1, 0], [0, 0, 1]]",
                "^: point mass 'engine': inertia is not symmetric; give a symmetric matrix"},
        BadText{"modes: 4", "double_curvature: ^-1",
                "^: double_curvature -1 must be 0 to 100 shapes; 20 shapes are enough for plates"},
        BadText{"modes: 4", "double_curvature: ^101",
                "^: double_curvature 101 must be 0 to 100 shapes; 20 shapes are enough for plates"},
        BadText{"modes: 4", "modes: ^-1", "^: modes -1 must not be negative; write modes: 0 for Guyan reduction"},
        BadText{"modes: 4", "cutoff: ^0", "^: cutoff 0 must be positive"},
        BadText{"modes: 4", "modes: 4\nmethod: rubin\nmoments: ^3",
                "^: 'moments' needs modes with the boundary held; remove it, or write method: craig_bampton"},
        BadText{"modes: 4", "^accuracy: {error: 1e-3, up_to: 50}\nmoments: 3",
                "^: 'accuracy' chooses the number of moment vectors itself; remove `moments`, or write moments: 0 for "
                "internal modes only"},
        BadText{"up: [", "^2nd: [",
                "^: point '2nd': not a valid name; use letters, digits, _ and -, and begin with a letter or _"},
        BadText{"up: [", "^a/b: [",
                "^: point 'a/b': not a valid name; use letters, digits, _ and -, and begin with a letter or _"}));

INSTANTIATE_TEST_SUITE_P(
    ModalBodies, BadPart,
    ::testing::Values(
        BadText{"modes: 4", "^modal_body: {modes: 3}", "^: modal_body: missing key 'reference'"},
        BadText{"modes: 4", "modal_body: {reference: tip, modes: ^0}",
                "^: modal_body: modes 0 must be 1 or more; for a body without modes, use the superelement, or a rigid "
                "body of the scene"},
        BadText{"modes: 4", "modal_body: {reference: tip, modes: 3, damping: ^-1}",
                "^: modal_body: damping -1 must not be negative"},
        BadText{"modes: 4", "modal_body: {reference: ^tipp, modes: 3}",
                "^: modal_body: there is no place 'tipp'; did you mean 'tip'?"},
        BadText{"modes: 4", "modal_body: {reference: ^{base: [x, y, z], tip: [y, z]}, modes: 3}",
                "^: modal_body: 5 components are held; hold six components: fewer do not fix the frame, more stiffen "
                "the body"},
        BadText{"modes: 4", "modal_body: {reference: {base: [x, ^ry2]}, modes: 3}",
                "^: modal_body: unknown component 'ry2'; did you mean 'ry'?"},
        BadText{"modes: 4", "supports: {base: [x, ^q]}", "^: support 'base': unknown direction 'q'; did you mean 'x'?"},
        BadText{"modes: 4", "supports: {^bse: all}", "^: support 'bse': there is no group 'bse'; did you mean 'base'?"},
        BadText{"modes: 4", "supports: {^left: {at: base}}",
                "^: support 'left': neither 'directions' nor 'symmetry' is given; give one of them"},
        BadText{"modes: 4", "supports: {left: {at: ^bse, directions: all}}",
                "^: support 'left': there is no point 'bse'; did you mean 'base'?"},
        BadText{"modes: 4", "supports: {left: {at: base, ^on: [], directions: all}}",
                "^: support 'left': both 'on' and a place are given; give one of them"},
        BadText{"modes: 4", "supports: {left: {at: base, symmetry: ^w}}",
                "^: support 'left': unknown symmetry 'w'; did you mean 'x'?"},
        BadText{
            "modes: 4", "supports: {left: {at: ^{centroid: rim}, directions: all}}",
            "^: support 'left': a centroid is not a node of the part; put a spider there and name it: spiders: {pad: "
            "{kind: averaging, on: ...}}"},
        BadText{"modes: 4", "load_cases: {^w: {}}",
                "^: load case 'w' has no loads; give forces, pressures, line_loads or gravity"},
        BadText{"modes: 4", "load_cases: {w: {^gravitiy: [0, 0, 1]}}",
                "^: load case 'w': unknown key 'gravitiy'; did you mean 'gravity'?"},
        BadText{"modes: 4", "load_cases: {w: {forces: {^tipp: [0, 0, 1]}}}",
                "^: load case 'w': force 'tipp': there is no point 'tipp'; did you mean 'tip'?"},
        BadText{"modes: 4", "load_cases: {w: {forces: {^tip: {at: base}}}}",
                "^: force 'tip': neither 'force' nor 'moment' is given; give one of them"},
        BadText{"modes: 4", "load_cases: {w: {pressures: {rod: ^high}}}",
                "^: pressure 'rod': pressure must be a number, not 'high'"},
        BadText{"modes: 4", "load_cases: {w: {line_loads: {^rud: [0, 0, 1]}}}",
                "^: load case 'w': line load: there is no group 'rud'; did you mean 'rod'?"}));

TEST(Part, ReadsSupportsAndLoadCases) {
  const Part part = read(replaced(beam_part, "modes: 4", R"(modes: 4
spiders: {hub: {kind: rigid, on: rim}}
groups: {rim: {of: nodes, box: [[0, 0, 0], [1, 1, 1]]}}
supports:
  base: all
  hub: [x, rz]
  rim: y
  wall: {on: [rim], symmetry: y}
  foot: {at: tip, directions: translations}
load_cases:
  one: {forces: {tip: [1, 2, 3], more: {at: hub, moment: [4, 5, 6]}}, gravity: [0, 0, -9.81]}
  two: {pressures: {rim: -7}, line_loads: {rod: [8, 9, 10]}}
)"));
  ASSERT_EQ(part.supports.size(), 5u);
  EXPECT_EQ(part.supports[0].at.name, "base");
  EXPECT_EQ(part.supports[0].components, 0b111111u);
  EXPECT_TRUE(part.supports[0].where_present);
  EXPECT_EQ(part.supports[1].components, 0b100001u);
  EXPECT_FALSE(part.supports[1].where_present);
  EXPECT_EQ(part.supports[2].on, std::vector<std::string>{"rim"});
  EXPECT_EQ(part.supports[2].components, 0b000010u);
  EXPECT_EQ(part.supports[3].components, 0b101010u);  // y, rx, rz
  EXPECT_EQ(part.supports[3].symmetry, 1);
  EXPECT_EQ(part.supports[4].at.name, "tip");
  EXPECT_EQ(part.supports[4].components, 0b000111u);
  ASSERT_EQ(part.load_cases.size(), 2u);
  const PartLoadCase &one = part.load_cases[0], &two = part.load_cases[1];
  EXPECT_EQ(one.forces[0].force, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(one.forces[1].at.name, "hub");
  EXPECT_EQ(one.forces[1].moment, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(one.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(two.pressures[0].pressure, -7.0);
  EXPECT_EQ(two.line_loads[0].force, Eigen::Vector3d(8, 9, 10));
}

// `reducer solve` needs no boundary; without supports and loads a part is there to be reduced.
TEST(Part, BoundaryIsRequiredWhereNothingIsSolved) {
  const std::string open = replaced(beam_part, "boundary: [base, tip]\n", "");
  EXPECT_THAT(error(open), HasSubstr("missing key 'boundary'"));
  EXPECT_TRUE(read(open + "supports: {base: all}\n").boundary.empty());
}

TEST(Part, TellsAllErrorsAtOnceInTheOrderOfTheLines) {
  std::string text = replaced(beam_part, "length: mm", "lenght: mm");
  text = replaced(text, "nu: 0.3", "nu: high");
  text = replaced(text, "A: 9", "A: -9");
  text = replaced(text, "to: tip", "to: tipp");
  text = replaced(text, "modes: 4", "mods: 4");
  EXPECT_EQ(error(text),
            "part.yaml:2:1: units: missing key 'length'\n"
            "part.yaml:2:9: units: unknown key 'lenght'; did you mean 'length'?\n"
            "part.yaml:3:35: material 'steel': nu must be a number, not 'high'\n"
            "part.yaml:5:12: section 'own': A -9 must be positive\n"
            "part.yaml:8:25: beam 'rod': there is no point 'tipp'; did you mean 'tip'?\n"
            "part.yaml:11:1: unknown key 'mods'; did you mean 'modes'?");
}

TEST(Part, CheckOfAStructThatNoFileGave) {
  Part part = read(beam_part);
  EXPECT_NO_THROW(check(part));
  part.points[2].position.x() = std::numeric_limits<double>::quiet_NaN();
  part.materials[0].density = std::numeric_limits<double>::infinity();
  part.boundary[0].translations = part.boundary[0].rotations = false;
  const Folder folder;
  const std::string text = error_of(folder, [&] { check(part); });
  EXPECT_THAT(text, HasSubstr("point 'up': position must be finite"));
  EXPECT_THAT(text, HasSubstr("material 'steel': density inf must be positive"));
  EXPECT_THAT(text, HasSubstr("boundary node 'base': keeps neither translations nor rotations"));
}

}  // namespace
}  // namespace tisserand::formats::part_test
