// SPDX-License-Identifier: GPL-3.0-or-later
// Modes on supports, what is refused and how, files and report of `reducer solve`.
#include "reducer/solve/solve.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/solve/files.hpp"
#include "reducer/solve/report.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/solve/solving.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"
#include "tests/support/vtk/vtu_reader.hpp"

namespace tisserand::testing::solve_test {
namespace {

using reducer::Solution;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A slender beam of square section 0.01, L = 1, E 2e11, density 8000.
std::string beam(const std::string& more, int elements = 20) {
  return R"(part: beam
materials: {m: {E: 2e11, nu: 0.3, density: 8000}}
sections: {bar: {shape: rectangle, width: 0.01, height: 0.01}}
points: {base: [0, 0, 0], tip: [1, 0, 0]}
beams: {rod: {from: base, to: tip, section: bar, material: m, theory: euler_bernoulli, rotary_inertia: off, elements: )" +
         std::to_string(elements) + "}}\n" + more;
}

/// (βL)²/2π √(EI/ρA L⁴) of the beam above.
double bending(double beta) { return beta * beta / (2.0 * M_PI) * std::sqrt(2e11 * 1e-4 / 12.0 / 8000.0); }

// βL of the clamped beam 1.87510407, 4.69409113, 7.85475744 (Blevins 1979, table 8-1), each twice; the first mode of
// each plane takes 61.31 % of the mass (its shape's (∫φ)²/∫φ² = 0.7830²).
TEST(SolvedModes, ClampedBeam) {
  const Solution s = solved(part_of_text(beam("supports: {base: all}\n")), 6);
  ASSERT_TRUE(s.modes);
  ASSERT_EQ(s.modes->lambda.size(), 6);
  const double beta[] = {1.87510407, 4.69409113, 7.85475744};
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(reducer::frequency(s.modes->lambda[k]), bending(beta[k / 2]), 2e-5 * bending(beta[k / 2])) << k;
  const double mass = 8000.0 * 1e-4;
  EXPECT_NEAR(s.modes->effective.block(1, 0, 2, 2).sum() / mass, 2.0 * 0.6131, 2e-3);
  EXPECT_LT(s.modes->effective.row(2).sum(), mass);
  EXPECT_GT(s.modes->effective.row(2).sum(), 0.86 * mass);
}

// Free: βL = 4.73004074 and 7.85320462 (Blevins), behind six rigid motions.
TEST(SolvedModes, FreeBeam) {
  const Solution s = solved(part_of_text(beam("boundary: [base]\n")), 4);
  EXPECT_TRUE(s.is_free);
  EXPECT_EQ(s.modes->rigid, 6);
  EXPECT_NEAR(reducer::frequency(s.modes->lambda[0]), bending(4.73004074), 1e-5 * bending(4.73));
  EXPECT_NEAR(reducer::frequency(s.modes->lambda[2]), bending(7.85320462), 1e-4 * bending(7.85));
  const std::string text = reducer::solution_text(s, part_of_text(beam("boundary: [base]\n")));
  EXPECT_THAT(text, AllOf(HasSubstr("6 rigid motions"), HasSubstr("none: the part is free")));
}

TEST(Solve, ReportReportsSupportsLargestValuesReactionsAndBalance) {
  const formats::Part part = part_of_text(beam(
      "supports: {base: all}\nload_cases: {tip: {forces: {tip: [0, 0, -1]}}, weight: {gravity: [0, 0, -9.81]}}\n"));
  const std::string text = reducer::solution_text(solved(part, 2), part);
  EXPECT_THAT(
      text, AllOf(HasSubstr("base: 1 node, x y z rx ry rz"), HasSubstr("held               6 coordinates"),
                  HasSubstr("load case 'weight'"), HasSubstr("at tip (1, 0, 0)"),
                  HasSubstr("base: force (0, 0, 1) N, moment (0, -1, 0) N m about (0, 0, 0)"), HasSubstr("of the load"),
                  HasSubstr("strain energy      0.001 J"), HasSubstr("effective mass")));
  // w = PL³/3EI = 1/(3 · 2e11 · 1e-8/12), stress PL/W = 6/1e-6
  EXPECT_THAT(text,
              AllOf(HasSubstr("largest 0.002 m, (0, 0, -0.002)"), HasSubstr("largest 6e+06 Pa at beam 1 of 'rod'")));
}

TEST(Solve, FilesHoldPointsAndFields) {
  const formats::Part part =
      part_of_text(beam("supports: {base: all}\nload_cases: {tip: {forces: {tip: [0, 0, -1]}}}\n", 4));
  const reducer::SolveRequest request{1, {"0.5,0,0"}};
  const Solution s = solved(part, 1);
  const test_support::TemporaryFolder folder;
  const std::string stem = folder.file("beam.solution");
  reducer::write_solution(s, part, request, stem);
  for (const std::string& file : reducer::solution_files(stem, part, request))
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
  const std::string table = test_support::text_of(stem + ".csv");
  EXPECT_THAT(table, AllOf(HasSubstr("case,point,ux [m],uy [m],uz [m],rx,ry,rz\n"), HasSubstr("tip,\"0.5,0,0\",0"),
                           HasSubstr("mode_1,\"tip\",")));
  std::istringstream lines(table.substr(table.find("tip,\"tip\",") + 10));
  std::vector<double> values;
  for (std::string word; values.size() < 6 && std::getline(lines, word, values.size() == 5 ? '\n' : ',');)
    values.push_back(std::stod(word));
  EXPECT_NEAR(values[2], -0.002, 1e-11);
  EXPECT_NEAR(values[4], 0.003, 1e-11);  // PL²/2EI
  const test_support::VtuFile grid = test_support::read_vtu(stem + ".tip.vtu");
  EXPECT_EQ(grid.points, 5);
  EXPECT_NEAR(grid.arrays.at("rotation")[3 * static_cast<std::size_t>(node_of(s, "tip")) + 1], 0.003, 1e-8);
  EXPECT_NEAR(grid.arrays.at("von_mises")[0], 6e6, 10.0);
  const auto shapes = test_support::read_vtu(stem + "-modes.vtu").arrays;
  EXPECT_TRUE(std::ranges::any_of(shapes, [](const auto& array) { return array.first.starts_with("mode_001 "); }));
  EXPECT_THROW(reducer::solution_table(s, part, {0, {"elbow"}}), Error);
}

// Two bricks of 20 nodes of a deck, its node sets held and loaded, against CalculiX 2.20 (ccx) on the same deck:
// *BOUNDARY FIX, 1, 3; *DLOAD P2 on the elements' tops; GRAV; *FREQUENCY. It prints seven digits.
TEST(Solve, IsCalculixsSolutionOfADeck) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("block.inp")) << R"(*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0.5, 0, 0
10, 1, 0.5, 0
11, 0.5, 1, 0
12, 0, 0.5, 0
13, 0.5, 0, 1
14, 1, 0.5, 1
15, 0.5, 1, 1
16, 0, 0.5, 1
17, 0, 0, 0.5
18, 1, 0, 0.5
19, 1, 1, 0.5
20, 0, 1, 0.5
21, 2, 0, 0
22, 2, 1, 0
23, 2, 0, 1
24, 2, 1, 1
25, 1.5, 0, 0
26, 2, 0.5, 0
27, 1.5, 1, 0
28, 1.5, 0, 1
29, 2, 0.5, 1
30, 1.5, 1, 1
31, 2, 0, 0.5
32, 2, 1, 0.5
*ELEMENT, TYPE=C3D20, ELSET=EALL
1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,
16, 17, 18, 19, 20
2, 2, 21, 22, 3, 6, 23, 24, 7, 25, 26, 27, 10, 28, 29, 30,
14, 18, 31, 32, 19
*NSET, NSET=FIX
1, 4, 5, 8, 12, 16, 17, 20
*NSET, NSET=TOP
5, 6, 7, 8, 13, 14, 15, 16, 23, 24, 28, 29, 30
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, 0.3
*DENSITY
7800
*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL
)";
  std::ofstream(folder.file("block.part.yaml")) << R"(part: block
mesh: {file: block.inp}
supports: {FIX: translations}
load_cases: {press: {pressures: {TOP: 1e5}}, weight: {gravity: [0, 0, -9.81]}}
)";
  const Solution s = solved(formats::read_part(folder.file("block.part.yaml"), {}), 3);
  const Eigen::Vector3d press(-3.487622e-06, -6.940545e-09, -1.266833e-05);
  const Eigen::Vector3d weight(-2.670790e-06, -1.276497e-09, -9.592928e-06);
  EXPECT_LT((motion_of(s, "node 21", 0).head<3>() - press).norm(), 1e-11);
  EXPECT_LT((motion_of(s, "node 21", 1).head<3>() - weight).norm(), 1e-11);
  EXPECT_NEAR(s.statics.energy[0], 0.5823515, 1e-7);
  EXPECT_NEAR(s.statics.energy[1], 0.3261465, 1e-7);
  EXPECT_NEAR(reducer::frequency(s.modes->lambda[0]), 191.3769, 1e-4);
  EXPECT_NEAR(reducer::frequency(s.modes->lambda[2]), 402.3434, 1e-4);
}

