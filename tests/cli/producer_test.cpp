// SPDX-License-Identifier: GPL-3.0-or-later
// Every written file names the program and version that wrote it. Tables of numbers (CSV) hold numbers alone.
#include <gtest/gtest.h>

#include "common/child.hpp"
#include "common/program/version.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::producer_test {
namespace {

using ::testing::HasSubstr;

class Producer : public Folder {
 protected:
  Outcome reducer(std::vector<std::string> words) const {
    words.insert(words.begin(), program("reducer"));
    return call(words, where);
  }
  void expect_named(const std::vector<std::string>& files, const std::string& program) const {
    for (const std::string& name : files) EXPECT_THAT(read_text(file(name)), HasSubstr(producer(program))) << name;
  }
};

TEST_F(Producer, IsInWhatMechanismWrites) {
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "--set", "checkpoint.every=5"}).code, 0);
  ASSERT_EQ(mechanism({"view", "arm.results.h5", "-o", "arm.html"}).code, 0);
  ASSERT_EQ(mechanism({"view", "arm.results.h5", "--paraview", "out"}).code, 0);
  expect_named({"arm.results.h5", "arm.checkpoint.h5", "arm.html", "out/arm.pvd"}, "mechanism");
  if (!is_program("gnuplot")) GTEST_SKIP() << "not tested: there is no gnuplot here (apt-get install gnuplot-nox)";
  for (const std::string picture : {"z.png", "z.svg", "z.pdf", "z.eps"}) {
    const Outcome plot = mechanism({"plot", "arm.results.h5", "-c", "nodes/position/rod/end/z", "-o", picture});
    EXPECT_EQ(plot.code, 0) << plot.error;
    expect_named({picture}, "mechanism");
  }
}

TEST_F(Producer, IsInWhatReducerWrites) {
  if (!std::filesystem::exists(program("reducer"))) GTEST_SKIP() << "built without reducer";
  write_text(file("beam.part.yaml"), R"yaml(part: beam
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
sections: {tube: {shape: circle, radius: 0.03}}
points: {base: [0, 0, 0], tip: [2, 0, 0]}
beams: {spar: {from: base, to: tip, section: tube, material: steel, elements: 6}}
boundary: {base: all, tip: all}
supports: {base: all}
load_cases: {push: {forces: {tip: [0, 0, 1]}}}
modes: 2
recovery: yes
)yaml");
  const Outcome run = reducer({"run", "beam.part.yaml"});
  ASSERT_EQ(run.code, 0) << run.error;
  const Outcome solve = reducer({"solve", "beam.part.yaml", "-o", "beam"});
  ASSERT_EQ(solve.code, 0) << solve.error;
  ASSERT_EQ(reducer({"view", "beam.part.yaml", "-o", "beam.html"}).code, 0);
  std::vector<std::string> files;
  for (const std::string& name : names())
    if (name.starts_with("beam") && !name.ends_with(".yaml") && !name.ends_with(".csv")) files.push_back(name);
  EXPECT_GE(files.size(), 6u) << "superelement, companion, certificate, recovery, deformation, page";
  expect_named(files, "reducer");
}

}  // namespace
}  // namespace tisserand::cli::producer_test
