// SPDX-License-Identifier: GPL-3.0-or-later
// What somebody meets who starts: files in the wrong place, units, remedies that fit the file, and where outputs lie.
#include <filesystem>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::first_contact_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class FirstContact : public Folder {
 protected:
  void SetUp() override {
    if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  }
  Outcome reducer(std::vector<std::string> words) const {
    words.insert(words.begin(), program("reducer"));
    return call(words, where);
  }
  /// Copies a file of the sources here.
  void fetch(const std::string& name) const {
    fs::copy_file(fs::path(TISSERAND_SOURCE_DIR) / name, file(fs::path(name).filename().string()));
  }
};

TEST_F(FirstContact, FilesThatAreNoPartFileSayWhichToWrite) {
  fetch("meshes/bracket.step");
  fetch("meshes/plate.bdf");
  const Outcome cad = reducer({"run", "bracket.step"}), deck = reducer({"solve", "plate.bdf"});
  EXPECT_EQ(cad.code, 1);
  EXPECT_THAT(cad.error,
              AllOf(HasSubstr("bracket.step: this is a geometry, not a part file"),
                    HasSubstr("write a part file bracket.part.yaml in its folder, with `mesh: {file: bracket.step}`"),
                    HasSubstr("`reducer groups` and `reducer view` read this file directly")));
  EXPECT_EQ(deck.code, 1);
  EXPECT_THAT(deck.error, AllOf(HasSubstr("this is a deck"), HasSubstr("`mesh: {file: plate.bdf}`")));
}

TEST_F(FirstContact, UnitsOfAFileAreThoseThatItNames) {
  fetch("meshes/bracket.step");
  fetch("meshes/plate.bdf");
  EXPECT_THAT(reducer({"groups", "bracket.step"}).out, HasSubstr("lengths in mm; "));
  EXPECT_THAT(reducer({"groups", "plate.bdf"}).out,
              HasSubstr("lengths in units of the file (it does not name them); "));
}

// The trials' plate of one row of elements: its mesh is too coarse, and no `size` makes it finer.
TEST_F(FirstContact, MeshesOfOtherProgramsAreRefinedThere) {
  fetch("tests/verification/references/trials/mixed_normals.part.yaml");
  fetch("tests/verification/references/trials/mixed_normals.msh");
  const Outcome run = reducer({"run", "mixed_normals.part.yaml"});
  EXPECT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out + run.error,
              AllOf(HasSubstr("refine mixed_normals.msh in the program that made it"), Not(HasSubstr("`size`"))));
}

TEST_F(FirstContact, OutputsLieBesideWhatTheyAreMadeOf) {
  fs::create_directory(file("a"));
  write_text(file("a/bar.part.yaml"), R"yaml(part: bar
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {rod: {shape: rectangle, width: 0.02, height: 0.02}}
points: {base: [0, 0, 0], tip: [2, 0, 0]}
beams: {axis: {from: base, to: tip, section: rod, material: steel, elements: 4}}
boundary: [base, tip]
modes: 2
)yaml");
  write_text(file("a/bar.scene.yaml"), R"yaml(scene: bar
gravity: [0, 0, -9.81]
bodies: {bar: {type: superelement, file: bar.superelement.h5}}
joints: {hinge: {type: revolute, a: ground, b: bar/base, axis: [0, 1, 0]}}
integrator: {step: 0.005, end: 0.01}
)yaml");
  mechanism({"--version"});  // leaves what it said
  const std::vector<std::string> before = names();
  EXPECT_EQ(reducer({"run", "a/bar.part.yaml"}).code, 0);
  EXPECT_EQ(mechanism({"run", "a/bar.scene.yaml"}).code, 0);
  EXPECT_EQ(mechanism({"view", "a/bar.results.h5"}).code, 0);
  for (const char* name : {"a/bar.superelement.h5", "a/bar.companion.h5", "a/bar.results.h5", "a/bar.html"})
    EXPECT_TRUE(fs::exists(file(name))) << name;
  EXPECT_EQ(names(), before) << "something was written into the working folder";
  EXPECT_EQ(mechanism({"run", "a/bar.scene.yaml", "-o", "here.results.h5"}).code, 0);
  EXPECT_TRUE(fs::exists(file("here.results.h5")));
}

}  // namespace
}  // namespace tisserand::cli::first_contact_test