/// A shell of 2 x 1 and a beam along its first edge as sets of a deck.
std::string deck_error(const test_support::TemporaryFolder& folder, const std::string& load, Solution& solution) {
  std::ofstream(folder.file("sets.inp")) << R"(*NODE
1, 0, 0, 0
2, 2, 0, 0
3, 2, 1, 0
4, 0, 1, 0
*ELEMENT, TYPE=S4, ELSET=SKIN
1, 1, 2, 3, 4
*ELEMENT, TYPE=B31, ELSET=RIB
2, 1, 2
*NSET, NSET=LEFT
1, 4
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, 0.3
*DENSITY
7800
*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL
0.01
*BEAM SECTION, ELSET=RIB, MATERIAL=STEEL, SECTION=RECT
0.01, 0.02
0, 0, 1
)";
  std::ofstream(folder.file("sets.part.yaml"))
      << "part: sets\nmesh: {file: sets.inp}\nsupports: {LEFT: all}\nload_cases: {w: {" << load << "}}\n";
  return test_support::error_of([&] { solution = solved(formats::read_part(folder.file("sets.part.yaml"), {}), 0); });
}

TEST(Solve, SetsOfDecksCarryLoads) {
  const test_support::TemporaryFolder folder;
  Solution s;
  EXPECT_EQ(deck_error(folder, "pressures: {SKIN: 5}, line_loads: {RIB: [0, 3, 0]}", s), "no error");
  EXPECT_LT((s.loads.applied.col(0).head<3>() - Eigen::Vector3d(0, 3.0 * 2.0, -5.0 * 2.0)).norm(), 1e-12);
  EXPECT_LT(reducer::imbalance(s, 0), 1e-9);
  EXPECT_THAT(deck_error(folder, "pressures: {RIB: 5}", s), HasSubstr("'RIB' is a set of lines, but faces are needed"));
  EXPECT_THAT(deck_error(folder, "line_loads: {SKIN: [0, 0, 1]}", s), HasSubstr("'SKIN' holds no edges and no beams"));
  EXPECT_THAT(deck_error(folder, "pressures: {LEFT: 5}", s), HasSubstr("no face of an element lies between the nodes"));
  EXPECT_THAT(deck_error(folder, "forces: {LEFT: [0, 0, 1]}", s), HasSubstr("'LEFT'"));
}

