// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of second-order superelements: choices that are refused, with the remedy; doubts of linear ones, which
// are not theirs.
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/build/superelements.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/second_order_beam.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::second_order_messages_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using std::numbers::pi;
using ::testing::HasSubstr;
using ::testing::Not;

RunReport run(const formats::Scene& scene, const BodyFiles& files) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("a.results.h5");
  return simulate(RunRequest{scene, files, std::nullopt, path, "", std::nullopt}, RunControl{}).report;
}
// Axial force, spin and deflection are in the equations of a second-order body: what is doubted of the linear one is
// right there.
TEST(LinearDoubts, AreSilentWhereTheBodyIsOfSecondOrder) {
  constexpr double length = 10.0, EI = 100.0;  // of the softer plane; mass 1 per length
  const test_support::SectionData section{.EA = 1e6,
                                          .GJ = 80,
                                          .EI_y = EI,
                                          .EI_z = 200,
                                          .mass = 1,
                                          .torsional_inertia = 0.03,
                                          .rotary_y = 0.01,
                                          .rotary_z = 0.02};
  const auto made = test_support::second_order_beam(test_support::bernoulli_beam(section, length, 16), {0, 16}, 4);
  BodyFiles files;
  test_support::add_file("beam", made.element, files.superelements);
  files.companions["beam"] = made.companion;
  enum class Motion { axial, deflection, spin };
  for (const auto motion : {Motion::axial, Motion::deflection, Motion::spin})
    for (const bool second_order : {true, false}) {
      formats::Scene scene = test_support::empty_scene(1e-2, 0.1);
      formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
      body.second_order = second_order;
      if (motion == Motion::deflection) body.frame = formats::FrameKind::node, body.frame_node = "n0";
      const bool turns = motion == Motion::spin;
      if (turns) body.start.angular_velocity = Vector3d(0, 0, 0.5 * 3.516 * std::sqrt(EI) / (length * length));
      scene.bodies.push_back(body);
      scene.joints.push_back(test_support::joint("base", turns ? JointKind::revolute : JointKind::fixed, "ground",
                                                 "beam/n0", Vector3d::Zero(), Vector3d::UnitZ()));
      if (!turns) {
        scene.analysis = formats::AnalysisKind::statics;
        const double euler = pi * pi * EI / (length * length), bending = 0.3 * 3.0 * EI / (length * length);
        scene.loads.push_back(test_support::constant_load(
            "load", formats::LoadKind::force, "beam/n16",
            motion == Motion::axial ? Vector3d(0.2 * euler, 0, 0) : Vector3d(0, 0, bending)));
      }
      const std::string doubts = ::testing::PrintToString(run(scene, files).doubts);
      const char* expected = turns                     ? "spins at 0.5 of its first frequency"
                             : motion == Motion::axial ? "tension of 0.2 of its buckling load"
                                                       : "of its length";
      if (second_order)
        EXPECT_THAT(doubts, Not(HasSubstr(expected)));
      else
        EXPECT_THAT(doubts, HasSubstr(expected));
    }
}

// Combinations that were measured to be wrong, and terms of a companion that is not there.
TEST(SecondOrderMessages, SayWhatIsWrongWithAChoiceAndWhatHelps) {
  using formats::InertiaOption;
  using formats::StiffeningOption;
  formats::Companion companion;
  companion.H.emplace_back();  // no load cases alone
  const auto refusal = [&](std::optional<InertiaOption> inertia, std::optional<StiffeningOption> stiffening,
                           std::optional<bool> on, bool with_companion) {
    formats::SuperelementBodySpec spec = test_support::superelement_body("rod", "rod");
    spec.inertia = inertia, spec.stiffening = stiffening, spec.second_order = on;
    return test_support::error_of([&] { (void)choose_second_order(spec, with_companion ? &companion : nullptr); });
  };
  EXPECT_THAT(refusal({}, {}, true, false), HasSubstr("`second_order: yes` in the part file"));
  EXPECT_THAT(refusal(InertiaOption::F, {}, {}, false), HasSubstr("inertia F, stiffening off needs"));
  EXPECT_THAT(refusal({}, StiffeningOption::stress, {}, false), HasSubstr("inertia M, stiffening stress needs"));
  for (const InertiaOption inertia : {InertiaOption::A, InertiaOption::B})
    EXPECT_THAT(refusal(inertia, StiffeningOption::stress, {}, true), HasSubstr("errors reach 30 %"));
  for (const InertiaOption inertia : {InertiaOption::A, InertiaOption::B, InertiaOption::M})
    EXPECT_THAT(refusal(inertia, StiffeningOption::full, {}, true), HasSubstr("set inertia: F"));
  EXPECT_EQ(refusal({}, {}, true, true), "no error");
}

}  // namespace
}  // namespace tisserand::mechanism::second_order_messages_test
