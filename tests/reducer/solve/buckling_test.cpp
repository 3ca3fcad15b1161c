// SPDX-License-Identifier: GPL-3.0-or-later
// Load factors of `reducer solve --buckling`: columns of beams and of solids, plates, open sections, rigid arms and
// averages, against closed forms; what is refused and what the files hold.
#include "reducer/solve/buckling.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/sections/monosymmetry.hpp"
#include "reducer/properties/solid_material.hpp"
#include "reducer/solve/files.hpp"
#include "reducer/solve/report.hpp"
#include "reducer/solve/solve.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/solve/solving.hpp"
#include "tests/support/meshes/solid_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::buckling_test {
namespace {

using Eigen::Vector3d;
using reducer::CaseBuckling;
using reducer::Solution;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double pi2 = std::numbers::pi * std::numbers::pi;

Solution buckled(const formats::Part& part, int count) {
  start_solvers();
  return reducer::solve(part, {0, {}, count}, [](const std::string&) {});
}

CaseBuckling first_case(const std::string& text, int count) {
  return buckled(part_of_text(text), count).buckling.at(0);
}

std::string buckling_error(const std::string& text) {
  return test_support::error_of([&] { buckled(part_of_text(text), 1); });
}

/// A slender beam of length 1 along x, width 0.02 along y, height 0.01 along z, E = 2e11.
std::string column(const std::string& more, int elements = 20) {
  return R"(part: column
materials: {m: {E: 2e11, nu: 0.3, density: 8000}}
sections: {bar: {shape: rectangle, width: 0.02, height: 0.01}}
points: {base: [0, 0, 0], tip: [1, 0, 0]}
beams: {rod: {from: base, to: tip, section: bar, material: m, theory: euler_bernoulli, elements: )" +
         std::to_string(elements) + "}}\n" + more;
}
constexpr double EI_weak = 2e11 * 0.02 * 1e-6 / 12.0;
const std::string push = "load_cases: {axial: {forces: {tip: [-1, 0, 0]}}}\n";

// Euler's loads (Timoshenko and Gere, Theory of Elastic Stability, 2nd ed. 1961, section 2.4): π² EI/(μL)². In the
// other plane EI is four times as large, so the second load between hinges is there twice. Twenty cubic elements are
// within (π/20)⁴/720 = 8e-7 of it in the first mode, sixteen times that in the second.
TEST(SolvedBuckling, EulersColumns) {
  const CaseBuckling hinged = first_case(column("supports: {base: [x, y, z, rx], tip: [y, z, rx]}\n" + push), 3);
  ASSERT_EQ(hinged.factor.size(), 3);
  EXPECT_NEAR(hinged.factor[0] / (pi2 * EI_weak), 1.0, 2e-6);
  EXPECT_NEAR(hinged.factor[1] / (4.0 * pi2 * EI_weak), 1.0, 3e-5);
  EXPECT_NEAR(hinged.factor[2] / (4.0 * pi2 * EI_weak), 1.0, 3e-5);
  const double free = first_case(column("supports: {base: all}\n" + push), 1).factor[0];
  EXPECT_NEAR(free / (0.25 * pi2 * EI_weak), 1.0, 2e-6);
  const double fixed = first_case(column("supports: {base: all, tip: [y, z, rx, ry, rz]}\n" + push), 1).factor[0];
  EXPECT_NEAR(fixed / (4.0 * pi2 * EI_weak), 1.0, 3e-5);
  const double propped = first_case(column("supports: {base: all, tip: [y, z]}\n" + push), 1).factor[0];
  EXPECT_NEAR(propped / (20.190728556 * EI_weak), 1.0, 3e-5);  // tan kL = kL: kL = 4.493409458
}

// A square column buckles in two planes at the same load: one Krylov sequence sees only one of them.
TEST(SolvedBuckling, EqualFactorsAreAllFound) {
  std::string text = column("supports: {base: all}\n" + push);
  text.replace(text.find("width: 0.02"), 11, "width: 0.01");
  const CaseBuckling b = first_case(text, 1);
  ASSERT_EQ(b.factor.size(), 2);  // the pair is completed
  EXPECT_NEAR(b.factor[1] / b.factor[0], 1.0, 1e-9);
  EXPECT_LT(b.residual, 1e-8);
}

/// k of k c tan kL = 1: a column of length 1 that is clamped at its base, with a rigid arm of length c beyond its tip
/// that carries the load: EI v'' = P (δ − v), δ = v(1) + c v'(1).
double load_of_arm(double c) {
  double low = 1e-6, high = 0.5 * std::numbers::pi - 1e-9;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (middle * c * std::tan(middle) < 1.0 ? low : high) = middle;
  }
  return low * low;
}

// A column buckles under its own weight at qL = 7.8373 EI/L² (Timoshenko and Gere, section 2.12): the zero 1.86635 of
// J_{-1/3}, qL³/EI = 9/4 · 1.86635². The axial force of an element is constant, so the error falls with the square of
// the length of the elements, and what is extrapolated from two meshes is two orders better.
TEST(SolvedBuckling, OwnWeight) {
  const double exact = 2.25 * 1.8663508855 * 1.8663508855, weight = 8000.0 * 2e-4 * 9.81;
  const auto error = [&](int elements) {
    const std::string text =
        column("supports: {base: all}\nload_cases: {weight: {gravity: [-9.81, 0, 0]}}\n", elements);
    return first_case(text, 1).factor[0] * weight / EI_weak / exact - 1.0;
  };
  const double coarse = error(20), fine = error(40);
  EXPECT_LT(std::abs(fine), 5e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.02);
  EXPECT_LT(std::abs(4.0 * fine - coarse) / 3.0, 2e-6);
}

// A mass on a rigid arm of 0.3 above the tip, which gravity pulls down: as a load on that arm.
TEST(SolvedBuckling, WeightOnAnArm) {
  std::string text = column(R"(supports: {base: all}
point_masses: {top: {at: tip, mass: 1, offset: [0.3, 0, 0]}}
load_cases: {weight: {gravity: [-1, 0, 0]}}
)");
  text.replace(text.find("density: 8000"), 13, "density: 1e-6");
  EXPECT_NEAR(first_case(text, 1).factor[0] / (load_of_arm(0.3) * EI_weak), 1.0, 2e-6);
}

// Under tension nothing buckles, and the reversed load is Euler's.
TEST(SolvedBuckling, TensionBucklesReversed) {
  const formats::Part part =
      part_of_text(column("supports: {base: all}\nload_cases: {axial: {forces: {tip: [1, 0, 0]}}}\n"));
  const Solution s = buckled(part, 3);
  EXPECT_EQ(s.buckling[0].factor.size(), 0);
  ASSERT_TRUE(s.buckling[0].reversed);
  EXPECT_NEAR(*s.buckling[0].reversed / (0.25 * pi2 * EI_weak), 1.0, 2e-6);
  EXPECT_THAT(reducer::solution_text(s, part),
              AllOf(HasSubstr("this load does not buckle the part"), HasSubstr("buckles at a load factor of -822.4")));
}

/// Puts a spider of that kind on `nodes`, its own node at `place`, loads it by −1 along x, and holds what is at x = 0.
Solution buckled_by_spider(reducer::Mesh mesh, reducer::SpiderKind kind, const std::vector<int>& nodes,
                           const Vector3d& place) {
  start_solvers();
  const int own = mesh.nodes();
  mesh.position.conservativeResize(3, own + 1);
  mesh.position.col(own) = place;
  mesh.node_label.emplace_back("top");
  reducer::Spider spider;
  spider.kind = kind;
  spider.reference = own;
  spider.nodes = nodes;
  spider.weight.assign(nodes.size(), 1.0);
  spider.name = "top";
  if (kind == reducer::SpiderKind::averaging) spider.node_components = 0b000111;
  mesh.spiders = {spider};
  reducer::MeshSupport base{"base", {}, reducer::all_components, true, "test"};
  for (int n = 0; n < own; ++n)
    if (std::abs(mesh.position(0, n)) < 1e-9) base.nodes.push_back(n);
  mesh.supports = {base};
  reducer::MeshLoadCase load;
  load.name = "axial";
  load.forces.push_back({own, {}, "top"});
  load.forces[0].value << -1.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  mesh.load_cases = {load};
  formats::Part part;
  part.name = "column";
  part.file = "column.part.yaml";
  return reducer::solve_mesh(std::move(mesh), part, {0, {}, 1}, [](const std::string&) {});
}

// The arm carries the load, so its second order decides: without it the load would be that of the column alone, 2.467.
TEST(SolvedBuckling, LoadOnARigidArm) {
  start_solvers();
  const formats::Part part = part_of_text(column("supports: {base: all}\n" + push));
  reducer::Mesh mesh = reducer::build_mesh_to_solve(part);
  const auto tip = static_cast<int>(std::ranges::find(mesh.node_label, "tip") - mesh.node_label.begin());
  const Solution s = buckled_by_spider(mesh, reducer::SpiderKind::rigid, {tip}, Vector3d(1.3, 0.0, 0.0));
  EXPECT_NEAR(s.buckling[0].factor[0] / (load_of_arm(0.3) * EI_weak), 1.0, 2e-6);
}

/// A slender column of solids along x with E I = 1 and ν = 0.
reducer::Mesh solid_column(double b, int cells) {
  reducer::SolidProperty property;
  property.material = reducer::isotropic_solid(12.0 / std::pow(b, 4), 0.0, 1.0);
  return reducer::solid_block({reducer::SolidShape::hexahedron20, {cells, 1, 1}, Vector3d(1.0, b, b), 0.0}, property);
}

std::vector<int> end_nodes(const reducer::Mesh& mesh) {
  std::vector<int> nodes;
  for (int n = 0; n < mesh.nodes(); ++n)
    if (std::abs(mesh.position(0, n) - 1.0) < 1e-9) nodes.push_back(n);
  return nodes;
}

// Clamped and free, two planes at once: between Engesser's and Haringx's loads of a column that shears (A_s = 5/6 A),
// as the full model of the same mesh is in the tests of its element; six elements are within 0.4 %.
TEST(SolvedBuckling, ColumnOfSolids) {
  const double b = 0.1, euler = 0.25 * pi2, GA = 5.0 / 6.0 * 0.5 * 12.0 / (b * b);
  const reducer::Mesh mesh = solid_column(b, 6);
  const Solution s = buckled_by_spider(mesh, reducer::SpiderKind::rigid, end_nodes(mesh), {1.0, 0.5 * b, 0.5 * b});
  ASSERT_EQ(s.buckling[0].factor.size(), 2);
  EXPECT_GT(s.buckling[0].factor[0], euler / (1.0 + euler / GA) * 0.998);
  EXPECT_LT(s.buckling[0].factor[0], 0.5 * GA * (std::sqrt(1.0 + 4.0 * euler / GA) - 1.0) * 1.004);
}

// The same with the load above the end, on a weighted mean of it: as a rigid arm, within what the end deforms.
TEST(SolvedBuckling, LoadOnAnAverage) {
  const double b = 0.05;
  const reducer::Mesh mesh = solid_column(b, 8);
  const Solution s = buckled_by_spider(mesh, reducer::SpiderKind::averaging, end_nodes(mesh), {1.3, 0.5 * b, 0.5 * b});
  EXPECT_NEAR(s.buckling[0].factor[0] / load_of_arm(0.3), 1.0, 0.005);
}

/// A square plate of side 1 and thickness 0.01 between hinged edges that stay straight in their own directions, pressed
/// by 1 per length along x; k of N = k π² D/b².
double plate_factor(int elements, const std::string& cells) {
  const std::string n = std::to_string(elements);
  const CaseBuckling b = first_case(R"(part: plate
materials: {m: {E: 2e11, nu: 0.3, density: 8000}}
points: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0]}
plates: {deck: {corners: [a, b, c, d], elements: [)" +
                                        n + ", " + n + "], cells: " + cells + R"(, thickness: 0.01, material: m}}
supports:
  deck/edge1: [z, ry]
  deck/edge2: [z, rx]
  deck/edge3: [z, ry]
  deck/edge4: [z, rx]
  a: [x, y]
  b: [y]
load_cases: {pressed: {line_loads: {deck/edge2: [-1, 0, 0], deck/edge4: [1, 0, 0]}}}
)",
                                    1);
  return b.factor[0] / (pi2 * 2e11 * 1e-6 / (12.0 * 0.91));
}