// Two shells, the second turned over: their pressures cancel, and the part says so. On one side they add.
TEST(Solve, PressureOnMixedNormalsIsReported) {
  const test_support::TemporaryFolder folder;
  const auto solution = [&](const std::string& second) {
    std::ofstream(folder.file("two.inp")) << "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n4, 0, 1, 0\n5, 1, 1, 0\n"
                                             "6, 2, 1, 0\n*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 5, 4\n2, "
                                          << second
                                          << "\n*NSET, NSET=LEFT\n1, 4\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n"
                                             "*DENSITY\n7800\n*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL\n0.01\n";
    std::ofstream(folder.file("two.part.yaml"))
        << "part: two\nmesh: {file: two.inp}\nsupports: {LEFT: all}\nload_cases: {w: {pressures: {SKIN: 5}}}\n";
    return solved(formats::read_part(folder.file("two.part.yaml"), {}), 0);
  };
  const Solution same = solution("2, 3, 6, 5"), turned = solution("5, 6, 3, 2");
  EXPECT_NEAR(same.loads.applied(2, 0), -10.0, 1e-12);
  EXPECT_THAT(same.warnings, ::testing::Not(::testing::Contains(HasSubstr("with opposite normals"))));
  EXPECT_NEAR(turned.loads.applied(2, 0), 0.0, 1e-12);
  EXPECT_THAT(turned.warnings,
              ::testing::Contains(HasSubstr("load case 'w': pressure: pairs of neighbouring shells with opposite "
                                            "normals: 1, first at node 2 and node 5")));
}

