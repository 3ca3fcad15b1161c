// SPDX-License-Identifier: GPL-3.0-or-later
// The faults of parts and of reduced files, told by `reducer`; skipped where that program is not built.
#include <cmath>

#include "common/program/version.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::reducer_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* beam_part = R"yaml(part: beam
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
sections: {tube: {shape: circle, radius: 0.03}}
points: {base: [0, 0, 0], tip: [2, 0, 0]}
beams: {spar: {from: base, to: tip, section: tube, material: steel, elements: 6}}
boundary: {base: all, tip: all}
modes: 2
)yaml";

class Reducer : public Folder {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(program("reducer"))) GTEST_SKIP() << "built without reducer";
    write_text(file("beam.part.yaml"), beam_part);
  }
  Outcome reducer(std::vector<std::string> words) const {
    words.insert(words.begin(), program("reducer"));
    return call(words, where);
  }
};

TEST_F(Reducer, FaultsOfAPartAreReportedAndLeaveNothing) {
  struct Fault {
    std::vector<std::string> settings, words;
  };
  const std::vector<Fault> faults = {
      {{"mods=3"}, {"unknown key 'mods'", "did you mean 'modes'?"}},
      {{"modes=three"}, {"modes", "'three'"}},
      {{"boundary={}"}, {"has no boundary node"}},
      {{"boundary={bse: all}"}, {"no point 'bse'", "did you mean 'base'?"}},
      {{"modes=1000"}, {"1000 internal modes asked for, but only 30 exist"}},  // 5 inner nodes with six each
      {{"points.tip=[0, 0, 0]"}, {"beam 'spar'", "zero length"}},
      {{"sections.tube.radius=-1", "materials.steel.density=-7850"},
       {"radius -1", "density -7850", "must be positive"}},
      {{"beams.spar.section=tub"}, {"no section 'tub'", "did you mean 'tube'?"}},
      {{"points.far=[0, 0, 1]", "points.end=[0, 0, 2]",
        "beams.loose={from: far, to: end, section: tube, material: steel, elements: 2}"},
       {"2 pieces that no element connects", "nearest nodes are far and base"}},
  };
  for (const Fault& fault : faults) {
    std::vector<std::string> words{"run", "beam.part.yaml"};
    for (const std::string& setting : fault.settings) words.insert(words.end(), {"--set", setting});
    expect_error(reducer(words), fault.words);
    EXPECT_FALSE(std::filesystem::exists(file("beam.superelement.h5")));
    EXPECT_FALSE(std::filesystem::exists(file("beam.certificate.json")));
  }
}

// As of `mechanism`; here gmsh has a process of its own, which is called through descriptors 3 and 4.
// A plate that takes some ten seconds.
TEST_F(Reducer, InterruptedLeavesNothingHalfWritten) {
  const Outcome outcome = call({"/usr/bin/timeout", "--preserve-status", "-s", "INT", "1", program("reducer"), "run",
                                std::string(TISSERAND_SOURCE_DIR) + "/tests/benchmarks/spider_plate.part.yaml", "--set",
                                "plates.sheet.elements=[200, 200]", "-o", file("plate.superelement.h5")},
                               where);
  EXPECT_EQ(outcome.code, 130) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("reducer: interrupted: no file was written or changed"));
  for (const std::string& name : names()) EXPECT_THAT(name, Not(HasSubstr("plate")));
}

TEST_F(Reducer, ClosedStreamsHarmNothing) {
  write_text(file("square.part.yaml"),
             "part: square\nunits: {length: mm, mass: t, time: s}\nmesh: {file: " + std::string(TISSERAND_SOURCE_DIR) +
                 "/meshes/square.step, size: 200}\n"
                 "materials: {steel: {E: 2.1e5, nu: 0.3, density: 7.85e-9}}\n"
                 "shells: {s: {on: face 1, thickness: 5, material: steel}}\n"
                 "boundary: {o: {near: [0, 0, 0]}}\nmodes: 2\n");
  const auto run = [&](const std::string& name, const std::string& streams) {
    return call({"/bin/sh", "-c", program("reducer") + " run square.part.yaml -o " + name + streams}, where);
  };
  const Outcome open = run("open.superelement.h5", "");
  ASSERT_EQ(open.code, 0) << open.error;
  ASSERT_EQ(run("closed.superelement.h5", " <&- >&- 2>&-").code, 0);
  EXPECT_EQ(formats::read_superelement(file("closed.superelement.h5")).superelement.content_id,
            formats::read_superelement(file("open.superelement.h5")).superelement.content_id);
}

