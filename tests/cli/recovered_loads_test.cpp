// SPDX-License-Identifier: GPL-3.0-or-later
// Stress of modal bodies, of bodies that load each other, and of load cases, end to end: reduced, run, recovered,
// against closed forms. What few modes hold of it must not matter.
#include <cmath>
#include <filesystem>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::recovered_loads_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// A square bar of 1 m, 20 mm x 20 mm, along x, of 20 elements; with an element of its loads held at a.
constexpr const char* bar_part = R"yaml(part: bar
units: {length: m, mass: kg, time: s}
recovery: yes
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {r: {shape: rectangle, width: 0.02, height: 0.02}}
points: {a: [0, 0, 0], b: [1, 0, 0]}
beams: {x: {from: a, to: b, section: r, material: steel, elements: 20}}
boundary: [a, b]
modes: 2
load_cases: {snow: {line_loads: {x: [0, 0, -500]}}, pull: {line_loads: {x: [2000, 0, 0]}}}
modal_body: {reference: a, modes: 3}
)yaml";
constexpr double density = 7800.0, g = 9.81, A = 4e-4, W = 8e-6 / 6.0, elements = 20.0, h = 1.0 / elements;

class RecoveredLoads : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
    where.folder = folder.path().string();
    write_text(folder.file("bar.part.yaml"), bar_part);
  }

  void reduce(const std::vector<std::string>& settings) const {
    std::vector<std::string> words{program("reducer"), "run", "bar.part.yaml"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  void run(const std::string& scene, const std::vector<std::string>& settings = {}) const {
    write_text(folder.file("run.scene.yaml"), scene);
    std::vector<std::string> words{program("mechanism"), "run", "run.scene.yaml", "-o", "run.results.h5"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error << scene;
  }
  std::string recover(const std::string& file, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{program("reducer"), "recover", file, "run.results.h5", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = call(words, where);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    return outcome.out;
  }
  /// The number behind `what` in the lines of recover.
  static double reported(const std::string& text, const std::string& what) {
    const std::size_t at = text.find(what);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + what.size()));
  }
  static double stress(const std::string& text) { return reported(text, "largest stress of beams"); }
  static double missing(const std::string& text) { return reported(text, "the remaining error is estimated at"); }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

/// "bodies: {c: {type: modal, file: bar.modal.h5}}" and what follows.
std::string modal_scene(const std::string& rest, const std::string& more = "") {
  return "scene: modal\nunits: {length: m, mass: kg, time: s}\nbodies: {c: {type: modal, file: bar.modal.h5" + more +
         "}}\n" + rest;
}

const std::vector<std::string> references{"modal_body={reference: a, modes: 3}", "modal_body={reference: a, modes: 8}",
                                          "modal_body={reference: mean_axis, modes: 3}",
                                          "modal_body={reference: {a: [x, y, z, rx], b: [y, z]}, modes: 2}"};

// N/A = ρ Ω² L²/2 = 39 MPa at the hub: lumped masses have it exactly, ρ A Ω² h² (1 + ... + (n - 1) + n/2). It had been
// 0 without a mode along the bar, 40.3 and 34.8 MPa with 20 modes. A mean axis knows no hub: the joint pulls at its
// node.
TEST_F(RecoveredLoads, OfASpinningModalBodyDoesNotDependOnItsModes) {
  const std::string turning = R"yaml(joints: {hub: {type: revolute, a: ground, b: c/a, axis: [0, 0, 1]}}
motions: {turn: {coordinate: hub, value: 100*t}}
analysis: statics
statics: {rotation: {angular_velocity: [0, 0, 100]}}
)yaml";
  for (const std::string& reference : references) {
    reduce({reference});
    for (const char* setting : {"", ", mirror: yz", ", modes: 1"}) {
      run(modal_scene(turning, setting));
      const std::string text = recover("bar.modal.recovery.h5");
      EXPECT_NEAR(stress(text), 39.0e6, 1e-3 * 39.0e6) << reference << setting << text;
      EXPECT_THAT(text, AllOf(HasSubstr("inertia, weight and forces at its nodes"), Not(HasSubstr("note"))));
      if (std::string(setting).find("modes") == std::string::npos) {  // error (Ω/ω)²
        EXPECT_LT(missing(text), 0.15 * 39.0e6) << reference << text;
      }
    }
  }
}

// A bar that hangs: ρ g L at the top, of lumped masses less the half of the first element. A cantilever under its
// weight: M/W = ρ A g L²/(2 W), of lumped masses exactly.
TEST_F(RecoveredLoads, OfAModalBodyUnderItsWeightIsThatOfStatics) {
  const std::string hanging =
      "gravity: [9.81, 0, 0]\njoints: {top: {type: fixed, a: ground, b: c/a}}\nanalysis: statics\n";
  const std::string across =
      "gravity: [0, 0, -9.81]\njoints: {wall: {type: fixed, a: ground, b: c/a}}\nanalysis: statics\n";
  const double top = density * g * (1.0 - 0.5 * h), clamp = density * A * g / 2.0 / W;
  for (const std::string& reference : references) {
    reduce({reference});
    run(modal_scene(hanging));
    const std::string text = recover("bar.modal.recovery.h5");
    EXPECT_NEAR(stress(text), top, 1e-5 * top) << reference << text;
    EXPECT_LT(missing(text), 1e-6 * top);
    run(modal_scene(across));
    EXPECT_NEAR(stress(recover("bar.modal.recovery.h5")), clamp, 2e-3 * clamp) << reference;
    run(modal_scene(across + "effects: {gravity: off}\n"));
    EXPECT_NEAR(stress(recover("bar.modal.recovery.h5")), 0.0, 1e-3 * clamp) << reference;
  }
}

// Forces at nodes that the reference leaves free, too small to bend the bar by much: F L/W and N/A of a force at the
// tip; a second modal body on a hinge at the tip pulls with its weight.
TEST_F(RecoveredLoads, OfAModalBodyThatAnotherLoadsIsThatOfStatics) {
  const std::string pushed = R"yaml(joints: {wall: {type: fixed, a: ground, b: c/a}}
loads: {push: {type: force, at: c/b, value: [3, 0, -0.2]}}
analysis: statics
)yaml";
  const std::string carried = R"yaml(scene: carried
units: {length: m, mass: kg, time: s}
gravity: [0, 0, -9.81]
bodies:
  c: {type: modal, file: bar.modal.h5}
  d: {type: modal, file: bar.modal.h5, pose: {position: [1, 0, 0], orientation: {axis: [0, 1, 0], angle_deg: 90}}}
joints:
  wall: {type: fixed, a: ground, b: c/a}
  pin: {type: revolute, a: c/b, b: d/a, axis: [0, 1, 0]}
analysis: statics
)yaml";
  const double push = 0.2 / W + 3.0 / A, mass = density * A, carry = mass * g * 1.5 / W;
  for (const std::string& reference : references) {
    reduce({reference});
    run(modal_scene(pushed));
    const std::string text = recover("bar.modal.recovery.h5");
    EXPECT_NEAR(stress(text), push, 2e-3 * push) << reference << text;
    run(carried);
    EXPECT_NEAR(stress(recover("bar.modal.recovery.h5", {"--body", "c"})), carry, 2e-3 * carry) << reference;
    const double hung = density * g * (1.0 - 0.5 * h);
    EXPECT_NEAR(stress(recover("bar.modal.recovery.h5", {"--body", "d"})), hung, 2e-2 * hung) << reference;
  }
}

