// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of `reducer recover --loads` in CalculiX, on the mesh of the part. CalculiX must find the stress and the
// displacement of `reducer recover`. The part is at rest under its weight, or spins, accelerates and vibrates.
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "formats/recovery/recovery.hpp"
#include "tests/cli/bar_mesh.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/support/vtk/vtu_reader.hpp"

namespace tisserand::cli::loads_test {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Rows of numbers in a .dat file of CalculiX, from the blocks of a table "displacements" or "stresses".
using Rows = std::vector<std::vector<double>>;
Rows rows_of(const std::string& text, const std::string& title) {
  Rows rows;
  std::stringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("for set") != std::string::npos) {
      inside = line.find(title) != std::string::npos;
      continue;
    }
    std::stringstream words(line);
    std::vector<double> row;
    for (double value = 0.0; words >> value;) row.push_back(value);
    if (inside && row.size() > 3) rows.push_back(row);
  }
  return rows;
}

/// Stress of the nodes, [xx yy zz xy yz xz] as in VTU files, from the quadrature points of straight ten-node
/// tetrahedra. It is linear in each: corners are extrapolated, edges are means of corners. A node has the mean of its
/// elements.
MatrixXd nodal_stress(const Rows& rows, const BarMesh& mesh, const std::map<int, int>& row_of) {
  constexpr double a = 0.13819660112501051, b = 0.58541019662496852;  // barycentric coordinates of the points
  Eigen::Matrix4d values = Eigen::Matrix4d::Constant(a);
  values.diagonal().setConstant(b);
  const Eigen::Matrix4d to_corners = values.inverse();
  MatrixXd sum = MatrixXd::Zero(6, static_cast<Eigen::Index>(row_of.size()));
  Eigen::VectorXd count = Eigen::VectorXd::Zero(sum.cols());
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e) {
    MatrixXd points(4, 6);
    for (std::size_t p = 0; p < 4; ++p) {  // sxx, syy, szz, sxy, sxz, syz
      const std::vector<double>& row = rows.at(4 * e + p);
      EXPECT_EQ(row.at(0), static_cast<double>(e + 1));
      points.row(static_cast<Eigen::Index>(p)) << row.at(2), row.at(3), row.at(4), row.at(5), row.at(7), row.at(6);
    }
    const MatrixXd corners = to_corners * points;
    MatrixXd nodes(10, 6);
    nodes.topRows(4) = corners;
    constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    for (int k = 0; k < 6; ++k)
      nodes.row(4 + k) = 0.5 * (corners.row(edges[static_cast<std::size_t>(k)][0]) +
                                corners.row(edges[static_cast<std::size_t>(k)][1]));
    for (int k = 0; k < 10; ++k) {
      const int row = row_of.at(mesh.tetrahedra[e][static_cast<std::size_t>(k)]);
      sum.col(row) += nodes.row(k).transpose();
      count[row] += 1.0;
    }
  }
  return sum * count.cwiseInverse().asDiagonal();
}

/// Displacement u without the rigid motion that fits it best.
Matrix3Xd without_rigid_motion(const Matrix3Xd& X, const Matrix3Xd& u) {
  MatrixXd rigid(3 * X.cols(), 6);
  for (Eigen::Index n = 0; n < X.cols(); ++n)
    for (int c = 0; c < 3; ++c) {
      rigid.block<3, 1>(3 * n, c) = Vector3d::Unit(c);
      rigid.block<3, 1>(3 * n, 3 + c) = Vector3d::Unit(c).cross(Vector3d(X.col(n)));
    }
  const Eigen::Map<const Eigen::VectorXd> all(u.data(), u.size());
  const Eigen::VectorXd left = all - rigid * rigid.colPivHouseholderQr().solve(Eigen::VectorXd(all));
  return Eigen::Map<const Matrix3Xd>(left.data(), 3, X.cols());
}

