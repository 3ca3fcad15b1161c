// SPDX-License-Identifier: GPL-3.0-or-later
// The example parts through both programs, against closed formulas, equilibrium alone, the CAD kernel, and other models
// of the same structure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include "formats/part/part.hpp"
#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "formats/yaml/override.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::parts_examples_test {
namespace {

using Settings = std::vector<std::string>;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
const std::string examples = TISSERAND_SOURCE_DIR "/examples/";

class PartsExamples : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer")) GTEST_SKIP() << "built without the reducer";
  }

  std::string file(const std::string& name) const { return folder_.file(name + ".superelement.h5"); }

  /// Reduces examples/<part>.part.yaml; superelement and certificate in the folder of the test.
  void reduce(const std::string& part, const std::string& name, const Settings& settings) const {
    std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " + examples + part + ".part.yaml -o " + file(name);
    for (const std::string& setting : settings) command += " --set '" + setting + "'";
    command += " > " + folder_.file("log") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  nlohmann::json certificate(const std::string& name) const {
    std::ifstream stream(folder_.file(name + ".superelement.certificate.json"));
    return nlohmann::json::parse(stream);
  }

  /// Frequencies with all boundary nodes held.
  std::vector<double> held_frequencies(const std::string& name) const {
    return certificate(name).at("file").at("fixed_boundary_frequency");
  }

  formats::LoadedSuperelement element(const std::string& name) const { return formats::read_superelement(file(name)); }

  RunReport run(const std::string& scene, const Settings& settings) const {
    std::vector<formats::Override> overrides;
    for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
    return simulate(formats::read_scene(examples + scene + ".scene.yaml", overrides), folder_.file("run.results.h5"),
                    RunControl{});
  }

  Series history(const std::string& channel) const {
    return read_series({{folder_.file("run.results.h5")}, {}, {channel}, {}}).front();
  }

  test_support::TemporaryFolder folder_;
};

// --- stiffened plate ---------------------------------------------------------------------------------------------

constexpr double kSide = 203, kThickness = 1.37, kWidth = 6.35, kHeight = 12.7, kDensity = 2.82e-9;

TEST_F(PartsExamples, StiffenedPlateWeighsWhatPlateAndRibDo) {
  reduce("stiffened_plate/plate", "plate", {"modes=0"});
  const formats::RigidProperties rigid = element("plate").report.rigid;
  const double plate = kDensity * kSide * kSide * kThickness, rib = kDensity * kSide * kWidth * kHeight;
  EXPECT_NEAR(rigid.mass, plate + rib, 1e-9 * rigid.mass);
  const double depth = 0.5 * (kThickness + kHeight) * rib / (plate + rib);  // of the centre of mass
  EXPECT_LT((rigid.center_of_mass - Vector3d(0.5 * kSide, 0.5 * kSide, -depth)).norm(), 1e-7 * kSide);
}

// Published: M. D. Olson, C. R. Hazell, J. Sound Vib. 50 (1977) 43-61, their finite elements, as quoted by later
// authors (quoted here from memory); a plate and a line of rib as here. Different elements and meshes: 2 %.
TEST_F(PartsExamples, StiffenedPlateHasTheFrequenciesOfOlsonAndHazell) {
  reduce("stiffened_plate/plate", "plate", {"modes=8"});
  const std::vector<double> published = {718.1, 751.4, 997.4, 1007.1, 1419.8, 1424.3, 1631.5, 1853.9};
  const std::vector<double> ours = held_frequencies("plate");
  ASSERT_GE(ours.size(), published.size());
  for (std::size_t k = 0; k < published.size(); ++k) EXPECT_NEAR(ours[k] / published[k], 1.0, 0.02) << "mode " << k + 1;
}

// --- jib of tubes ------------------------------------------------------------------------------------------------

/// A pin-jointed bar between two points of a part.
struct Bar {
  int from = 0, to = 0;
  double length = 0.0, area = 0.0;
};

int point_index(const formats::Part& part, const std::string& name) {
  for (std::size_t i = 0; i < part.points.size(); ++i)
    if (part.points[i].name == name) return static_cast<int>(i);
  return -1;
}

