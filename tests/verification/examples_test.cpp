// SPDX-License-Identifier: GPL-3.0-or-later
// The examples of [Car00], section 8, through both stages: scenes as they lie in examples/, expected numbers of others.
//
// Expected values: "design numbers" were computed by an independent implementation of the same formulation (the
// equations document of the project, section 10) with generalised-alpha, rho = 0.9 and the steps of the paper, against
// a beam model with the same step; they are quoted to two or three digits. Tolerances are one unit of the last digit
// quoted, since the parts are meshed differently. Reference histories: references/README.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "formats/yaml/override.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/histories/tables.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::examples_test {
namespace {

using Settings = std::vector<std::string>;

constexpr const char* kLargeMoment = "loads.torque.value.2={table: [[0, 0], [0.2, 10000], [10, 10000], [10.2, 0]]}";
const TimeWindow kBeforeImpulse{std::nullopt, 15.0};
const TimeWindow kAfterImpulse{15.0, std::nullopt};

Settings operator+(Settings left, const Settings& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

class Examples : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string program = TISSERAND_BINARY_DIR "/bin/reducer";
    if (!std::filesystem::exists(program)) GTEST_SKIP() << "built without the reducer, which makes the superelements";
    reduce("beam", "modes=8");
  }

  void reduce(const std::string& name, const std::string& setting) const {
    const std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                                                     "/examples/hinged_beam/beam.part.yaml -o " +
                                file(name) + " --set '" + setting + "' > " + folder_.file("log") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  std::string file(const std::string& name) const { return folder_.file(name + ".superelement.h5"); }

  /// The setting that names the superelement of a scene's beam.
  std::string body(const std::string& name) const { return "bodies.beam.file=" + file(name); }

  /// Runs examples/<scene>.scene.yaml; results in `result`.
  RunReport run(const std::string& scene, const std::string& result, const Settings& settings) const {
    std::vector<formats::Override> overrides;
    for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
    const std::string path = TISSERAND_SOURCE_DIR "/examples/" + scene + ".scene.yaml";
    return simulate(formats::read_scene(path, overrides), folder_.file(result), RunControl{});
  }

  Series history(const std::string& result, const std::string& channel) const {
    return read_series({{folder_.file(result)}, {}, {channel}, {}}).front();
  }

  Series base(const std::string& result) const { return history(result, "nodes/angular_velocity/beam/base/z"); }

  /// Rate of the base of sixteen nonlinear three-node beams: "a beam code with the same step".
  Series nonlinear_beams(const std::string& scene, const Settings& settings) const {
    const Settings mesh = {"bodies.beam.elements=16", "bodies.beam.nodes_per_element=3",
                           "output={every: 1, channels: [nodes/angular_velocity]}"};
    EXPECT_EQ(run(scene + "/nonlinear", "nonlinear.results.h5", mesh + settings).outcome, RunOutcome::completed);
    return history("nonlinear.results.h5", "nodes/angular_velocity/beam/0/z");
  }

  /// Rate of the base of one superelement with `modes` internal modes.
  Series superelement(const std::string& scene, int modes, const Settings& settings) const {
    const Settings own = {body("beam"), "bodies.beam.modes=" + std::to_string(modes)};
    EXPECT_EQ(run(scene, "superelement.results.h5", own + settings).outcome, RunOutcome::completed);
    return base("superelement.results.h5");
  }

  /// Largest angular velocity of a node about its own x axis, |eₓ·Rᵀω|.
  double axial_spin(const std::string& result, const std::string& node) const {
    const auto of = [&](const std::string& channel) { return history(result, "nodes/" + channel).y; };
    const std::vector<double> w = of("rotation/" + node + "/w"), x = of("rotation/" + node + "/x"),
                              y = of("rotation/" + node + "/y"), z = of("rotation/" + node + "/z"),
                              ox = of("angular_velocity/" + node + "/x"), oy = of("angular_velocity/" + node + "/y"),
                              oz = of("angular_velocity/" + node + "/z");
    double largest = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i)
      largest = std::max(
          largest, std::abs((1.0 - 2.0 * (y[i] * y[i] + z[i] * z[i])) * ox[i] +
                            2.0 * (x[i] * y[i] + w[i] * z[i]) * oy[i] + 2.0 * (x[i] * z[i] - w[i] * y[i]) * oz[i]));
    return largest;
  }