class Loads : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
    where.folder = folder.path().string();
  }

  /// Writes deck and part and reduces it.
  void reduce(const std::vector<std::string>& settings, bool is_mm) {
    in_mm = is_mm;
    write_text(folder.file("mesh.inp"), mesh.deck(in_mm));
    std::string part = fmt::format("part: bar\nunits: {}\nmesh: {{file: mesh.inp}}\nboundary:\n",
                                   in_mm ? "{length: mm, mass: t, time: s}" : "{length: m, mass: kg, time: s}");
    const std::array<std::pair<const char*, int>, 4> held{
        {{"a", mesh.at(0, 0, 0)}, {"b", mesh.at(0, 2, 0)}, {"c", mesh.at(0, 0, 2)}, {"tip", mesh.at(12, 2, 2)}}};
    for (const auto& [name, node] : held) part += fmt::format("  {}: {{node: {}, keep: translations}}\n", name, node);
    write_text(folder.file("bar.part.yaml"), part + "modes: 6\nrecovery: yes\n");
    std::vector<std::string> words{program("reducer"), "run", "bar.part.yaml"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  void run(const std::string& scene) const {
    write_text(folder.file("bar.scene.yaml"), scene);
    const Outcome outcome = call({program("mechanism"), "run", "bar.scene.yaml", "-o", "run.results.h5"}, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  /// Runs `reducer recover` for stress and loads at the chosen instants.
  Outcome recover(const std::vector<std::string>& words) const {
    std::vector<std::string> all{
        program("reducer"), "recover",         "bar.recovery.h5", "run.results.h5", "--frame", "part", "-o", "out",
        "--loads",          "nastran,calculix"};
    all.insert(all.end(), words.begin(), words.end());
    return call(all, where);
  }
  /// Forces by node number and component 1-6 in the step of number `step`, from 0, of the CalculiX deck.
  std::map<std::pair<int, int>, double> of_calculix(const std::string& body, int step) const;
  /// Forces by node number and component 1-6 in the cards of the LOAD `load` of the NASTRAN deck.
  std::map<std::pair<int, int>, double> of_nastran(const std::string& body, int load) const;

  /// Expects that CalculiX under the loads has the stresses of the series and, for linear bodies, its displacements.
  void compare(const std::string& body, std::size_t instants, bool is_linear) const;

  test_support::TemporaryFolder folder;
  Surroundings where;
  BarMesh mesh;
  bool in_mm = false;
};

std::map<std::pair<int, int>, double> Loads::of_calculix(const std::string& body, int step) const {
  std::map<std::pair<int, int>, double> forces;
  std::stringstream lines(read_text(folder.file("out/" + body + "_loads.inp")));
  int steps = -1;
  for (std::string line; std::getline(lines, line);) {
    if (line == "*STEP") ++steps;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::stringstream words(line);
    int node = 0, component = 0;
    double value = 0.0;
    if (steps == step && words >> node >> component >> value) forces[{node, component}] += value;
  }
  return forces;
}

std::map<std::pair<int, int>, double> Loads::of_nastran(const std::string& body, int load) const {
  std::map<int, std::map<std::pair<int, int>, double>> sets;
  std::map<std::pair<int, int>, double> sum;
  std::stringstream lines(read_text(folder.file("out/" + body + "_loads.bdf")));
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.substr(0, line.find_first_of("* "));
    if (name == "FORCE" || name == "MOMENT") {
      const int set = std::stoi(line.substr(8, 16)), node = std::stoi(line.substr(24, 16));
      EXPECT_EQ(std::stod(line.substr(56, 16)), 1.0) << line;
      std::getline(lines, line);
      for (int c = 0; c < 3; ++c)
        sets[set][{node, c + (name == "FORCE" ? 1 : 4)}] +=
            std::stod(line.substr(static_cast<std::size_t>(8 + 16 * c), 16));
    }
    if (name != "LOAD" || std::stoi(line.substr(8, 8)) != load) continue;
    for (std::size_t at = 24; at + 16 <= line.size(); at += 16)
      for (const auto& [place, value] : sets.at(std::stoi(line.substr(at + 8, 8))))
        sum[place] += std::stod(line.substr(at, 8)) * value;
  }
  return sum;
}

void Loads::compare(const std::string& body, std::size_t instants, bool is_linear) const {
  if (std::system("command -v ccx >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "skipped, not tested: there is no ccx here (apt-get install calculix-ccx)";
  const std::string supports = fmt::format("*BOUNDARY\n{}, 1, 3\n{}, 1, 1\n{}, 3, 3\n{}, 1, 1\n", mesh.at(6, 0, 0),
                                           mesh.at(6, 2, 0), mesh.at(6, 2, 0), mesh.at(6, 0, 2));
  std::string loads = read_text(folder.file("out/" + body + "_loads.inp"));
  for (std::size_t at = 0; (at = loads.find("*END STEP", at)) != std::string::npos; at += 80)
    loads.insert(at, "*NODE PRINT, NSET=every\nU\n*EL PRINT, ELSET=body\nS\n");
  std::string every = "*NSET, NSET=every\n";
  for (const auto& [id, x] : mesh.position) every += fmt::format("{},\n", id);
  write_text(folder.file("check.inp"), mesh.deck(in_mm) + every + supports + loads);
  const std::string command = "cd '" + folder.path().string() + "' && OMP_NUM_THREADS=1 ccx check > ccx.log 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder.file("ccx.log"));
  const std::string text = read_text(folder.file("check.dat"));
  const Rows u = rows_of(text, "displacements"), s = rows_of(text, "stresses");
  const std::size_t nodes = mesh.position.size(), points = 4 * mesh.tetrahedra.size();
  ASSERT_EQ(u.size(), instants * nodes);
  ASSERT_EQ(s.size(), instants * points);

  const formats::RecoveryReader reader(folder.file("bar.recovery.h5"));
  std::map<int, int> row_of;
  for (int n = 0; n < reader.recovery().nodes(); ++n)
    row_of[reader.recovery().node_number.at(static_cast<std::size_t>(n))] = n;
  ASSERT_EQ(row_of.size(), nodes);
  const Matrix3Xd& X = reader.recovery().position;
  for (std::size_t k = 0; k < instants; ++k) {
    const test_support::VtuFile grid = test_support::read_vtu(folder.file(fmt::format("out/{}_{:05}.vtu", body, k)));
    const auto count = static_cast<Eigen::Index>(nodes);
    const MatrixXd stress = Eigen::Map<const MatrixXd>(grid.arrays.at("solid_stress").data(), 6, count);
    const Matrix3Xd moved = Eigen::Map<const Matrix3Xd>(grid.arrays.at("displacement").data(), 3, count);
    const Rows own(s.begin() + static_cast<std::ptrdiff_t>(k * points),
                   s.begin() + static_cast<std::ptrdiff_t>((k + 1) * points));
    const MatrixXd theirs = (in_mm ? 1e6 : 1.0) * nodal_stress(own, mesh, row_of);  // scenes are in m, kg, s
    Matrix3Xd displaced(3, count);
    for (std::size_t n = 0; n < nodes; ++n) {
      const std::vector<double>& row = u[k * nodes + n];
      displaced.col(row_of.at(static_cast<int>(row.at(0)))) << row.at(1), row.at(2), row.at(3);
    }
    displaced *= in_mm ? 1e-3 : 1.0;
    const double largest = stress.cwiseAbs().maxCoeff(), error = (theirs - stress).cwiseAbs().maxCoeff() / largest;
    const Matrix3Xd ours = without_rigid_motion(X, moved), other = without_rigid_motion(X, displaced);
    const double difference = (ours - other).cwiseAbs().maxCoeff() / ours.cwiseAbs().maxCoeff();
    EXPECT_GT(largest, 1e3);
    EXPECT_LT(error, 1e-6) << "stress at instant " << k;  // CalculiX prints seven digits
    // With a companion file displacements hold the foreshortening, which statics does not know.
    EXPECT_LT(difference, is_linear ? 1e-6 : 1e-2) << "displacement at instant " << k;
    RecordProperty(fmt::format("{}_{}_stress", body, k), fmt::format("{:.1e}", error));
    RecordProperty(fmt::format("{}_{}_displacement", body, k), fmt::format("{:.1e}", difference));
  }
}

/// Expects equal forces by node and component, within `tolerance` of the largest expected force.
void expect_same(const std::map<std::pair<int, int>, double>& actual,
                 const std::map<std::pair<int, int>, double>& expected, double tolerance) {
  double largest = 0.0, difference = 0.0;
  for (const auto& [place, value] : expected) {
    largest = std::max(largest, std::abs(value));
    const auto found = actual.find(place);
    difference = std::max(difference, std::abs(value - (found == actual.end() ? 0.0 : found->second)));
  }
  for (const auto& [place, value] : actual)
    if (!expected.contains(place)) difference = std::max(difference, std::abs(value));
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(difference, tolerance * largest);
}

/// Ratio of the two numbers in a text "... by 2 N; the largest force is 100 N": 0.02.
double difference_from_run(const std::string& text) {
  const std::string first = "differ from those of the run by ", second = "; the largest force is ";
  const std::size_t at = text.find(first), then = text.find(second, at);
  if (at == std::string::npos || then == std::string::npos) return std::nan("");
  return std::stod(text.substr(at + first.size())) / std::stod(text.substr(then + second.size()));
}

constexpr const char* hub = R"yaml(scene: bar on a hub
units: {length: m, mass: kg, time: s}
gravity: [0, 0, -9.81]
bodies:
  hub: {type: rigid, mass: 1, inertia: [0.01, 0.01, 0.01], nodes: {a: {position: [0, 0, 0]}, b: {position: [0, 0.05, 0]}, c: {position: [0, 0, 0.04]}}}
  bar: {type: superelement, file: bar.superelement.h5, BODY}
joints:
  turn: {type: revolute, a: ground, b: hub/a, axis: [0, 0, 1]}
  a: {type: spherical, a: hub/a, b: bar/a}
  b: {type: spherical, a: hub/b, b: bar/b}
  c: {type: spherical, a: hub/c, b: bar/c}
loads: {push: {type: force, at: bar/tip, value: [30, 20, -50]}}
)yaml";

std::string scene_of(const std::string& body, const std::string& more) {
  std::string text = hub;
  return text.replace(text.find("BODY"), 4, body) + more;
}

constexpr const char* at_rest = "motions: {hold: {coordinate: turn, value: 0}}\nanalysis: statics\n";
/// The hub reaches 60 rad/s within 0.02 s: the bar spins, accelerates and vibrates.
constexpr const char* speeding =
    "motions: {drive: {coordinate: turn, value: 1500*t^2}}\nintegrator: {step: 1e-4, end: 0.02}\n";

// Weight and a force at the tip, at rest; a part in m, kg, s and one in mm, t, s.
TEST_F(Loads, OfAPartAtRestGiveTheSameStressInCalculix) {
  for (const bool is_mm : {false, true}) {
    reduce({}, is_mm);
    run(scene_of("second_order: off", at_rest));
    const Outcome outcome = recover({"--body", "bar"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("loads at 0"), HasSubstr("residual"), HasSubstr("bar_loads.inp")));
    // At rest the forces at boundary nodes equal those of joints and load, up to the size of the displacements.
    EXPECT_LT(difference_from_run(outcome.out), 1e-4);
    compare("bar", 1, true);
  }
}

// Bases: modes, modes and moment vectors, modes of the free part; fewer modes than the file; with the companion file.
TEST_F(Loads, OfASpinningAcceleratingPartGiveTheSameStressInCalculix) {
  const std::vector<std::string> instants{"--body", "bar", "--times", "0.0003,0.01,0.02"};
  for (const std::vector<std::string>& basis : {std::vector<std::string>{}, {"moments=4"}, {"method=rubin"}}) {
    reduce(basis, false);
    for (const char* body : {"second_order: off", "second_order: on", "second_order: off, modes: 2",
                             "second_order: off, frame: karcher", "second_order: off, frame: paper"}) {
      run(scene_of(body, speeding));
      const Outcome outcome = recover(instants);
      ASSERT_EQ(outcome.code, 0) << outcome.error;
      compare("bar", 3, std::string(body) != "second_order: on");
    }
  }
}

// The same forces in both forms, numbers of the mesh file, and sums that cancel.
TEST_F(Loads, CancelAndAreTheSameInBothForms) {
  reduce({}, false);
  run(scene_of("second_order: off", speeding));
  const Outcome outcome = recover({"--body", "bar", "--times", "0.01,0.02"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  for (int k = 0; k < 2; ++k) {
    const auto forces = of_calculix("bar", k);
    expect_same(of_nastran("bar", 10 * (k + 1)), forces, 1e-8);
    Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
    double size = 0.0;
    for (const auto& [place, value] : forces) {
      ASSERT_LE(place.second, 3) << "solids take no moments";
      const Vector3d one = value * Vector3d::Unit(place.second - 1);
      force += one;
      moment += mesh.position.at(place.first).cross(one);
      size += std::abs(value);
    }
    EXPECT_LT(force.norm(), 1e-7 * size);
    EXPECT_LT(moment.norm(), 1e-7 * size * 0.4);
  }
  EXPECT_THAT(outcome.out, HasSubstr("loads at 0.02 s"));
}

// Two bodies of one file, of which the second is mirrored at y = 0 and has mirrored loads. The loads on the part are
// equal.
TEST_F(Loads, OfAMirroredBodyAreThoseOfThePart) {
  reduce({}, false);
  run(R"yaml(scene: two bars
units: {length: m, mass: kg, time: s}
gravity: [0.5, 0, -9.81]
bodies:
  left: {type: superelement, file: bar.superelement.h5, second_order: off}
  right: {type: superelement, file: bar.superelement.h5, second_order: off, mirror: xz}
joints:
  la: {type: spherical, a: ground, b: left/a}
  lb: {type: spherical, a: ground, b: left/b}
  lc: {type: spherical, a: ground, b: left/c}
  ra: {type: spherical, a: ground, b: right/a}
  rb: {type: spherical, a: ground, b: right/b}
  rc: {type: spherical, a: ground, b: right/c}
loads:
  l: {type: force, at: left/tip, value: [30, 20, -50]}
  r: {type: force, at: right/tip, value: [30, -20, -50]}
integrator: {step: 1e-4, end: 0.002}
)yaml");
  for (const char* body : {"left", "right"}) {
    const Outcome outcome = recover({"--body", body, "--times", "0.001,0.002"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_LT(difference_from_run(outcome.out), 0.2);
  }
  expect_same(of_calculix("right", 1), of_calculix("left", 1), 1e-6);
  EXPECT_THAT(read_text(folder.file("out/right_loads.inp")), HasSubstr("the body is the mirror image (1 -1 1)"));
}

// A drawn bar, whose nodes have no numbers, moves in a plane, with planar and with spatial equations.
TEST_F(Loads, OfPlanarScenesAreThoseOfSpace) {
  fs::copy_file(TISSERAND_SOURCE_DIR "/tests/verification/references/trials/spinning_bar.part.yaml",
                folder.file("bar.part.yaml"));
  ASSERT_EQ(call({program("reducer"), "run", "bar.part.yaml"}, where).code, 0);
  std::vector<std::map<std::pair<int, int>, double>> loads;
  for (const char* planar : {"off", "on"}) {
    run(fmt::format(R"yaml(scene: bar in a plane
units: {{length: m, mass: kg, time: s}}
gravity: [0, -9.81, 0]
effects: {{planar: {}}}
bodies: {{bar: {{type: superelement, file: bar.superelement.h5, second_order: off}}}}
joints: {{turn: {{type: revolute, a: ground, b: bar/a, axis: [0, 0, 1]}}}}
motions: {{drive: {{coordinate: turn, value: 1500*t^2}}}}
integrator: {{step: 1e-4, end: 0.005}}
)yaml",
                    planar));
    const Outcome outcome = recover({"--body", "bar", "--times", "0.005"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    loads.push_back(of_calculix("bar", 0));
    expect_same(of_nastran("bar", 10), loads.back(), 1e-8);
  }
  expect_same(loads[1], loads[0], 1e-5);
  EXPECT_THAT(read_text(folder.file("out/bar_loads.bdf")),
              AllOf(HasSubstr("have no number"), HasSubstr("  b  at 1 0 0")));
}

// Weight that the run disables is not in the loads: at rest the forces are those of the run.
TEST_F(Loads, KnowWhichEffectsAreOff) {
  reduce({}, false);
  run(scene_of("second_order: off", std::string("effects: {bar: {gravity: off}}\n") + at_rest));
  const Outcome outcome = recover({"--body", "bar"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_LT(difference_from_run(outcome.out), 1e-4);
}

// A disk without space for the loads (files of 4 kB at most): an error, and neither file.
TEST_F(Loads, FullDisksLeaveNoPartOfAFile) {
  reduce({}, false);
  run(scene_of("second_order: off", at_rest));
  where.file_size = 4096;
  const Outcome outcome = recover({"--body", "bar", "--envelope"});
  EXPECT_EQ(outcome.code, 1) << outcome.out;
  for (const char* ending : {"bdf", "inp"})
    EXPECT_FALSE(fs::exists(folder.file(std::string("out/bar_loads.") + ending))) << ending;
}

TEST_F(Loads, WhatHasNoneIsRefusedByName) {
  reduce({}, false);
  run(scene_of("second_order: off", speeding));
  const auto refused = [&](const Outcome& outcome, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.code, 1) << outcome.out;
    for (const std::string& word : words) EXPECT_THAT(outcome.error, HasSubstr(word));
    EXPECT_FALSE(fs::exists(folder.file("out/bar_loads.inp")));
  };
  refused(recover({"--body", "bar"}), {"201 instants", "--times"});
  const std::string before = TISSERAND_SOURCE_DIR "/tests/compatibility/";
  refused(call({program("reducer"), "recover", before + "bar_1.0.recovery.h5", before + "bar_1.9.results.h5", "--frame",
                "part", "--loads", "nastran", "-o", "out"},
               where),
          {"bar_1.0.recovery.h5", "holds no inertia loads", "recovery: yes"});
  reduce({"method=macneal"}, false);
  run(scene_of("second_order: off", at_rest));
  refused(recover({"--body", "bar"}), {"bar.recovery.h5", "method: macneal"});
  reduce({}, false);
  run(scene_of("use: rigid", speeding));
  refused(recover({"--body", "bar", "--times", "0.01"}), {"'bar'", "rigid"});
  reduce({}, false);
  run(R"yaml(scene: pushed a little
units: {length: m, mass: kg, time: s}
effects: {flexibility: auto}
bodies: {bar: {type: superelement, file: bar.superelement.h5, second_order: off}}
loads: {push: {type: force, at: bar/tip, value: [0, 0, 0.01]}}
integrator: {step: 1e-4, end: 0.01}
)yaml");
  refused(recover({"--body", "bar", "--times", "0.0001"}), {"'bar' was simulated as rigid", "a flexible superelement"});
  reduce({"modal_body={reference: mean_axis, modes: 4}"}, false);
  run(R"yaml(scene: modal
units: {length: m, mass: kg, time: s}
gravity: [0, 0, -9.81]
bodies: {bar: {type: modal, file: bar.modal.h5}}
integrator: {step: 1e-4, end: 0.001}
)yaml");
  refused(call({program("reducer"), "recover", "bar.modal.recovery.h5", "run.results.h5", "--loads", "calculix", "-o",
                "out", "--times", "0.001"},
               where),
          {"'bar' is a modal body", "superelement"});
  const Outcome usage = call({program("reducer"), "recover", "a", "b", "--loads", "ansys"}, where);
  EXPECT_EQ(usage.code, 2);
  EXPECT_THAT(usage.error, HasSubstr("nastran"));
}

}  // namespace
}  // namespace tisserand::cli::loads_test