std::vector<Bar> bars_of(const formats::Part& part) {
  std::vector<Bar> bars;
  for (const formats::BeamLine& beam : part.beams) {
    Bar bar{point_index(part, beam.from.name), point_index(part, beam.to.name), 0.0, 0.0};
    bar.length = (part.points[bar.to].position - part.points[bar.from].position).norm();
    for (const formats::Section& section : part.sections)
      if (section.name == beam.section) bar.area = section.area;
    bars.push_back(bar);
  }
  return bars;
}

/// Sinking of a joint under a unit load downwards there, from equilibrium alone. The frame of bars is statically
/// determinate: 3 equations per free joint give the bar forces N, and the sinking is Σ N² L/(E A).
double sinking_by_equilibrium(const formats::Part& part, const std::string& loaded,
                              const std::vector<std::string>& held) {
  const std::vector<Bar> bars = bars_of(part);
  std::vector<int> row(part.points.size(), 0);
  for (const std::string& name : held) row[point_index(part, name)] = -1;
  int rows = 0;
  for (int& r : row)
    if (r >= 0) r = std::exchange(rows, rows + 3);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(bars.size()));
  for (std::size_t b = 0; b < bars.size(); ++b) {
    const auto from = static_cast<std::size_t>(bars[b].from), to = static_cast<std::size_t>(bars[b].to);
    const Vector3d pull = (part.points[to].position - part.points[from].position) / bars[b].length;
    if (row[from] >= 0) A.block<3, 1>(row[from], static_cast<Eigen::Index>(b)) = pull;
    if (row[to] >= 0) A.block<3, 1>(row[to], static_cast<Eigen::Index>(b)) = -pull;
  }
  EXPECT_EQ(A.rows(), A.cols()) << "not determinate";
  Eigen::VectorXd load = Eigen::VectorXd::Zero(rows);
  load[row[point_index(part, loaded)] + 2] = -1.0;
  const Eigen::VectorXd N = A.partialPivLu().solve(-load);
  double sinking = 0.0;
  for (std::size_t b = 0; b < bars.size(); ++b) sinking += N[b] * N[b] * bars[b].length / bars[b].area;
  return sinking / part.materials.front().youngs_modulus;
}

/// Sinking under the unit load from a superelement with the translations at `held` fixed: S̄ is exact in statics.
double sinking_of(const formats::Superelement& element, const std::string& loaded,
                  const std::vector<std::string>& held) {
  std::vector<int> free;
  Eigen::Index at = -1;
  for (Eigen::Index i = 0; i < element.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (element.dof_node[k] < 0) continue;
    const std::string& name = element.node_name[element.dof_node[k]];
    if (element.dof_component[k] < 3 && std::find(held.begin(), held.end(), name) != held.end()) continue;
    if (name == loaded && element.dof_component[k] == 2) at = static_cast<Eigen::Index>(free.size());
    free.push_back(static_cast<int>(i));
  }
  const Eigen::MatrixXd S = element.stiffness(free, free);
  return S.fullPivLu().solve(Eigen::VectorXd::Unit(S.rows(), at))[at];
}

const std::vector<std::string> kFeet = {"a0", "b0", "c0"};

formats::Part jib(const Settings& settings) {
  std::vector<formats::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
  return formats::read_part(examples + "tube_frame/jib.part.yaml", overrides);
}

TEST_F(PartsExamples, JibWeighsWhatItsTubesDo) {
  reduce("tube_frame/jib", "jib", {"modes=0"});
  const formats::Part part = jib({});
  double mass = 45 + 60;
  Vector3d moment = 45 * Vector3d(9.05, 0, -1.4) + 60 * Vector3d(1.5, 0, 0.15);
  for (const Bar& bar : bars_of(part)) {
    const double own = 7850 * bar.area * bar.length;
    mass += own;
    moment += 0.5 * own * (part.points[bar.from].position + part.points[bar.to].position);
  }
  const formats::RigidProperties rigid = element("jib").report.rigid;
  EXPECT_NEAR(rigid.mass, mass, 1e-9 * mass);
  EXPECT_LT((rigid.center_of_mass - moment / mass).norm(), 1e-7);
}