  test_support::TemporaryFolder folder_;
};

double relative(const Series& series, const Series& reference) {
  const Deviation d = deviation(series, reference, {});
  return d.rms / d.reference_rms;
}

Series reference(const std::string& name) {
  return read_reference({TISSERAND_REFERENCES "/cardona/" + name + ".csv", "t", "wz_base", name});
}

using HingedBeam = Examples;

TEST_F(HingedBeam, ErrorsByNumberOfModesAreTheDesignNumbers) {
  const Settings end = {"integrator.end=30"};
  const Series beam = nonlinear_beams("hinged_beam", end);
  EXPECT_NEAR(relative(superelement("hinged_beam/floating_b", 0, end), beam), 0.147, 0.001);
  EXPECT_NEAR(relative(superelement("hinged_beam/floating_b", 4, end), beam), 0.025, 0.001);
  EXPECT_NEAR(relative(superelement("hinged_beam/floating_b", 8, end), beam), 0.013, 0.001);
  EXPECT_NEAR(relative(superelement("hinged_beam/node_base", 0, end), beam), 0.148, 0.001);
  EXPECT_NEAR(relative(superelement("hinged_beam/node_tip", 4, end), beam), 0.025, 0.001);
}

// Spectral beams with explicit time integration, known to 1e-5. The step of 0.01 alone costs the nonlinear beams 2.1 %
// in 20 s: the high modes run out of phase, (omega dt)²/12 per radian. 3 % leaves the superelement about as much again.
TEST_F(HingedBeam, AllFormulationsFollowTheConvergedReference) {
  const Series converged = reference("hinged_beam_200");
  EXPECT_LT(relative(nonlinear_beams("hinged_beam", {}), converged), 0.03);
  for (const char* scene :
       {"hinged_beam/node_base", "hinged_beam/node_tip", "hinged_beam/floating_a", "hinged_beam/floating_b"})
    EXPECT_LT(relative(superelement(scene, 4, {}), converged), 0.03) << scene;
}

// In plane motion the kinetic energies of A and B are the same function. Rates of 3e-2 with Newton's tolerance 1e-8.
TEST_F(HingedBeam, InertiaAAndBAreTheSameInThePlane) {
  const Series a = superelement("hinged_beam/floating_a", 4, {}), b = superelement("hinged_beam/floating_b", 4, {});
  EXPECT_LT(deviation(a, b, {}).largest, 1e-9);
}

// [Car00] 8.1: the formulation is invariant with respect to the order of the nodes; frames attached to base and tip
// give different results when the load is large. Order: round-off and Newton's tolerance only.
TEST_F(HingedBeam, OrderOfTheNodesDoesNotMatterButTheReferenceNodeDoes) {
  reduce("permuted", "boundary={tip: all, base: all}");
  const Series given = superelement("hinged_beam/floating_b", 8, {});
  ASSERT_EQ(run("hinged_beam/floating_b", "permuted.results.h5", {body("permuted"), "bodies.beam.modes=8"}).outcome,
            RunOutcome::completed);
  EXPECT_LT(deviation(base("permuted.results.h5"), given, {}).largest, 1e-9);

  const Settings large = {kLargeMoment, "integrator.step=0.002"};
  EXPECT_GT(relative(superelement("hinged_beam/node_tip", 4, large), superelement("hinged_beam/node_base", 4, large)),
            0.05);
}

// One superelement lacks geometric stiffening: design numbers 13 % to 14 % for every number of modes in the floating
// frame, over 20 s the phase has drifted a little less. Two pieces of the beam would follow it better. The reference is
// known to 0.5 %.
TEST_F(HingedBeam, LargeMomentShowsTheMissingGeometricStiffening) {
  const Series converged = reference("hinged_beam_10000");
  const Settings large = {kLargeMoment, "integrator.step=0.002"};
  for (const int modes : {0, 4, 8}) {
    const double error = relative(superelement("hinged_beam/floating_b", modes, large), converged);
    EXPECT_GT(error, 0.11) << modes << " modes";
    EXPECT_LT(error, 0.145) << modes << " modes";
  }
}