// In the plane, in other units: the same forces on the nodes.
TEST_F(RecoveredLoads, OfAModalBodyInThePlaneAndInOtherUnits) {
  reduce({"modal_body={reference: mean_axis, modes: 4}"});
  const std::string scene = R"yaml(scene: planar
units: {length: mm, mass: t, time: s}
gravity: [0, 0, -9810]
bodies: {c: {type: modal, file: bar.modal.h5}}
joints: {wall: {type: fixed, a: ground, b: c/a}}
loads: {push: {type: force, at: c/b, value: [3, 0, -0.2]}}
analysis: statics
)yaml";
  const double exact = 1e-6 * (3.0 / A + (0.2 + density * A * g / 2.0) / W);
  for (const char* planar : {"", "effects: {planar: on}\n"}) {
    run(scene + planar);
    EXPECT_NEAR(stress(recover("bar.modal.recovery.h5")), exact, 2e-3 * exact) << planar;
  }
}

// Two bars end to end that turn about the first one's end: ρ Ω² (R² - x²)/2, the mean over an element; with a force of
// 40 kN along them at the outer end. And a bar that carries another on a pin.
TEST_F(RecoveredLoads, OfASuperelementThatAnotherLoadsIsThatOfTheBeam) {
  const std::string turning = R"yaml(scene: two bars
units: {length: m, mass: kg, time: s}
bodies:
  c: {type: superelement, file: bar.superelement.h5}
  d: {type: superelement, file: bar.superelement.h5, pose: {position: [1, 0, 0]}}
joints:
  hub: {type: revolute, a: ground, b: c/a, axis: [0, 0, 1]}
  weld: {type: fixed, a: c/b, b: d/a}
motions: {turn: {coordinate: hub, value: 100*t}}
loads: {pull: {type: force, axes: body, at: d/b, value: [40000, 0, 0]}}
analysis: statics
statics: {rotation: {angular_velocity: [0, 0, 100]}}
)yaml";
  const std::string carried = R"yaml(scene: carried
