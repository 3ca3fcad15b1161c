// SPDX-License-Identifier: GPL-3.0-or-later
// Spinning superelements with rotary inertia at their nodes, against nonlinear beams and rigid bodies welded to the
// same superelement (tests/verification/references/trials).
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes/trial.hpp"

namespace tisserand::mechanism::rotary_inertia_trials_test {
namespace {

using test_support::Trial;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

class RotaryInertiaTrials : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer"))
      GTEST_SKIP() << "built without the reducer, which makes the superelements";
  }

  /// Reduces <part>.part.yaml with a setting more; the setting of a scene that takes it for a body.
  std::string reduce(const std::string& part, const std::string& body, const std::string& setting = "") const {
    const std::string path = folder.file(part + ".superelement.h5");
    const std::string command =
        fmt::format(TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                                         "/tests/verification/references/trials/{}.part.yaml {} -o {} > {} 2>&1",
                    part, setting, path, folder.file("log"));
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return fmt::format("bodies.{}.file={}", body, path);
  }
  test_support::TemporaryFolder folder;
};

std::vector<std::string> at_spin(double spin, std::vector<std::string> more = {}) {
  more.push_back(fmt::format("motions.turn.value={} * t", spin));
  more.push_back(fmt::format("analyses.st.statics.rotation.angular_velocity=[{}, 0, 0]", spin));
  return more;
}

void expect_same(const std::vector<double>& found, const std::vector<double>& right, double tolerance,
                 const std::string& what) {
  ASSERT_GE(found.size(), 5u) << what;
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(found[k], right.at(k), tolerance * right.at(k)) << what << " " << k;
}

// The disc as a point mass of the part, at rest to twice the first critical speed (223 rad/s). Frequencies of beams in
// turning axes at 200 rad/s: 6.747, 64.20, 77.93, 134.3, 158.3 Hz in bending, and torsion of the shaft between drive and
// disc, sqrt(GJ/(l I)) = 37.8 Hz. Six internal modes leave 0.1 %.
TEST_F(RotaryInertiaTrials, DiscInsideThePart) {
  const std::string file = reduce("rotor_disc_inside", "s"), bare = reduce("rotor_bare", "s");
  for (const double spin : {0.0, 100.0, 200.0, 300.0, 450.0}) {
    const std::vector<double> beams = Trial("rotor_disc_beams", at_spin(spin)).frequencies("t");
    if (spin == 200.0) expect_same(beams, {6.747, 37.77, 64.20, 77.93, 134.3}, 1e-3, "beams");
    const Trial inside("rotor_disc_inside", at_spin(spin, {file}));
    expect_same(inside.frequencies("t"), beams, 2e-3, fmt::format("inside, {} rad/s", spin));
    EXPECT_THAT(inside.report("t").notes, Each(Not(HasSubstr("grow")))) << spin;
    expect_same(inside.frequencies("t"), Trial("rotor_disc_welded", at_spin(spin, {bare})).frequencies("t"), 2e-4,
                fmt::format("welded, {} rad/s", spin));
  }
}

// The same for every frame, and for boundary nodes with and without the disc's.
TEST_F(RotaryInertiaTrials, FramesAndBoundaryNodes) {
  std::map<double, std::vector<double>> beams;
  for (const double spin : {200.0, 400.0}) beams[spin] = Trial("rotor_disc_beams", at_spin(spin)).frequencies("t");
  for (const char* boundary : {"[l, m, r]", "[l, r]", "[m, r, l]"}) {
    const std::string file =
        reduce("rotor_disc_inside", "s", fmt::format("--set 'boundary={}' --set modes=10", boundary));
    for (const auto& [spin, right] : beams)
      for (const char* frame : {"karcher", "{node: l}", "{node: r}"})
        expect_same(
            Trial("rotor_disc_inside", at_spin(spin, {file, fmt::format("bodies.s.frame={}", frame)})).frequencies("t"),
            right, 3e-3, fmt::format("{} {} {}", boundary, frame, spin));
  }
}