// Design numbers: at the paper's step the node-attached frame does not converge or gains energy (12 % to 17 % with
// short steps, so the step is to blame), the floating one does neither. Twice the error is "blown up" without a fine
// line.
TEST_F(HingedBeam, FloatingFrameStandsTheLargeMomentAtThePapersStep) {
  const Series converged = reference("hinged_beam_10000");
  const RunReport floating = run("hinged_beam/floating_b", "floating.results.h5", {body("beam"), kLargeMoment});
  ASSERT_EQ(floating.outcome, RunOutcome::completed);
  EXPECT_LT(floating.largest_balance, 1e-3 * floating.energy_reference);
  const double error = relative(base("floating.results.h5"), converged);
  for (const char* scene : {"hinged_beam/node_base", "hinged_beam/node_tip"}) {
    const RunReport attached = run(scene, "attached.results.h5", {body("beam"), kLargeMoment});
    EXPECT_TRUE(attached.outcome != RunOutcome::completed ||
                relative(base("attached.results.h5"), converged) > 2.0 * error)
        << scene;
  }
}

using SphericalBeam = Examples;

TEST_F(SphericalBeam, ErrorsBeforeTheImpulseAreTheDesignNumbers) {
  const Series beam = reference("spherical_beam_same_step");
  const Settings end = {"integrator.end=15"};
  for (const char* scene : {"spherical_beam/floating_a", "spherical_beam/floating_b", "spherical_beam/node_base"}) {
    EXPECT_NEAR(deviation(superelement(scene, 0, end), beam, kBeforeImpulse).rms, 3.6e-3, 1e-4) << scene;
    EXPECT_NEAR(deviation(superelement(scene, 4, end), beam, kBeforeImpulse).rms, 9.9e-4, 1e-5) << scene;
    EXPECT_NEAR(deviation(superelement(scene, 8, end), beam, kBeforeImpulse).rms, 1.1e-4, 1e-5) << scene;
  }
}

TEST_F(SphericalBeam, NonlinearBeamsFollowTheOtherBeamCodeWithTheSameStep) {
  // Sixteen corotational superelements without modes err by (1.8e-3 with five) (5/16)^4 ~ 2e-5 after the impulse.
  const Series ours = nonlinear_beams("spherical_beam", {});
  EXPECT_LT(deviation(ours, reference("spherical_beam_same_step"), {}).rms, 2e-5);
}

TEST_F(SphericalBeam, ErrorsAfterTheImpulseAreTheDesignNumbers) {
  const Settings end = {"integrator.end=50"};
  const Series beam = nonlinear_beams("spherical_beam", end);
  const std::map<std::string, std::map<int, double>> design = {
      {"floating_a", {{0, 1.65e-1}, {4, 2.07e-1}, {8, 2.06e-1}}},
      {"floating_b", {{0, 3.4e-2}, {4, 3.6e-2}, {8, 3.4e-2}}},
      {"node_base", {{0, 3.3e-2}, {4, 3.2e-2}, {8, 3.0e-2}}}};
  for (const auto& [scene, by_modes] : design)
    for (const auto& [modes, expected] : by_modes)
      EXPECT_NEAR(deviation(superelement("spherical_beam/" + scene, modes, end), beam, kAfterImpulse).rms, expected,
                  1e-3)
          << scene << ", " << modes << " modes";
}

// Why A fails and B errs: both let the beam spin about its axis (exact: 4e-4). Design numbers of four modes.
TEST_F(SphericalBeam, SpuriousAxialSpin) {
  (void)superelement("spherical_beam/floating_a", 4, {});
  EXPECT_NEAR(axial_spin("superelement.results.h5", "beam/base"), 0.56, 0.01);
  (void)superelement("spherical_beam/floating_b", 4, {});
  EXPECT_NEAR(axial_spin("superelement.results.h5", "beam/base"), 0.11, 0.01);
  ASSERT_EQ(run("spherical_beam/nonlinear", "nonlinear.results.h5", {"bodies.beam.nodes_per_element=3"}).outcome,
            RunOutcome::completed);
  EXPECT_NEAR(axial_spin("nonlinear.results.h5", "beam/0"), 4e-4, 1e-4);
}

}  // namespace
}  // namespace tisserand::mechanism::examples_test