units: {length: m, mass: kg, time: s}
gravity: [0, 0, -9.81]
bodies:
  c: {type: superelement, file: bar.superelement.h5, second_order: off}
  d: {type: superelement, file: bar.superelement.h5, pose: {position: [1, 0, 0], orientation: {axis: [0, 1, 0], angle_deg: 90}}}
joints:
  wall: {type: fixed, a: ground, b: c/a}
  pin: {type: revolute, a: c/b, b: d/a, axis: [0, 1, 0]}
loads: {push: {type: force, at: c/b, value: [0, 0, -10]}}
analysis: statics
)yaml";
  const double spin = density * 1e4 / 2.0, pull = 40000.0 / A;
  for (const char* modes : {"modes=0", "modes=2", "modes=12"}) {
    reduce({modes});
    run(turning);
    const double inner = spin * (4.0 - h * h / 3.0) + pull, outer = spin * (3.0 - h - h * h / 3.0) + pull;
    EXPECT_NEAR(stress(recover("bar.recovery.h5", {"--body", "c"})), inner, 2e-3 * inner) << modes;
    EXPECT_NEAR(stress(recover("bar.recovery.h5", {"--body", "d"})), outer, 2e-3 * outer) << modes;
    run(carried);
    // A beam element knows loads at its nodes: q h²/12 less at the clamp.
    const double q = density * A * g, clamp = (q * 1.5 + 10.0 - q * h * h / 12.0) / W;
    EXPECT_NEAR(stress(recover("bar.recovery.h5", {"--body", "c"})), clamp, 1e-3 * clamp) << modes;
  }
}

/// A superelement of the bar under one of its load cases.
std::string loaded_scene(const std::string& joints, const std::string& load_case, const std::string& value = "1") {
  return R"yaml(scene: loaded
units: {length: m, mass: kg, time: s}
bodies: {c: {type: superelement, file: bar.superelement.h5}}
loads: {load: {type: part_load, body: c, case: )yaml" +
         load_case + ", value: \"" + value + "\"}}\n" + joints;
}

const std::string clamped = "joints: {l: {type: fixed, a: ground, b: c/a}, r: {type: fixed, a: ground, b: c/b}}\n";
const std::string simply = R"yaml(joints:
  l: {type: revolute, a: ground, b: c/a, axis: [0, 1, 0]}
  r: {type: generic, hold: [y, z], a: ground, b: c/b}
)yaml";
const std::string at_rest = "analysis: statics\n";

// A hundredth of the loads, so that the bar does not stretch between its clamps: q L²/12 at the clamps, q L²/8 in the
// middle of simple supports, q L/2 of a pull along the bar, with no internal mode as with many. Of distributed loads a
// beam element knows those at its nodes: q h²/12 of moment, q h/2 of force.
TEST_F(RecoveredLoads, OfLoadCasesDoesNotDependOnTheModes) {
  const double q = 5.0, ends = q * (1.0 - h * h) / 12.0 / W, middle = q * (1.0 / 8.0 + h * h / 12.0) / W;
  const double pulled = 20.0 * (0.5 - h / 2.0) / A;
  for (const std::vector<std::string>& basis : {std::vector<std::string>{"modes=0"},
                                                {"modes=2"},
                                                {"modes=12"},
                                                {"modes=2", "moments=6"},
                                                {"modes=4", "method=rubin"}}) {
    reduce(basis);
    std::vector<std::string> settings{"bodies.c.mirror=yz"};
    if (basis.back() == "modes=12")
      settings.insert(settings.end(), {"bodies.c.mirror=xy", "bodies.c.second_order=off", "bodies.c.frame=karcher",
                                       "bodies.c.modes=0"});
    for (const std::string& setting : settings) {
      run(loaded_scene(clamped + at_rest, "snow", "0.01"), {setting});
      const std::string text = recover("bar.recovery.h5");
      EXPECT_NEAR(stress(text), ends, 1e-4 * ends) << basis.back() << setting << text;
      EXPECT_THAT(text, AllOf(HasSubstr("inertia, weight and load cases"), Not(HasSubstr("note"))));
      EXPECT_LT(missing(text), 1e-6 * ends);
      run(loaded_scene(clamped + at_rest, "pull", "0.01"), {setting});
      EXPECT_NEAR(stress(recover("bar.recovery.h5")), pulled, 1e-4 * pulled) << basis.back() << setting;
      run(loaded_scene(simply + at_rest, "snow", "0.01"), {setting, "bodies.c.second_order=off"});
      EXPECT_NEAR(stress(recover("bar.recovery.h5")), middle, 1e-4 * middle) << basis.back() << setting;
    }
  }
}