// k = 4 (Timoshenko and Gere 1961, section 9.2), less what shear takes: with w = sin sin, D λ²/(1 + D λ/(5/6 G t)) for
// D λ², λ = 2 π²/b². Halving the triangles takes the error to about a quarter; the quadrilaterals are at 1e-4 already.
TEST(SolvedBuckling, SquarePlateConverges) {
  for (const char* cells : {"quadrilaterals", "triangles"}) {
    const double D = 2e11 * 1e-6 / (12.0 * 0.91), exact = 4.0 / (1.0 + 2.0 * pi2 * D / (5.0 / 6.0 * 2e11 / 2.6 * 0.01));
    const double coarse = plate_factor(8, cells) / exact - 1.0, fine = plate_factor(16, cells) / exact - 1.0;
    EXPECT_LT(std::abs(coarse), 2e-3) << cells;
    EXPECT_LT(std::abs(fine), std::max(0.3 * std::abs(coarse), 1e-4)) << cells;
  }
}

// Torsion of a cross between ends that do not turn, P = GJ A/I_p (Timoshenko and Gere, section 5.5, without warping):
// 51.7 kN by thin walls, G (t/b)² A; by the constants of the section here.
TEST(SolvedBuckling, CruciformTwists) {
  const formats::Part part = part_of_text(R"(part: cross
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {c: {shape: cross, height: 0.1, width: 0.1, web: 0.002, flange: 0.002}}
points: {a: [0, 0, 0], b: [1, 0, 0]}
beams: {x: {from: a, to: b, section: c, material: steel, elements: 20}}
supports: {a: all, b: [y, z, rx, ry, rz]}
load_cases: {axial: {forces: {b: [-1, 0, 0]}}}
)");
  const Solution s = buckled(part, 1);
  const formats::Section& c = part.sections.at(0);
  const double exact = 2.1e11 / 2.6 * c.torsion_constant * c.area / c.polar_moment;
  // Linear twist between the nodes: (π/20)²/12 too stiff at most in sin(π x/L), whose load is the same for any length.
  EXPECT_NEAR(s.buckling[0].factor[0] / exact, 1.0, 1e-3);
  EXPECT_NEAR(s.buckling[0].factor[0], 51.7e3, 0.03 * 51.7e3);
  EXPECT_THAT(reducer::solution_text(s, part), HasSubstr("turns ("));
}

