// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement of second order between boundary nodes, end to end. A cantilever under an end moment M is an arc of
// radius EI/M (Euler's elastica). It is reduced, run, recovered and shown on a page.
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <Eigen/Core>

#include "tests/cli/scenes.hpp"
#include "tests/support/view/page_reader.hpp"

namespace tisserand::cli::second_order_displacement_test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr double EI = 2.1e11 * 1e-8 / 12.0;  // square bar of 10 mm, 1 m long
constexpr int nodes = 21;

class SecondOrderDisplacement : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
    where.folder = folder.path().string();
    for (const char* name : {"stress_cantilever.part.yaml", "stress_cantilever.scene.yaml"})
      fs::copy_file(fs::path(TISSERAND_SOURCE_DIR "/tests/verification/references/trials") / name, folder.file(name));
  }

  void reduce(const std::vector<std::string>& settings = {}) const {
    std::vector<std::string> words{program("reducer"), "run", "stress_cantilever.part.yaml"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }

  /// Runs the scene with the end moment that bends the bar by the angle theta about y.
  void run(double theta, const std::vector<std::string>& settings) const {
    std::vector<std::string> words{program("mechanism"),
                                   "run",
                                   "stress_cantilever.scene.yaml",
                                   "-o",
                                   "run.results.h5",
                                   "--set",
                                   fmt::format("loads.bend.value=[0, {}, 0]", EI * theta)};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }

  /// Last row of the table of points.
  std::vector<double> last_row() const {
    std::istringstream lines(read_text(folder.file("out/bar_points.csv")));
    std::string line, last;
    while (std::getline(lines, line)) last = line;
    std::istringstream cells(last);
    std::vector<double> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
    return values;
  }

  /// Positions of the nodes along the bar at the last instant; `output`: text of the command. Points as in the part.
  std::array<Vector3d, nodes> recover(double sign, std::string& output) const {
    std::vector<std::string> words{
        program("reducer"), "recover", "stress_cantilever.recovery.h5", "run.results.h5", "-o", "out", "--envelope"};
    for (int k = 0; k < nodes; ++k) words.insert(words.end(), {"--point", fmt::format("{},0,0", 0.05 * k)});
    const Outcome outcome = call(words, where);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    output = outcome.out;
    const std::vector<double> values = last_row();
    std::array<Vector3d, nodes> places;
    const std::size_t width = (values.size() - 1) / nodes;  // displacement, position, stress
    for (std::size_t k = 0; k < nodes; ++k)
      places[k] =
          Vector3d(sign * values.at(1 + width * k + 3), values.at(1 + width * k + 4), values.at(1 + width * k + 5));
    return places;
  }

  /// Largest distances from the arc, along the axis of the clamp and across it.
  static std::pair<double, double> missed(const std::array<Vector3d, nodes>& places, double theta) {
    double along = 0.0, across = 0.0;
    for (int k = 0; k < nodes; ++k) {
      const double s = 0.05 * k;
      const Vector3d off = places[static_cast<std::size_t>(k)] -
                           Vector3d(std::sin(theta * s) / theta, 0.0, -(1.0 - std::cos(theta * s)) / theta);
      along = std::max(along, std::abs(off.x()));
      across = std::max(across, off.tail<2>().norm());
    }
    return {along, across};
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

// Without second order the middle errs along the clamp by 0.064 θ² (frame of the base). At 0.1 rad, a deflection of
// five thicknesses, the remaining error is an eightieth of that. It is of third order, as that of the run
// (docs/THEORY.md, section 8).
TEST_F(SecondOrderDisplacement, OfACantileverIsThatOfTheArc) {
  reduce();
  for (const char* frame :
       {"bodies.bar.frame=karcher", "bodies.bar.frame={node: base}", "bodies.bar.frame={node: tip}"})
    for (const double theta : {0.02, 0.1, 0.4}) {
      run(theta, {frame});
      std::string text;
      const auto [along, across] = missed(recover(1.0, text), theta);
      EXPECT_LT(along, 0.0642 * theta * theta * (0.004 + theta * theta)) << frame << theta;
      EXPECT_LT(across, 0.045 * std::pow(theta, 3)) << frame << theta;
      EXPECT_THAT(text, Not(HasSubstr("note"))) << frame;
    }
}

TEST_F(SecondOrderDisplacement, IsThatOfMirroredBodiesAndOtherUnits) {
  reduce({"units={length: mm, mass: t, time: s}", "materials.steel={E: 2.1e5, nu: 0.3, density: 7.8e-9}",
          "sections.rod={shape: rectangle, width: 10, height: 10}", "points={base: [0, 0, 0], tip: [1000, 0, 0]}"});
  const double theta = 0.1;
  for (const auto& [mirror, sign] : {std::pair("xy", 1.0), {"xz", 1.0}, {"yz", -1.0}}) {
    // An arc towards −z of a bar along −x needs the opposite moment.
    run(sign * theta, {std::string("bodies.bar.mirror=") + mirror, "bodies.bar.frame={node: base}"});
    std::vector<std::string> words{program("reducer"), "recover", "stress_cantilever.recovery.h5",
                                   "run.results.h5",   "-o",      "out",
                                   "--envelope",       "--point", "500,0,0"};
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    const std::vector<double> values = last_row();
    EXPECT_NEAR(values.at(4), sign * std::sin(0.5 * theta) / theta, 0.02 * 0.064 * theta * theta) << mirror;
    EXPECT_NEAR(values.at(6), -(1.0 - std::cos(0.5 * theta)) / theta, 0.045 * std::pow(theta, 3)) << mirror;
  }
}

// Planar equations and automatic stiffening give the same displacement as equations in space with stiffening on.
TEST_F(SecondOrderDisplacement, IsTheSameInPlanarScenesAndWithAutomaticStiffening) {
  write_text(folder.file("stress_cantilever.scene.yaml"), R"yaml(scene: cantilever in the x-y plane
bodies: {bar: {type: superelement, file: stress_cantilever.superelement.h5, damping: {ratio: 0.5}}}
joints: {clamp: {type: fixed, a: ground, b: bar/base}}
loads: {bend: {type: moment, at: bar/tip, value: [0, 0, 0]}}
integrator: {step: 2e-3, end: 0.6}
)yaml");
  reduce();
  std::array<std::vector<double>, 3> middle;
  const std::array<std::string, 3> effects{"effects={}", "effects={planar: on}", "effects={bar: {stiffening: auto}}"};
  for (std::size_t k = 0; k < effects.size(); ++k) {
    run(0.1, {fmt::format("loads.bend.value=[0, 0, '{} * (t < 0.5 ? 2*t - sin(4*pi*t)/(2*pi) : 1)']", 0.1 * EI),
              effects[k]});
    std::string text;
    const std::array<Vector3d, nodes> places = recover(1.0, text);
    middle[k] = {places[nodes / 2].x(), places[nodes / 2].y()};
  }
  for (std::size_t k = 0; k < effects.size(); ++k) {
    EXPECT_NEAR(middle[k][0], std::sin(0.05) / 0.1, 3e-6) << effects[k];  // Φ y alone misses by 2.1e-4
    EXPECT_NEAR(middle[k][1], middle[0][1], 1e-7) << effects[k];
  }
}

// The first axial mode of the bar is mode 19 of 24 or so: one body has it, the other has not, and both match the arc.
TEST_F(SecondOrderDisplacement, DoesNotDependOnModesThatTheBodyLeavesOut) {
  reduce({"modes=40"});
  for (const char* modes : {"bodies.bar.modes=40", "bodies.bar.modes=4"}) {
    run(0.1, {modes, "bodies.bar.frame=karcher"});
    std::string text;
    const auto [along, across] = missed(recover(1.0, text), 0.1);
    EXPECT_LT(along, 0.02 * 0.0642 * 0.01) << modes;
    EXPECT_LT(across, 0.045e-3) << modes;
  }
}

// A strip of shells, four times as stiff, between a rigid spider and an averaging one. Without Poisson's ratio it bends
// to a cylinder. In the mean frame its error is that of the cubic between the ends, θ³ L/384.
TEST_F(SecondOrderDisplacement, OfAStripBetweenSpidersIsThatOfTheArc) {
  fs::copy_file(TISSERAND_SOURCE_DIR "/tests/verification/references/trials/stress_strip.part.yaml",
                folder.file("stress_cantilever.part.yaml"), fs::copy_options::overwrite_existing);
  write_text(folder.file("stress_cantilever.scene.yaml"), R"yaml(scene: strip under a moment at its end
bodies: {bar: {type: superelement, file: stress_cantilever.superelement.h5}}
joints: {clamp: {type: fixed, a: ground, b: bar/a}}
loads: {bend: {type: moment, at: bar/b, value: [0, 0, 0]}}
analysis: statics
statics: {load_steps: 5}
)yaml");
  reduce({"materials.steel.nu=0"});
  for (const double theta : {0.02, 0.1, 0.4}) {
    run(4.0 * theta, {"bodies.bar.frame=karcher"});  // 4 EI
    std::string text;
    const auto [along, across] = missed(recover(1.0, text), theta);
    EXPECT_LT(along, 0.0642 * theta * theta * (0.002 + 0.1 * theta * theta)) << theta;
    EXPECT_NEAR(across, std::pow(theta, 3) / 384.0, 0.3 * std::pow(theta, 3) / 384.0) << theta;
  }
}

// Only its base holds the bar: y has no foreshortening, and the free end moves by −½ ∫ w'² ds. Under the weight q per
// length, w' = q (3 L² s − 3 L s² + s³)/(6 EI) [Timoshenko, Strength of materials, cantilever beams].
TEST_F(SecondOrderDisplacement, OfAFreeEndIsItsForeshortening) {
  reduce({"boundary=[base]"});
  write_text(folder.file("weight.scene.yaml"), R"yaml(scene: cantilever under its weight
gravity: [0, 0, -40]
bodies: {bar: {type: superelement, file: stress_cantilever.superelement.h5}}
joints: {clamp: {type: fixed, a: ground, b: bar/base}}
analysis: statics
)yaml");
  const Outcome outcome = call({program("mechanism"), "run", "weight.scene.yaml", "-o", "run.results.h5"}, where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  std::string text;
  const auto places = recover(1.0, text);
  const double q = 7800.0 * 1e-4 * 40.0;
  double sum = 0.0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) / steps, slope = q / (6.0 * EI) * (3.0 * s - 3.0 * s * s + s * s * s);
    sum += 0.5 * slope * slope / steps;
  }
  EXPECT_NEAR(places.back().x(), 1.0 - sum, 0.01 * sum);
  EXPECT_NEAR(places.back().z(), -q / (8.0 * EI), 0.01 * q / (8.0 * EI));
}

// A linear body does not shorten: nothing is added to its displacement, and no note is written.
TEST_F(SecondOrderDisplacement, IsNotAddedToLinearBodies) {
  reduce();
  run(0.1, {"bodies.bar.second_order=off", "bodies.bar.frame={node: base}"});
  std::string text;
  const auto places = recover(1.0, text);
  for (int k = 0; k < nodes; ++k)
    EXPECT_NEAR(places[static_cast<std::size_t>(k)].x(), 0.05 * k, 0.05 * 0.0642 * 0.01) << k;
  EXPECT_THAT(text, Not(HasSubstr("note")));
}

// A page shows each beam by the corners of its sections. Their mean is the node.
TEST_F(SecondOrderDisplacement, OfAPageIsThatOfRecover) {
  reduce();
  run(0.4, {"bodies.bar.frame={node: base}"});
  std::string text;
  const auto places = recover(1.0, text);
  const Outcome outcome = call({program("mechanism"), "view", "run.results.h5", "-o", "run.html"}, where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const test_support::PageReader page(read_text(folder.file("run.html")));
  const nlohmann::json& run = page.run();
  const Eigen::Index last = page.read(run["times"]).rows() - 1;
  const Eigen::Matrix3Xd vertices = page.vertices(run, run["bodies"][0], last);
  ASSERT_EQ(vertices.cols(), 8 * (nodes - 1));
  for (int e = 0; e + 1 < nodes; ++e) {
    const Vector3d node = vertices.middleCols(8 * e, 4).rowwise().mean();
    EXPECT_LT((node - places[static_cast<std::size_t>(e)]).norm(), 6e-4) << e;  // places of pages, and 1e-3 of 0.2
  }
}

}  // namespace
}  // namespace tisserand::cli::second_order_displacement_test