// In mm and t; two loads with the same load case add; a factor that grows slowly to 0.02 (106 Hz is the first
// frequency).
TEST_F(RecoveredLoads, OfLoadCasesFollowsTheirFactor) {
  const double q = 5.0, ends = q * (1.0 - h * h) / 12.0 / W;
  const std::string more = R"yaml(scene: loaded
units: {length: mm, mass: t, time: s}
bodies: {c: {type: superelement, file: bar.superelement.h5}}
loads:
  one: {type: part_load, body: c, case: snow, value: 0.01}
  two: {type: part_load, body: c, case: snow, value: 0.005}
)yaml";
  for (const char* modes : {"modes=0", "modes=3"}) {
    reduce({modes});
    run(more + clamped + at_rest);
    EXPECT_NEAR(stress(recover("bar.recovery.h5")), 1.5e-6 * ends, 1.5e-10 * ends) << modes;
    run(loaded_scene(clamped, "snow", "step5(t, 0, 0, 0.4, 0.02)") + "integrator: {step: 0.002, end: 0.4}\n");
    EXPECT_NEAR(stress(recover("bar.recovery.h5", {"--times", "0.2"})), ends, 2e-3 * ends) << modes;
    const std::string text = recover("bar.recovery.h5");
    EXPECT_NEAR(stress(text), 2.0 * ends, 2e-3 * ends) << modes;
    EXPECT_LT(missing(text), 0.02 * ends) << text;
  }
}

// Load cases for other programs hold them, so the forces cancel; in the plane they are those of space.
TEST_F(RecoveredLoads, OfLoadCasesIsThatOfOtherProgramsAndOfThePlane) {
  const double middle = 5.0 * (1.0 / 8.0 + h * h / 12.0) / W;
  reduce({"modes=2"});
  run(loaded_scene(clamped + at_rest, "snow", "0.01"));
  const std::string text = recover("bar.recovery.h5", {"--loads", "nastran"});
  EXPECT_LT(reported(text, "relative to all loads: "), 1e-7) << text;  // residual force over the size of all
  run(loaded_scene(simply + at_rest + "effects: {planar: on}\n", "snow", "0.01"), {"bodies.c.second_order=off"});
  EXPECT_NEAR(stress(recover("bar.recovery.h5")), middle, 1e-4 * middle);
}

// Files of versions 1.2 and 1.10 (tests/compatibility): what the stress lacks is said, as before; with one new file of
// two, too. Modal bodies had nothing added, and nothing was said.
TEST_F(RecoveredLoads, FilesOfBeforeAreReadWithNotes) {
  const fs::path before = TISSERAND_SOURCE_DIR "/tests/compatibility";
  for (const char* name : {"loaded.scene.yaml", "loaded.superelement.h5", "loaded.companion.h5", "loaded.recovery.h5"})
    fs::copy_file(before / name, folder.file(name));
  const auto text_of = [&](const std::string& recovery, const std::string& results) {
    const Outcome outcome = call({program("reducer"), "recover", recovery, results, "-o", "out"}, where);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    return outcome.out;
  };
  const std::string old_recovery = before / "loaded_1.2.recovery.h5", old_results = before / "loaded_1.10.results.h5";
  EXPECT_THAT(text_of(old_recovery, old_results), AllOf(HasSubstr("('snow')"), HasSubstr("before version 1.11")));
  EXPECT_THAT(text_of(folder.file("loaded.recovery.h5"), old_results), HasSubstr("before version 1.11"));
  const Outcome outcome = call({program("mechanism"), "run", "loaded.scene.yaml", "-o", "run.results.h5"}, where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(text_of(old_recovery, folder.file("run.results.h5")),
              AllOf(HasSubstr("no static answers"), HasSubstr("Reduce the part again")));
  EXPECT_THAT(text_of(folder.file("loaded.recovery.h5"), folder.file("run.results.h5")), Not(HasSubstr("note")));
  const std::string modal = text_of(before / "loaded_1.2.modal.recovery.h5", before / "loaded_modal_1.10.results.h5");
  EXPECT_THAT(modal, HasSubstr("no static answers to inertia loads"));
}

}  // namespace
}  // namespace tisserand::cli::recovered_loads_test