// A cantilever with P = 100 at its tip, by `mechanism` with none and with both of the modes of the file: statics needs
// none. Stress at the clamp: P L r/I = 4 P L/(pi r^3).
TEST_F(Reducer, StressOfABodyWithFewerModesThanTheFile) {
  ASSERT_EQ(reducer({"run", "beam.part.yaml", "--set", "recovery=yes"}).code, 0);
  write_text(file("clamp.scene.yaml"), R"yaml(scene: clamp
analysis: statics
bodies: {beam: {type: superelement, file: beam.superelement.h5, second_order: off, modes: 0}}
joints: {clamp: {type: fixed, a: ground, b: beam/base}}
loads: {push: {type: force, at: beam/tip, value: [0, 0, -100]}}
)yaml");
  for (const char* modes : {"0", "2"}) {
    const Outcome run =
        mechanism({"run", "clamp.scene.yaml", "--set", "bodies.beam.modes=" + std::string(modes), "-o", "clamp.h5"});
    ASSERT_EQ(run.code, 0) << run.error;
    const Outcome fields = reducer({"recover", "beam.recovery.h5", "clamp.h5", "-o", "fields"});
    ASSERT_EQ(fields.code, 0) << fields.error;
    const std::string what = "largest stress of beams";
    const std::size_t at = fields.out.find(what);
    ASSERT_NE(at, std::string::npos) << fields.out;
    const double stress = 4.0 * 100.0 * 2.0 / (M_PI * std::pow(0.03, 3));
    EXPECT_NEAR(std::stod(fields.out.substr(at + what.size())), stress, 1e-5 * stress) << modes << " modes";
  }
}

TEST_F(Reducer, FilesOfOtherKindsAreNamed) {
  expect_error(reducer({"run", "arm.scene.yaml"}), {"arm.scene.yaml:1:", "a scene, not a part"});
  expect_error(reducer({"run", "se.superelement.h5"}), {"check that this is a text file"});
  expect_error(reducer({"run", "none.yaml"}), {"none.yaml", "No such file"});
  expect_error(reducer({"show", "arm.scene.yaml"}), {"is not an HDF5 file"});
  expect_error(reducer({"show", "none.h5"}), {"No such file"});
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5"}).code, 0);
  expect_error(reducer({"show", "arm.results.h5"}), {"tisserand-results"});
}

TEST_F(Reducer, OutputsAreLookedAtBeforeTheWork) {
  expect_error(reducer({"run", "beam.part.yaml", "-o", "none/x.h5"}), {"none/", "No such file"});
  expect_error(reducer({"run", "beam.part.yaml", "-o", "beam.part.yaml"}), {"replace its own input"});
  expect_error(reducer({"run", "beam.part.yaml", "-o", "arm.scene.yaml"}), {"other kinds of file"});
  expect_error(reducer({"run", "beam.part.yaml", "-o", "/dev/null"}), {"device"});
  expect_error(reducer({"mesh", "beam.part.yaml", "-o", "none/x.msh"}), {"none/", "No such file"});
  EXPECT_EQ(read_text(file("beam.part.yaml")), beam_part);
  Surroundings full = where;
  full.standard_output = "/dev/full";
  expect_error(call({program("reducer"), "show", "se.superelement.h5"}, full), {"standard output", "No space left"});
  where.file_size = 2000;
  expect_error(reducer({"run", "beam.part.yaml"}), {"beam.companion.h5", "cannot write the file"});
  for (const char* name : {"beam.superelement.h5", "beam.companion.h5", "beam.superelement.certificate.json"})
    EXPECT_FALSE(std::filesystem::exists(file(name))) << name;
}

// A circle of radius 0.03: area pi 0.0009.
TEST_F(Reducer, SectionPrintsTheConstants) {
  const Outcome outcome = reducer({"section", "beam.part.yaml"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("tube"), HasSubstr("0.00282743")));
  expect_error(reducer({"section", "beam.part.yaml", "--set", "sections.tube.radius=-1"}), {"radius -1"});
}

TEST_F(Reducer, UsageErrorsAreTwoAndHelpTeaches) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{}, {"shw"}, {"run"}, {"run", "beam.part.yaml", "--nope"}})
    EXPECT_EQ(reducer(words).code, 2);
  EXPECT_THAT(reducer({"shw"}).error, HasSubstr("there is no command 'shw'; did you mean 'show'?"));
  for (const char* command : {"run", "show", "mesh", "section"})
    EXPECT_THAT(reducer({command, "--help"}).out, HasSubstr(std::string("\n  reducer ") + command));
  EXPECT_THAT(reducer({"--help"}).out, AllOf(HasSubstr("Examples:"), HasSubstr("Exit codes:"), HasSubstr("Units")));
  EXPECT_THAT(reducer({"--version"}).out, HasSubstr("reducer " + version() + " (Tisserand)\ncommit "));
}

}  // namespace
}  // namespace tisserand::cli::reducer_test