// Two shells side by side, each with nodes of its own: told with count and place, or joined.
TEST(Solve, CoincidentNodesAreReportedOrMerged) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("crack.inp")) << R"(*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
7, 1, 0, 0
8, 1, 1, 1e-9
*ELEMENT, TYPE=S4, ELSET=SKIN
1, 1, 2, 5, 4
2, 7, 3, 6, 8
*NSET, NSET=LEFT
1, 4
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, 0.3
*DENSITY
7800
*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL
0.01
)";
  const auto part = [&](const std::string& more) {
    std::ofstream(folder.file("crack.part.yaml"))
        << "part: crack\nmesh: {file: crack.inp" << more << "}\nsupports: {LEFT: all}\n"
        << "load_cases: {w: {pressures: {SKIN: 5}}}\n";
    return formats::read_part(folder.file("crack.part.yaml"), {});
  };
  const reducer::Mesh cracked = reducer::build_mesh_to_solve(part(""));
  EXPECT_EQ(cracked.nodes(), 8);
  EXPECT_THAT(cracked.warnings,
              ::testing::ElementsAre(
                  HasSubstr("nodes at the same place as other nodes, but not connected to them: 2, first node 2 and "
                            "node 7 at (1, 0, 0)")));
  const Solution joined = solved(part(", coincident: merge"), 0);
  EXPECT_EQ(joined.mesh.nodes(), 6);
  EXPECT_THAT(joined.warnings, ::testing::Contains(HasSubstr("nodes merged with other nodes at the same place: 2")));
  EXPECT_NEAR(joined.loads.applied(2, 0), -10.0, 1e-12);
  EXPECT_LT(reducer::imbalance(joined, 0), 1e-9);
}

/// A plate with a spider on its edge; groups of faces and edges.
std::string plate(const std::string& more) {
  return R"(part: plate
materials: {m: {E: 2e11, nu: 0.3, density: 8000}}
sections: {bar: {shape: rectangle, width: 0.01, height: 0.01}}
points: {a: [0, 0, 0], b: [1, 0, 0], far: [5, 5, 5]}
plates: {deck: {corners: [a, b, [1, 1, 0], [0, 1, 0]], elements: [2, 2], thickness: 0.01, material: m}}
spiders: {hub: {kind: rigid, on: deck/edge2}}
)" + more;
}

const std::string weight = "load_cases: {w: {gravity: [0, 0, -9.81]}}\n";

TEST(SolveErrors, Supports) {
  EXPECT_THAT(solve_error(plate(weight), 0),
              AllOf(HasSubstr("no supports"), HasSubstr("load case 'w' is not in equilibrium"),
                    HasSubstr("a force of 784.8"), HasSubstr("add supports")));
  EXPECT_THAT(solve_error(plate("supports: {a: translations}\n" + weight), 0),
              AllOf(HasSubstr("the supports a do not hold the part"), HasSubstr("turning about the axis")));
  EXPECT_THAT(solve_error(plate("supports: {b: all, deck/edge4: all}\n" + weight), 0),
              AllOf(HasSubstr("support 'b' holds b, which follows the rigid spider 'hub'"), HasSubstr("own node")));
  EXPECT_THAT(solve_error(plate("supports: {deck/edge4: []}\n" + weight), 0),
              HasSubstr("support 'deck/edge4' holds nothing"));
  EXPECT_THAT(solve_error(plate("supports: {deck/edge4: [x, q]}\n" + weight), 0), HasSubstr("unknown direction 'q'"));
  EXPECT_THAT(solve_error(plate("supports: {deck/egde4: all}\n" + weight), 0),
              AllOf(HasSubstr("no group 'deck/egde4'"), HasSubstr("deck/edge4")));
  EXPECT_THAT(solve_error(plate("supports: {left: {on: deck/edge4}}\n" + weight), 0),
              HasSubstr("neither 'directions' nor 'symmetry'"));
  EXPECT_THAT(solve_error(plate("supports: {deck/edge4: {symmetry: y}}\n" + weight), 0),
              AllOf(HasSubstr("are not in one plane with the normal y")));
  EXPECT_THAT(solve_error(plate("supports: {far: all}\n" + weight), 0), HasSubstr("no beam ends at point 'far'"));
  EXPECT_THAT(solve_error(plate("supports: {c: {at: {centroid: deck}, directions: all}}\n" + weight), 0),
              HasSubstr("a centroid is not a node"));
  EXPECT_THAT(solve_error(plate("supports: {c: {at: [0.3, 0.2, 0], directions: all}}\n" + weight), 0),
              HasSubstr("no element of the part has a node there"));
}

