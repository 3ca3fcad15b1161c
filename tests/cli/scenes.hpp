// SPDX-License-Identifier: GPL-3.0-or-later
// A folder with a small scene, a superelement and results, in which the tests of the command lines work.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "formats/superelement/superelement.hpp"
#include "tests/cli/programs.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::cli {

/// A beam on a hinge with a block at its end, and a superelement beside it that nothing holds.
constexpr const char* arm_scene = R"yaml(scene: arm
gravity: [0, 0, -9.81]
materials:
  steel: {E: 2.1e11, nu: 0.3, density: 7800}
sections:
  bar: {shape: circle, radius: 0.01}
bodies:
  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 2, section: bar, material: steel}
  block: {type: rigid, mass: 2, inertia: [0.01, 0.02, 0.02], nodes: {hook: {position: [0, 0, 0.1]}}, pose: {position: [1, 0, -0.1]}}
  se: {type: superelement, file: se.superelement.h5}
joints:
  hinge: {type: revolute, a: ground, b: rod/start, axis: [0, 1, 0]}
  weld: {type: fixed, a: rod/end, b: block/hook}
loads:
  push: {type: force, at: rod/end, value: [0, 0, "sin(t)"]}
integrator: {step: 0.01, end: 0.1}
)yaml";

class Folder : public ::testing::Test {
 protected:
  Folder() {
    write_text(file("arm.scene.yaml"), arm_scene);
    formats::Superelement element = test_support::beam_superelement(test_support::BeamData{});
    formats::write_superelement(file("se.superelement.h5"), element);
    where.folder = folder.path().string();
  }

  std::string file(const std::string& name) const { return folder.file(name); }

  Outcome mechanism(std::vector<std::string> words) const {
    words.insert(words.begin(), program("mechanism"));
    return call(words, where);
  }
  /// `command` on the scene with values changed.
  Outcome with(const std::string& command, const std::vector<std::string>& settings) const {
    std::vector<std::string> words{command, "arm.scene.yaml"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    return mechanism(words);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      list.push_back(entry.path().filename());
    std::sort(list.begin(), list.end());
    return list;
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

/// An error for the user: code 1, all the words, one line per error with its remedy, no fault of ours, nothing on
/// stdout.
inline void expect_error(const Outcome& outcome, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.error;
  for (const std::string& word : words) EXPECT_THAT(outcome.error, ::testing::HasSubstr(word));
  EXPECT_THAT(outcome.error, ::testing::Not(::testing::HasSubstr("internal error")));
  EXPECT_THAT(outcome.error, ::testing::Not(::testing::HasSubstr("terminate called")));
}

}  // namespace tisserand::cli
