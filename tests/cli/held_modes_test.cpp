// SPDX-License-Identifier: GPL-3.0-or-later
// Modal bodies that a scene holds otherwise than their modes are: table B of the trials of November 2026, a rotor with
// the reference [x, y, z, rx] and [y, z] whose slopes the scene clamps.
#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::held_modes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* rotor_part = R"yaml(part: rotor
units: {length: m, mass: kg, time: s}
materials: {st: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {s: {A: 0.00125663706144, Iy: 1.25663706144e-07, Iz: 1.25663706144e-07, J: 2.51327412287e-07, shear_area_y: 0.00113097335529, shear_area_z: 0.00113097335529}}
points: {l: [0, 0, 0], c: [0.4, 0, 0], r: [1.2, 0, 0]}
beams: {a: {from: l, to: c, section: s, material: st, elements: 8}, b: {from: c, to: r, section: s, material: st, elements: 16}}
boundary: [l, c, r]
modes: 12
modal_body: {reference: {l: [x, y, z, rx], r: [y, z]}, modes: 10}
)yaml";

class HeldModes : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
    where.folder = folder.path().string();
    write_text(folder.file("rotor.part.yaml"), rotor_part);
  }
  void reduce(const std::string& setting) const {
    const Outcome outcome = call({program("reducer"), "run", "rotor.part.yaml", "--set", setting}, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  /// What `mechanism run` prints of the rotor with these joints; `more`: of the body, or of the scene.
  std::string run(const std::string& joints, const std::string& of_body = "", const std::string& more = "",
                  const std::string& file = "modal, file: rotor.modal.h5") const {
    write_text(folder.file("r.scene.yaml"),
               "scene: rotor\nunits: {length: m, mass: kg, time: s}\nbodies:\n  sh: {type: " + file + of_body +
                   "}\n  disc: {type: rigid, mass: 20, inertia: [0.55, 0.3, 0.3], pose: {position: [0.4, 0, 0]}}\n" +
                   "joints:\n  weld: {type: fixed, a: sh/c, b: disc}\n" + joints + more +
                   "analysis: modes\nmodes: {count: 4}\n");
    const Outcome outcome = call({program("mechanism"), "run", "r.scene.yaml"}, where);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    return outcome.out;
  }
  static double reported(const std::string& text, const std::string& what) {
    const std::size_t at = text.find(what);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + what.size()));
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

const std::string clamped =
    "  l: {type: fixed, a: ground, b: sh/l}\n  r: {type: generic, hold: [y, z, ry, rz], a: ground, b: sh/r}\n";
const std::string pinned =
    "  l: {type: generic, hold: [x, y, z, rx], a: ground, b: sh/l}\n"
    "  r: {type: generic, hold: [y, z], a: ground, b: sh/r}\n";

// A clamped bar of 1.2 m without shear: 22.373/(2 π L²) √(EI/ρA) = 128.3 Hz, less the rotary inertia of its sections.
// By the modes of the pinned one, a third too much with 10, and 8 % with 60.
TEST_F(HeldModes, OfARotorWhoseSlopesTheSceneClampsAreTooFew) {
  const double bar =
      22.3733 / (2.0 * std::numbers::pi * 1.44) * std::sqrt(2.1e11 * 1.25663706e-7 / (7800.0 * 1.25663706e-3));
  double before = 1e9;
  for (const char* modes : {"10", "30", "60"}) {
    reduce(std::string("modal_body={reference: {l: [x, y, z, rx], r: [y, z]}, modes: ") + modes + "}");
    const std::string text = run(clamped);
    EXPECT_THAT(text, AllOf(HasSubstr("modal body 'sh' is too stiff"),
                            HasSubstr("at 'l' (rotations y, z), 'r' (rotations y, z), but the `reference`"),
                            HasSubstr("Use more modes, a `reference`")));
    EXPECT_NEAR(reported(text, "static flexibility there, its first frequency is"), bar, 0.01 * bar) << modes;
    const double by_modes = reported(text, "has its first frequency at");
    EXPECT_GT(by_modes, 1.05 * bar);
    EXPECT_LT(by_modes, before);
    before = by_modes;
  }
  EXPECT_THAT(run(clamped, "", "effects: {flexibility: off}\n"), Not(HasSubstr("too stiff")));
  EXPECT_THAT(run(clamped, ", modes: 2"), HasSubstr("too stiff"));
  EXPECT_THAT(run(clamped, ", mirror: xz"), HasSubstr("'l' (rotations y, z), 'r' (rotations y, z)"));
}

// A reference that holds what the scene holds needs no more modes; nor does one that is held as it is, in the plane, in
// other units, or whose further joints are to moving bodies; nor a superelement, nor a body with many modes.
TEST_F(HeldModes, ThatAreEnoughAreNotSpokenOf) {
  const std::string still = "too stiff";
  reduce("modal_body={reference: {l: [x, y, z, rx], r: [y, z]}, modes: 3}");
  EXPECT_THAT(run(pinned), Not(HasSubstr(still)));
  EXPECT_THAT(run("  l: {type: spherical, a: ground, b: sh/l}\n"), Not(HasSubstr(still)));
  EXPECT_THAT(run(""), Not(HasSubstr(still)));
  EXPECT_THAT(run(clamped, "", "", "superelement, file: rotor.superelement.h5"), Not(HasSubstr(still)));
  // The rod of a slider-crank: a guide on the ground and a pin on a crank, as the reference holds it.
  EXPECT_THAT(run("  guide: {type: generic, hold: [y, z, rx], a: ground, b: sh/r}\n"
                  "  crank: {type: revolute, a: ground, b: k, axis: [0, 0, 1]}\n"
                  "  pin: {type: spherical, a: k/o, b: sh/l}\n",
                  "}\n  k: {type: rigid, mass: 1, inertia: [1, 1, 1], pose: {position: [0, -1, 0]}, nodes: {o: "
                  "{position: [0, 1, 0]}}"),
              Not(HasSubstr(still)));
  reduce("modal_body={reference: l, modes: 3}");
  EXPECT_THAT(run("  l: {type: fixed, a: ground, b: sh/l}\n"), Not(HasSubstr(still)));
}

}  // namespace
}  // namespace tisserand::cli::held_modes_test