// The same of shells: 53.2 kN. Four plates on three hinged sides, clamped at the loaded ones: k = 0.425 of an endless
// plate (Timoshenko and Gere, table 9-3), 51.6 kN, and what the clamped ends add.
TEST(SolvedBuckling, CruciformOfShells) {
  const CaseBuckling b = first_case(R"(part: cross
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
points: {o: [0, 0, 0], y1: [0, 0.05, 0], y2: [0, -0.05, 0], z1: [0, 0, 0.05], z2: [0, 0, -0.05]}
extrusions:
  h: {profile: [y1, o, y2], along: [1, 0, 0], elements: [4, 50], thickness: 0.002, material: steel}
  v: {profile: [z1, o, z2], along: [1, 0, 0], elements: [4, 50], thickness: 0.002, material: steel}
spiders: {a: {kind: rigid, at: [0, 0, 0], on: [h/start, v/start]}, b: {kind: rigid, at: [1, 0, 0], on: [h/end, v/end]}}
supports: {a: all, b: [y, z, rx, ry, rz]}
load_cases: {axial: {forces: {b: [-1, 0, 0]}}}
)",
                                    1);
  EXPECT_NEAR(b.factor[0], 53.2e3, 0.01 * 53.2e3);
}

// A channel between hinges that do not twist, without warping: (P − P_y)(P − P_x) r² = P² y_s², P_x = GJ/r², r² of the
// shear centre (Timoshenko and Gere, section 5.6); 125.3 kN about the weak axis, 203.3 kN by bending and twist.
TEST(SolvedBuckling, ChannelBendsAndTwists) {
  const formats::Part part = part_of_text(R"(part: channel
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {c: {shape: channel, height: 0.1, width: 0.05, web: 0.004, flange: 0.006}}
points: {a: [0, 0, 0], b: [2, 0, 0]}
beams: {x: {from: a, to: b, section: c, material: steel, elements: 20}}
supports: {a: [x, y, z, rx], b: [y, z, rx]}
load_cases: {axial: {forces: {b: [-1, 0, 0]}}}
)");
  const CaseBuckling b = buckled(part, 2).buckling.at(0);
  const formats::Section& c = part.sections.at(0);
  const double E = 2.1e11, s = std::hypot(c.shear_center_y, c.shear_center_z);
  const double weak = pi2 * E * std::min(c.second_moment_y, c.second_moment_z) / 4.0;
  const double strong = pi2 * E * std::max(c.second_moment_y, c.second_moment_z) / 4.0;
  const double r2 = c.polar_moment / c.area + s * s, twist = E / 2.6 * c.torsion_constant / r2;
  const double a = 1.0 - s * s / r2, sum = strong + twist;
  const double both = (sum - std::sqrt(sum * sum - 4.0 * a * strong * twist)) / (2.0 * a);
  EXPECT_NEAR(b.factor[0], 125.3e3, 0.01 * 125.3e3);
  EXPECT_NEAR(b.factor[1], 203.3e3, 0.01 * 203.3e3);
  EXPECT_NEAR(b.factor[0] / weak, 1.0, 5e-3);  // shear takes P/GA_s
  EXPECT_NEAR(b.factor[1] / both, 1.0, 5e-3);
}