// Bars without bending: equilibrium is exact, to round-off of a condition of 1e4.
TEST_F(PartsExamples, JibOfBarsSinksAsEquilibriumDemands) {
  Settings bars = {
      "modes=0", "point_masses={block: {at: c6, mass: 45}}",
      "boundary={a0: translations, b0: translations, c0: translations, c6: translations}",
      "sections={upper: {shape: rod, A: 7e-4}, lower: {shape: rod, A: 11e-4}, brace: {shape: rod, A: 2.5e-4}}"};
  for (const formats::BeamLine& beam : jib({}).beams) bars.push_back("beams." + beam.name + ".elements=1");
  reduce("tube_frame/jib", "bars", bars);
  const double expected = sinking_by_equilibrium(jib(bars), "c6", kFeet);
  EXPECT_NEAR(sinking_of(element("bars").superelement, "c6", kFeet), expected, 1e-9 * expected);
}

// Welded chords and battens carry a little by bending: stiffer than bars, by less than 2 %.
TEST_F(PartsExamples, JibSinksALittleLessThanItsBars) {
  reduce("tube_frame/jib", "jib", {"modes=0"});
  const double ratio =
      sinking_of(element("jib").superelement, "c6", kFeet) / sinking_by_equilibrium(jib({}), "c6", kFeet);
  EXPECT_LT(ratio, 1.0);
  EXPECT_GT(ratio, 0.98);
}

// Diagonals pinned at both ends: f = π/2 √(EI/m)/L² (1 − π²/2 r²/L² (1 + E/(k G))), k = 1/2 of a thin tube. Groups of
// them vibrate so that the joints do not move. With welded ends f would be 2.27 times as high. Four cubic elements per
// diagonal err by (π/4)⁴/720/2 = 3e-4.
TEST_F(PartsExamples, ReleasedDiagonalsVibrateAsPinnedBeams) {
  reduce("tube_frame/jib", "jib", {});
  const double outer = 0.01685, inner = 0.01425, E = 2.1e11;
  const double area = pi * (outer * outer - inner * inner), I = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
  for (const double width : {1.2, std::hypot(0.6, 1.1)}) {  // of the side of the triangle that the diagonal crosses
    const double L2 = 1.5 * 1.5 + width * width, r2 = I / area;
    const double pinned =
        pi / 2 * std::sqrt(E * I / (7850 * area)) / L2 * (1 - pi * pi / 2 * r2 / L2 * (1 + 2.6 / 0.5));
    int found = 0;
    for (const double f : held_frequencies("jib")) found += std::abs(f / pinned - 1) < 1e-3 ? 1 : 0;
    EXPECT_GE(found, 5) << "near " << pinned << " Hz";
  }
}

// A suddenly applied load makes a lightly damped beam swing to about twice its static sinking.
TEST_F(PartsExamples, SuddenLoadSinksTheJibTwiceAsFar) {
  reduce("tube_frame/jib", "jib", {});
  ASSERT_EQ(run("tube_frame/hoist", {"bodies.jib.file=" + file("jib"), "integrator.end=0.4"}).outcome,
            RunOutcome::completed);
  const Series z = history("nodes/position/jib/c6/z");
  const double lowest = *std::min_element(z.y.begin(), z.y.end());
  const double still = 5000 * sinking_of(element("jib").superelement, "c6", kFeet);
  EXPECT_GT((-1.1 - lowest) / still, 1.8);
  EXPECT_LT((-1.1 - lowest) / still, 2.1);
}

// --- crank -------------------------------------------------------------------------------------------------------

/// Volume of crank.geo in closed form [mm³]: hub and boss less their bores, a third of a ring as counterweight, and
/// the web between two circles and their tangents.
double crank_volume() {
  const double throw_ = 60, hub = 32, boss = 22, beta = std::acos((hub - boss) / throw_);
  const double hull = (hub + boss) * throw_ * std::sin(beta) + hub * hub * (pi - beta) + boss * boss * beta;
  const double web = hull - pi * (hub * hub + boss * boss);
  return pi * (hub * hub - 16 * 16) * 40 + pi * (boss * boss - 11 * 11) * 30 + pi / 3 * (62 * 62 - hub * hub) * 18 +
         web * 18;
}

