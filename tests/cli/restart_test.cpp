// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that go on from a file with a scene that has changed since.
#include <filesystem>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::restart_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// The pendulum of the trial `restart_changed`, run to t = 1 with its checkpoint.
class Restart : public ::testing::Test {
 protected:
  void SetUp() override {
    where.folder = folder.path().string();
    take("tests/verification/references/trials/restart_changed.scene.yaml", "pendulum.scene.yaml");
    ASSERT_EQ(run({}).code, 0);
  }
  void take(const std::string& from, const std::string& as) const {
    fs::copy_file(fs::path(TISSERAND_SOURCE_DIR) / from, folder.file(as), fs::copy_options::overwrite_existing);
  }
  Outcome run(const std::vector<std::string>& words) const {
    std::vector<std::string> all{program("mechanism"), "run", "pendulum.scene.yaml"};
    all.insert(all.end(), words.begin(), words.end());
    return call(all, where);
  }
  Outcome go_on(const std::string& from, std::vector<std::string> words) const {
    words.insert(words.begin(), {"--set", "integrator.end=1.5", "--restart", from});
    return run(words);
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

const std::vector<std::string> sources{"pendulum.checkpoint.h5", "pendulum.results.h5"};

TEST_F(Restart, ListsWhatChangedAndAsks) {
  for (const std::string& source : sources) {
    const std::vector<std::string> changed{"--set", "bodies.arm.mass=20", "--set", "gravity.2=9.81",
                                           "-o",    "rest.results.h5"};
    const Outcome refused = go_on(source, changed);
    expect_error(refused, {source + ": belongs to a scene that differs in 2 values:", "gravity.2: -9.81 -> 9.81",
                           "bodies.arm.mass: 2 -> 20", "--changed"});
    EXPECT_FALSE(fs::exists(folder.file("rest.results.h5")));
    std::vector<std::string> accepted = changed;
    accepted.emplace_back("--changed");
    const Outcome outcome = go_on(source, accepted);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("continues with 2 values changed since " + source),
                                   HasSubstr("bodies.arm.mass: 2 -> 20"), HasSubstr("gravity.2: -9.81 -> 9.81")));
    fs::remove(folder.file("rest.results.h5"));
  }
}

TEST_F(Restart, AppendedRunsAskToo) {
  const std::string before = read_text(folder.file("pendulum.results.h5"));
  for (const std::string& source : sources) {
    const Outcome moved = go_on(source, {"--append", "--set", "joints.hinge.position=[0.1, 0, 0]"});
    expect_error(moved, {"joints.hinge.position.0: nothing -> 0.1", "--changed"});
    EXPECT_EQ(read_text(folder.file("pendulum.results.h5")), before);
  }
  const Outcome accepted =
      go_on("pendulum.checkpoint.h5", {"--append", "--changed", "--set", "joints.hinge.position=[0, 0, 0]"});
  EXPECT_EQ(accepted.code, 0) << accepted.error;
}

TEST_F(Restart, SettingsAndOutputsAreNoChange) {
  for (const std::string& source : sources) {
    const Outcome outcome =
        go_on(source, {"-o", "rest.results.h5", "--set", "integrator.step=0.002", "--set", "integrator.tolerance=1e-9",
                       "--set", "integrator.linear_solver=dense", "--set", "output.every=5", "--set",
                       "channels={tip: {type: position, of: arm, axis: z}}", "--set", "checkpoint.every=50"});
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_THAT(outcome.out, Not(HasSubstr("changed")));
  }
}

TEST_F(Restart, OtherBodiesAreListedAndRefusedAlways) {
  const Outcome outcome = go_on("pendulum.checkpoint.h5", {"-o", "rest.results.h5", "--changed", "--set",
                                                           "bodies.bob={type: rigid, mass: 1, inertia: [1, 1, 1]}"});
  expect_error(outcome,
               {"whose bodies, joints, superelements or companion files differ", "bodies.bob.mass: nothing -> 1"});
  EXPECT_THAT(outcome.error, Not(HasSubstr("--changed")));
}

TEST_F(Restart, TablesCountByTheirContents) {
  write_text(folder.file("push.csv"), "time,value\n0,0\n2,1\n");
  const std::vector<std::string> load{"--set", "inputs={u: {file: push.csv, value: value}}", "--set",
                                      "loads={f: {type: force, at: arm, value: [u, 0, 0]}}"};
  ASSERT_EQ(run(load).code, 0);
  const auto again = [&](const std::string& source) {
    std::vector<std::string> words = load;
    words.insert(words.end(), {"-o", "rest.results.h5"});
    return go_on(source, words);
  };
  for (const std::string& source : sources) EXPECT_EQ(again(source).code, 0);
  write_text(folder.file("push.csv"), "time,value\n0,0\n2,7\n");
  for (const std::string& source : sources)
    expect_error(again(source), {"inputs.u.file: the contents of the file differ", "--changed"});
}

// Written by the program of 2026-11-29, before checkpoints held values of their scene.
TEST_F(Restart, OlderCheckpointsAreReadWithANote) {
  take("tests/compatibility/pendulum_1.1.checkpoint.h5", "old.checkpoint.h5");
  const Outcome outcome = go_on("old.checkpoint.h5", {"-o", "rest.results.h5", "--set", "bodies.arm.mass=20"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out,
              HasSubstr("does not contain its scene, so changes of the scene since then cannot be listed"));
}

}  // namespace
}  // namespace tisserand::cli::restart_test