// The disc drawn as a beam of ten times the radius: 7.741 Hz by nonlinear beams.
TEST_F(RotaryInertiaTrials, DiscDrawnAsABeam) {
  const std::string file = reduce("rotor_thick_beam", "s");
  const std::vector<double> beams = Trial("rotor_thick_beam_reference").frequencies("t");
  EXPECT_NEAR(beams.at(0), 7.741, 1e-3);
  expect_same(Trial("rotor_thick_beam", {file}).frequencies("t"), beams, 2e-3, "thick beam");
}

/// Torsion of the arm of tip_bare under the tension of a spinning tip mass at `reach` beside the tip, which adds
/// N (I_p/A) to GJ (Wagner): 1/k = ∫ dx/(GJ + N I_p/A), J that of the sphere and a third of the arm's.
double torsion_frequency(double spin, double reach) {
  const double GJ = 7e10 / 2.66 * 5e-11, I_p = 2.0 * 6.7e-9, A = 2e-4, density = 2700.0;
  double compliance = 0.0;
  constexpr int pieces = 1000;
  for (int i = 0; i < pieces; ++i) {
    const double x = (i + 0.5) / pieces;
    const double N = spin * spin * (0.5 * (1.0 + reach) + 0.5 * density * A * (1.0 - x * x));
    compliance += 1.0 / (GJ + N * I_p / A) / pieces;
  }
  return std::sqrt(1.0 / (compliance * (2e-3 + density * I_p / 3.0))) / (2.0 * std::numbers::pi);
}

// A sphere does not feel its attitude: torsion of the arm is that of a sphere at rest under the same tension. Beside
// its node, on it, and of a body welded to the same superelement.
TEST_F(RotaryInertiaTrials, SphereAtTheTipOfAnArm) {
  const std::string bare = reduce("tip_bare", "b");
  for (const double reach : {0.2, 0.0})
    for (const double spin : {40.0, 80.0}) {
      const std::string file =
          reduce("tip_mass_offset", "b", fmt::format("--set 'point_masses.pm.offset=[{}, 0, 0]'", reach));
      const auto settings = [&](const std::string& body, std::vector<std::string> more = {}) {
        more.push_back(body);
        more.push_back(fmt::format("motions.turn.value={} * t", spin));
        more.push_back(fmt::format("analyses.st.statics.rotation.angular_velocity=[0, 0, {}]", spin));
        return more;
      };
      const Trial inside("tip_mass_offset", settings(file));
      const Trial welded("tip_mass_welded",
                         settings(bare, {fmt::format("bodies.m.nodes.at.position=[{}, 0, 0]", -reach),
                                         fmt::format("bodies.m.pose.position=[{}, 0, 0]", 1.0 + reach)}));
      EXPECT_NEAR(inside.frequencies("t").at(0), torsion_frequency(spin, reach), 0.01 * torsion_frequency(spin, reach))
          << reach << " " << spin;
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(inside.frequencies("t").at(k), welded.frequencies("t").at(k), 5e-4 * welded.frequencies("t").at(k))
            << reach << " " << spin << " mode " << k;
      EXPECT_THAT(inside.report("t").notes, Each(Not(HasSubstr("grow")))) << reach << " " << spin;
    }
}

// Springs of unequal stiffness between coincident nodes of solids, which have no rotations, turn with the part: the
// same part with its faces also tied by rigid spiders has 14.81 Hz (third mode) under 200 N and -60 N m. With axes that
// stay as they are it was 13.51 Hz.
TEST_F(RotaryInertiaTrials, SpringsBetweenSolidsTurnWithThePart) {
  const double free = Trial("solid_springs_free", {reduce("solid_springs_free", "b")}).frequencies("t").at(2);
  const double hub = Trial("solid_springs_hub", {reduce("solid_springs_hub", "b")}).frequencies("t").at(2);
  EXPECT_NEAR(hub, 14.81, 0.01);
  EXPECT_NEAR(free, hub, 1e-4 * hub);
}

}  // namespace
}  // namespace tisserand::mechanism::rotary_inertia_trials_test