// Mass against the closed formula, centre and inertia [mm⁵ per density] against OpenCASCADE's integrals over
// crank.step. Edges of 10 mm and curved sides: chords of the bores err by some 1e-4.
void expect_mass_of_cad_file(const formats::RigidProperties& rigid) {
  EXPECT_NEAR(crank_volume() / 200371.613342, 1.0, 1e-10);  // OpenCASCADE agrees with the formula
  const double density = 7.85e-9;
  EXPECT_NEAR(rigid.mass / (density * crank_volume()), 1.0, 2e-4);
  EXPECT_LT((rigid.center_of_mass - Vector3d(2.47357934, 0, 0)).norm(), 0.01);
  const Vector3d cad = density * Vector3d(97512573.88, 288204976, 351088734.3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(rigid.inertia(k, k) / cad[k], 1.0, 5e-4) << k;
}

/// Rigid slider-crank of slider_crank.scene.yaml.
struct SliderCrank {
  double r = 0.06, l = 0.2, a = 0.06, rod = 0.5, rod_inertia = 3e-3, piston = 0.4;
  double position(double angle) const {
    return r * std::cos(angle) + std::sqrt(l * l - std::pow(r * std::sin(angle), 2));
  }
  /// Reduced inertia J(angle) = dT/d(½ω²) of rod and piston.
  double inertia(double angle) const {
    const double swing = -std::asin(r / l * std::sin(angle));
    const double swing_rate = -r * std::cos(angle) / (l * std::cos(swing));
    const double x_rate = -r * std::sin(angle) - l * std::sin(swing) * swing_rate;
    const double rod_x = -r * std::sin(angle) - a * std::sin(swing) * swing_rate,
                 rod_y = r * std::cos(angle) + a * std::cos(swing) * swing_rate;
    return piston * x_rate * x_rate + rod * (rod_x * rod_x + rod_y * rod_y) + rod_inertia * swing_rate * swing_rate;
  }
  /// Torque at constant speed: ½ω² dJ/dangle.
  double torque(double angle, double speed) const {
    return 0.5 * speed * speed * (inertia(angle + 1e-4) - inertia(angle - 1e-4)) / 2e-4;
  }
};

/// Largest compliance [m/N] of the pin along x and y with the shaft held, from a superelement in mm, t, s.
double pin_compliance(const formats::Superelement& element) {
  std::vector<int> pin;
  for (int i = 0; i < element.size(); ++i) {
    const int node = element.dof_node[i];
    if (node >= 0 && element.node_name[node] == "pin") pin.push_back(i);
  }
  const Eigen::MatrixXd C = Eigen::MatrixXd(element.stiffness(pin, pin)).inverse();
  return 1e-3 * std::max(C(0, 0), C(1, 1));
}

// The inertia of rod and piston, at most (m + m) r ω² (1 + r/l), bends the crank. The error of the piston is 0.1 to 2
// times that over the pin's stiffness (rod angle, run-up). The torque is that of the rigid mechanism within 1 %:
// ω²/ω₁² = 1e-4 and the piston's error relative to the throw, 3e-4, over the harmonics.
TEST_F(PartsExamples, CrankHasTheMassOfItsCadFileAndMovesAsARigidOneAlmost) {
  reduce("crank/crank", "crank", {});
  const formats::LoadedSuperelement crank = element("crank");
  expect_mass_of_cad_file(crank.report.rigid);
  ASSERT_EQ(run("crank/slider_crank", {"bodies.crank.file=" + file("crank")}).outcome, RunOutcome::completed);
  const Series angle = history("joints/coordinate/shaft"), x = history("nodes/position/piston/x"),
               moment = history("superelements/boundary_force/crank/shaft/moment_z");
  const SliderCrank rigid;
  double way = 0, largest = 0, difference = 0;
  for (std::size_t k = 0; k < x.x.size(); ++k) {
    way = std::max(way, std::abs(x.y[k] - rigid.position(angle.y[k])));
    if (x.x[k] < 0.06) continue;
    const double torque = rigid.torque(angle.y[k], 100 * pi);
    largest = std::max(largest, std::abs(torque));
    difference = std::max(difference, std::abs(moment.y[k] - torque));
  }
  const double force = (rigid.rod + rigid.piston) * rigid.r * std::pow(100 * pi, 2) * (1 + rigid.r / rigid.l);
  const double bent = force * pin_compliance(crank.superelement);
  EXPECT_LT(way, 2 * bent);
  EXPECT_GT(way, 0.1 * bent);
  EXPECT_LT(difference, 0.01 * largest);
}

}  // namespace
}  // namespace tisserand::mechanism::parts_examples_test