/// The roots M of M² = P_z (GJ + β_y M), P_z = π² E I_z/L²: a beam under uniform moment between forks, without warping
/// (Trahair, Flexural-Torsional Buckling of Structures, 1993, section 17.4; Timoshenko and Gere 1961, section 6.2 for
/// β = 0).
std::pair<double, double> moments_of_beam(const formats::Section& s, double E, double G, double L) {
  const double P = pi2 * E * s.second_moment_z / (L * L), half = 0.5 * P * formats::known_monosymmetry(s).beta_y;
  const double root = std::sqrt(half * half + P * G * s.torsion_constant);
  return {half + root, half - root};
}

/// A beam of length 3 between forks, under the moments −1 and 1 about y at its ends.
formats::Part beam_under_moment(const std::string& section, int elements) {
  return part_of_text(R"(part: beam
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {s: )" + section +
                      R"(}
points: {a: [0, 0, 0], b: [3, 0, 0]}
beams: {x: {from: a, to: b, section: s, material: steel, theory: euler_bernoulli, elements: )" +
                      std::to_string(elements) + R"(}}
supports: {a: [x, y, z, rx], b: [y, z, rx]}
load_cases: {bent: {forces: {a: {moment: [0, -1, 0]}, b: {moment: [0, 1, 0]}}}}
)");
}

/// Moments of both signs from meshes of 20 and 40 elements: twist is linear between nodes, and its error, (π/20)²/24 of
/// a symmetric section, falls with the square of their length.
std::pair<double, double> moments_extrapolated(const std::string& section) {
  const CaseBuckling coarse = buckled(beam_under_moment(section, 20), 1).buckling.at(0);
  const CaseBuckling fine = buckled(beam_under_moment(section, 40), 1).buckling.at(0);
  return {(4.0 * fine.factor[0] - coarse.factor[0]) / 3.0, (*coarse.reversed - 4.0 * *fine.reversed) / 3.0};
}

// Bending about y turns over at one moment with the flange compressed and at another with the stem: β tells them apart.
TEST(SolvedBuckling, UnsymmetricBeamsTurnOver) {
  for (const char* section :
       {"{shape: tee, height: 0.15, width: 0.1, web: 0.008, flange: 0.01}",
        "{shape: I, height: 0.2, width: 0.1, web: 0.006, flange: 0.009, bottom_width: 0.06, bottom_flange: 0.009}",
        "{shape: polygon, outline: [[0, 0], [0.02, 0], [0.012, 0.1], [0.008, 0.1]]}",
        "{shape: walls, walls: [{along: [[-0.05, 0.1], [0, 0.1], [0.05, 0.1]], thickness: 0.006}, "
        "{along: [[0, 0.1], [0, 0]], thickness: 0.006}]}",
        "{shape: I, height: 0.2, width: 0.1, web: 0.006, flange: 0.009}"}) {
    const formats::Part part = beam_under_moment(section, 1);
    const auto [along, against] = moments_of_beam(part.sections.at(0), 2.1e11, 2.1e11 / 2.6, 3.0);
    const auto [positive, negative] = moments_extrapolated(section);
    EXPECT_NEAR(positive / along, 1.0, 1e-5) << section;
    EXPECT_NEAR(negative / against, 1.0, 1e-5) << section;
  }
}

// By constants β is not known, and the report says so where the shear centre shows that there is one.
TEST(SolvedBuckling, SaysThatBetaIsUnknown) {
  const std::string constants = "{A: 2e-3, Iy: 4e-6, Iz: 1e-6, J: 5e-8, shear_center: [0, 0.03]}";
  EXPECT_THAT(buckled(beam_under_moment(constants, 4), 1).warnings,
              ::testing::Contains(AllOf(HasSubstr("section 's'"), HasSubstr("outline"))));
  EXPECT_THAT(
      buckled(beam_under_moment("{shape: tee, height: 0.15, width: 0.1, web: 0.008, flange: 0.01}", 4), 1).warnings,
      ::testing::IsEmpty());
}

TEST(SolvedBuckling, IsRefusedWithoutLoadSupportOrStress) {
  EXPECT_THAT(buckling_error(column("supports: {base: all}\n")), HasSubstr("the part has no load cases"));
  EXPECT_THAT(buckling_error(column(push)), HasSubstr("buckling needs supports, but the part has none"));
  EXPECT_THAT(buckling_error(column("supports: {base: all}\nload_cases: {none: {forces: {tip: [0, 0, 0]}}}\n")),
              AllOf(HasSubstr("load case 'none' causes no stress"), HasSubstr("part.yaml")));
  EXPECT_THAT(buckling_error(column("supports: {base: [x, y, z]}\n" + push)), HasSubstr("do not hold the part"));
}

// Up to 1000 times the lowest: (2 k − 1)² of it in one plane, 4 (2 k − 1)² in the other, 16 and 8 by Euler; what a mesh
// of 20 elements raises beyond the limit may be missing.
TEST(SolvedBuckling, SaysWhenFewerFactorsExist) {
  const formats::Part part = part_of_text(column("supports: {base: all}\n" + push));
  const Solution s = buckled(part, 500);
  EXPECT_LE(s.buckling[0].factor.size(), 24);
  EXPECT_GE(s.buckling[0].factor.size(), 22);
  EXPECT_THAT(reducer::solution_text(s, part), HasSubstr("of the 500 requested load factors exist"));
}

TEST(SolvedBuckling, FilesHoldFactorsShapesAndAPage) {
  const formats::Part part = part_of_text(column("supports: {base: all}\n" + push));
  const reducer::SolveRequest request{0, {}, 2};
  const Solution s = buckled(part, 2);
  const test_support::TemporaryFolder folder;
  const std::string stem = folder.file("column.solution");
  reducer::write_solution(s, part, request, stem);
  for (const std::string& file : reducer::solution_files(stem, part, request))
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_THAT(test_support::text_of(stem + "-buckling.csv"), HasSubstr("case,mode,load_factor\naxial,1,822.4"));
  // Clamped, free: v = 1 − cos(π x/2L), v'(L) = π/2.
  EXPECT_THAT(test_support::text_of(stem + ".csv"), HasSubstr("axial-buckling_1,\"tip\","));
  EXPECT_THAT(test_support::text_of(stem + "-buckling.html"), HasSubstr("axial 1: load factor 822.4"));
  EXPECT_NEAR(s.buckling[0].q.cwiseAbs().maxCoeff(), 0.5 * std::numbers::pi, 1e-4);
  EXPECT_THAT(reducer::solution_text(s, part),
              AllOf(HasSubstr("buckling, load case 'axial'"), HasSubstr("moves (0, 0, 1) at tip"),
                    HasSubstr("no load factor below the last one is missing"), Not(HasSubstr("reversed load"))));
}

}  // namespace
}  // namespace tisserand::testing::buckling_test