TEST(SolveErrors, Loads) {
  const std::string held = "supports: {deck/edge4: all}\n";
  EXPECT_THAT(solve_error(plate(held), 0), AllOf(HasSubstr("nothing to compute"), HasSubstr("--modes")));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {}}\n"), 0), HasSubstr("load case 'w' has no loads"));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {pressures: {dekc: 1}}}\n"), 0),
              AllOf(HasSubstr("there is no group 'dekc'"), HasSubstr("deck")));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {pressures: {deck/edge1: 1}}}\n"), 0),
              HasSubstr("'deck/edge1' holds edges, but faces are needed"));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {line_loads: {deck: [0, 0, 1]}}}\n"), 0),
              HasSubstr("'deck' holds faces, but edges are needed"));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {forces: {hbu: [0, 0, 1]}}}\n"), 0),
              AllOf(HasSubstr("force 'hbu'"), HasSubstr("hub")));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {forces: {hub: {at: hub}}}}\n"), 0),
              HasSubstr("neither 'force' nor 'moment'"));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {forces: {hub: [0, 0]}}}\n"), 0), HasSubstr("force"));
  EXPECT_THAT(solve_error(plate(held + "load_cases: {w: {gravitiy: [0, 0, 1]}}\n"), 0), HasSubstr("gravity"));
  EXPECT_THAT(solve_error(plate(held + weight), 4000), HasSubstr("modes asked for, but only"));
}

// A truss has no rotations: its moments act on nothing.
TEST(SolveErrors, LoadsOnWhatHasNoStiffness) {
  const std::string truss = R"(part: truss
materials: {m: {E: 2e11, nu: 0.3, density: 8000}}
sections: {bar: {shape: rod, A: 1e-4}}
points: {a: [0, 0, 0], b: [1, 0, 0], c: [0, 1, 0], top: [0.3, 0.3, 1]}
beams:
  one: {from: a, to: top, section: bar, material: m, elements: 1}
  two: {from: b, to: top, section: bar, material: m, elements: 1}
  three: {from: c, to: top, section: bar, material: m, elements: 1}
supports: {a: translations, b: translations, c: translations}
load_cases: {w: {forces: {top: LOAD}}}
)";
  const auto with = [&](const std::string& load) {
    std::string text = truss;
    return text.replace(text.find("LOAD"), 4, load);
  };
  EXPECT_THAT(solve_error(with("{moment: [0, 0, 1]}"), 0),
              AllOf(HasSubstr("top (rotation"), HasSubstr("neither stiffness nor mass")));
  const Solution s = solved(with("[1, 2, 3]"));
  EXPECT_LT(reducer::imbalance(s, 0), 1e-12);
}

// A hinge in the middle of a beam that is clamped at one end.
TEST(SolveErrors, MechanismsAreNamed) {
  EXPECT_THAT(solve_error(R"(part: hinged
materials: {m: {E: 2e11, nu: 0.3, density: 8000}}
sections: {bar: {shape: rectangle, width: 0.01, height: 0.01}}
points: {a: [0, 0, 0], b: [1, 0, 0], c: [2, 0, 0]}
beams:
  one: {from: a, to: b, section: bar, material: m, elements: 2, releases: {end: [ry]}}
  two: {from: b, to: c, section: bar, material: m, elements: 2}
supports: {a: all}
load_cases: {w: {forces: {c: [0, 0, 1]}}}
)",
                          0),
              AllOf(HasSubstr("1 motion(s) without stiffness on its supports"),
                    HasSubstr("b, c and two[1] turn about the axis (0, 1, 0) through (1, 0, 0)"),
                    HasSubstr("support these nodes")));
}

// `reducer run` reads the same file, reduces it without them, and needs a boundary.
TEST(Solve, PartsToBeSolvedNeedNoBoundary) {
  const formats::Part part = part_of_text(plate("supports: {deck/edge4: all}\n" + weight));
  EXPECT_TRUE(part.boundary.empty());
  EXPECT_THAT(reducer::solution_text(solved(part, 0), part), HasSubstr("deck/edge4: 3 nodes"));
}

}  // namespace
}  // namespace tisserand::testing::solve_test
