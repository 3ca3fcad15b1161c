// SPDX-License-Identifier: GPL-3.0-or-later
// `mechanism study`: orders and cheapest settings that are known, interruptions, and what it says of bad input.
#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::study_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A point mass on a massless rod: its exact motion is smooth and no step size is special.
constexpr const char* pendulum = R"yaml(scene: pendulum
gravity: [0, -9.81, 0]
bodies:
  bob: {type: rigid, mass: 1, inertia: [0.1, 0.1, 0.1], pose: {position: [-1, 0, 0]}}
joints:
  rod: {type: distance, a: ground, b: bob}
integrator: {step: 0.01, end: 2}
output: {interval: 0.1, channels: [nodes/position]}
)yaml";

constexpr const char* orders = R"yaml(study: orders
series:
  second: {scene: pendulum.scene.yaml}
axes: {integrator.step: [0.02, 0.01, 0.005, 0.0025]}
quantities:
  x: {channel: nodes/position/bob/x}
  end: {channel: nodes/position/bob/y, norm: final}
reference:
  runs: [{at: {integrator.step: 0.0002}}, {at: {integrator.step: 0.0004}, set: {integrator.formulation: index3}}]
  agree: 1e-4
timing: together
)yaml";

class Study : public Folder {
 protected:
  Study() {
    write_text(file("pendulum.scene.yaml"), pendulum);
    write_text(file("orders.study.yaml"), orders);
  }
  Outcome study(const std::string& text, const std::vector<std::string>& options = {}) const {
    write_text(file("case.study.yaml"), text);
    std::vector<std::string> words{"study", "case.study.yaml"};
    words.insert(words.end(), options.begin(), options.end());
    return mechanism(words);
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }
};

std::vector<std::vector<std::string>> table_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

int column_of(const std::vector<std::vector<std::string>>& table, const std::string& name) {
  for (int k = 0; k < static_cast<int>(table.at(0).size()); ++k)
    if (table[0][k] == name) return k;
  return -1;
}

/// All but times, which differ from run to run.
std::string without_times(const std::string& csv) {
  std::string text;
  for (const std::vector<std::string>& row : table_of(csv)) {
    for (int k = 0; k < static_cast<int>(row.size()); ++k)
      if (table_of(csv)[0][k].find("cpu") == std::string::npos) text += row[k] + ",";
    text += "\n";
  }
  return text;
}

// Generalised alpha is of order two in positions [ABC15]; the reference is 12.5 times finer than the finest step, which
// biases an observed order of two by log2((1 - 1/625) / (1 - 1/156)) = 0.007.
TEST_F(Study, FindsTheOrderOfAKnownMethod) {
  const Outcome outcome = mechanism({"study", "orders.study.yaml"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const auto table = table_of(read_text(file("orders.study/table.csv")));
  ASSERT_EQ(table.size(), 5u);
  for (const char* name : {"order x", "order end"}) {
    const int column = column_of(table, name);
    ASSERT_GE(column, 0);
    EXPECT_EQ(table[1][column], "");
    for (int row = 2; row <= 4; ++row) EXPECT_NEAR(std::stod(table[row][column]), 2.0, 0.1) << name << row;
  }
  EXPECT_THAT(outcome.out, HasSubstr("the references agree to"));
  const std::string page = read_text(file("orders.study/index.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("<svg"), HasSubstr("</html>"), HasSubstr("Error against CPU time: x")));
  EXPECT_THAT(page, Not(HasSubstr("<script src")));
  EXPECT_THAT(page, AllOf(HasSubstr("prefers-color-scheme:dark"), Not(HasSubstr("fill=\"#ffffff\""))));
}

// Of the settings whose error is within the tolerance the one that took the least time: the coarser of two, unless the
// machine was busy while it ran, so times are taken from the table.
TEST_F(Study, NamesTheCheapestSettingAndWritesItsScene) {
  write_text(file("orders.study.yaml"), replaced(orders, "0.0025", "0.0005"));
  ASSERT_EQ(mechanism({"study", "orders.study.yaml"}).code, 0);
  const auto table = table_of(read_text(file("orders.study/table.csv")));
  const int cpu = column_of(table, "cpu [s]");
  ASSERT_GE(cpu, 0);
  const std::string cheapest = std::stod(table[3][cpu]) <= std::stod(table[4][cpu]) ? "0.005" : "0.0005";
  const double error = std::stod(table[3][column_of(table, "error x")]);  // of step 0.005; four times that of 0.01
  const Outcome outcome =
      mechanism({"study", "orders.study.yaml", "--of", "x", "--tolerance", std::to_string(2.0 * error)});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("integrator.step = " + cheapest + ","), HasSubstr(".scene.yaml")));
  std::string scene;
  for (const auto& entry : std::filesystem::directory_iterator(where.folder))
    if (entry.path().filename().string().starts_with("orders_")) scene = entry.path().string();
  EXPECT_THAT(read_text(scene), HasSubstr("step: " + cheapest + "\n"));
  EXPECT_EQ(mechanism({"run", scene}).code, 0);
  const Outcome beyond = mechanism({"study", "orders.study.yaml", "--tolerance", "1e-9"});
  EXPECT_EQ(beyond.code, 1);
  EXPECT_THAT(beyond.error, AllOf(HasSubstr("no setting keeps its error and those of all finer settings within 1e-09"),
                                  HasSubstr("0.0005")));
}

TEST_F(Study, EndsWithTheSameTableHoweverOftenItIsKilled) {
  ASSERT_EQ(mechanism({"study", "orders.study.yaml", "-o", "whole"}).code, 0);
  std::mt19937 random(1);
  for (int kills = 0; kills < 12; ++kills) {
    const pid_t child = start({program("mechanism"), "study", "orders.study.yaml", "-o", "killed"}, where);
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution(5, 150)(random)));
    ::kill(child, kills % 3 == 0 ? SIGTERM : SIGKILL);
    (void)finish(child, where);
  }
  ASSERT_EQ(mechanism({"study", "orders.study.yaml", "-o", "killed"}).code, 0);
  EXPECT_EQ(without_times(read_text(file("killed/table.csv"))), without_times(read_text(file("whole/table.csv"))));
  // No completed run was repeated: a line for each of the four settings, after the head.
  const std::string journal = read_text(file("killed/journal.jsonl"));
  EXPECT_EQ(std::count(journal.begin(), journal.end(), '\n'), 5);
}

TEST_F(Study, AFailureIsAResult) {
  const Outcome outcome = study(replaced(orders, "[0.02, 0.01, 0.005, 0.0025]", "[0.5, 0.01, 0.005]") +
                                "set: {integrator.max_halvings: 0, "
                                "integrator.max_iterations: 2}\n");
  const std::string table = read_text(file("case.study/table.csv"));
  EXPECT_THAT(table + outcome.error, HasSubstr("did not converge"));
}

TEST_F(Study, SaysWhatIsWrongBeforeAnythingRuns) {
  struct Case {
    std::string from, to, message;
  };
  const std::vector<Case> cases{
      {"integrator.step: [0.02", "integrator.stepp: [0.02", "stepp"},
      {"axes: {", "set: {bodies.bobb.mass: 2}\naxes: {", "'bodies' has no entry 'bobb'"},
      {"axes: {", "axes: {modes: [1, 2], ", "axis 'modes' sets nothing in series 'second'"},
      {"pendulum.scene.yaml", "none.scene.yaml", "none.scene.yaml"},
      {"norm: final", "norm: last", "norm"},
      {"at: {integrator.step: 0.0002}", "series: third", "third"},
      {"timing: together", "timing: apart", "apart"},
      {"timing: together", "repeats: 0", "repeats is 0"},
  };
  for (const Case& one : cases) {
    const Outcome outcome = study(replaced(orders, one.from, one.to));
    EXPECT_EQ(outcome.code, 1) << one.message;
    EXPECT_THAT(outcome.error, HasSubstr(one.message));
    EXPECT_FALSE(std::filesystem::exists(file("case.study/journal.jsonl"))) << one.message;
  }
}

TEST_F(Study, SaysWhatIsWrongWithRuns) {
  const Outcome missing = study(replaced(orders, "nodes/position/bob/x", "nodes/position/bob/q"));
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.error, AllOf(HasSubstr("nodes/position/bob/q"), HasSubstr("nodes/position/bob/x")));

  const Outcome disagree = study(replaced(orders, "agree: 1e-4", "agree: 1e-12"), {"-o", "disagree"});
  EXPECT_EQ(disagree.code, 1);
  EXPECT_THAT(disagree.error, AllOf(HasSubstr("references disagree"), HasSubstr("integrator.step = 0.0002"),
                                    HasSubstr("integrator.step = 0.0004")));

  ASSERT_EQ(study(orders, {"-o", "mine"}).code, 0);
  write_text(file("pendulum.scene.yaml"), replaced(pendulum, "end: 2", "end: 1"));
  const Outcome other = study(orders, {"-o", "mine"});
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.error, HasSubstr("results of another scene"));

  const std::string journal = read_text(file("mine/journal.jsonl"));
  write_text(file("mine/journal.jsonl"), replaced(journal, "\"tisserand\":\"", "\"tisserand\":\"9."));
  EXPECT_THAT(study(orders, {"-o", "mine"}).error, HasSubstr("results of version 9."));
  write_text(file("mine/journal.jsonl"), "what is this\n");
  EXPECT_THAT(study(orders, {"-o", "mine"}).error, HasSubstr("is not the journal of a study"));
}

TEST_F(Study, TellsWhenNoRunFitsTheBudget) {
  const std::string reference = "reference: {file: exact.csv, source: none}\n";
  write_text(file("exact.csv"), "t,x\n0,-1\n0.5,0\n1,1\n");
  const Outcome outcome = study(
      "study: budget\nseries: {one: {scene: pendulum.scene.yaml, set: {integrator.end: 1e5}}}\n"
      "quantities: {x: {channel: nodes/position/bob/x}}\nrun_budget: 0.2\n" +
      reference);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("no run completed within its budget"));
  EXPECT_THAT(read_text(file("case.study/table.csv")), HasSubstr("not finished within 0.2 s"));
}

TEST_F(Study, SaysThatSlurmIsMissing) {
  const Outcome outcome = call(
      {"/usr/bin/env", "PATH=" + where.folder, program("mechanism"), "study", "orders.study.yaml", "--slurm"}, where);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("Slurm is missing"));
}

/// A stand-in for sbatch that runs the tasks of the array which `chosen` (a shell pattern) means.
void write_sbatch(const std::string& folder, const std::string& chosen) {
  std::filesystem::create_directories(folder + "/bin");
  write_text(
      folder + "/bin/sbatch",
      "#!/bin/sh\n[ \"$1\" = --wait ] || exit 1\necho Submitted batch job 7\nlast=$(sed -n 's/.*array=0-//p' \"$2\")\n"
      "for task in $(seq 0 \"$last\"); do case $task in " +
          chosen + ") SLURM_ARRAY_TASK_ID=$task sh \"$2\";; esac; done\n");
  std::filesystem::permissions(folder + "/bin/sbatch", std::filesystem::perms::owner_all);
}

TEST_F(Study, AJobArrayGivesTheSameTable) {
  const std::string path = "PATH=" + where.folder + "/bin:/usr/bin:/bin";
  ASSERT_EQ(mechanism({"study", "orders.study.yaml", "-o", "here"}).code, 0);
  write_sbatch(where.folder, "*");
  const Outcome outcome =
      call({"/usr/bin/env", path, program("mechanism"), "study", "orders.study.yaml", "-o", "array", "--slurm"}, where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(without_times(read_text(file("array/table.csv"))), without_times(read_text(file("here/table.csv"))));
  EXPECT_TRUE(std::filesystem::exists(file("array/journal.3.jsonl")));
}

TEST_F(Study, AJobThatVanishedIsNamed) {
  const std::string path = "PATH=" + where.folder + "/bin:/usr/bin:/bin";
  write_sbatch(where.folder, "0 | 1 | 3");
  const Outcome outcome =
      call({"/usr/bin/env", path, program("mechanism"), "study", "orders.study.yaml", "--slurm"}, where);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("1 of 4 jobs ended without a result: tasks 2"),
                                   HasSubstr("integrator.step = 0.005"), HasSubstr("orders.study/slurm")));
}

constexpr const char* swinging_part = R"yaml(part: rod
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {bar: {shape: circle, radius: 0.01}}
points: {base: [0, 0, 0], tip: [1, 0, 0]}
beams: {rod: {from: base, to: tip, section: bar, material: steel, elements: 8}}
boundary: [base, tip]
modes: 2
)yaml";

constexpr const char* swinging = R"yaml(scene: swinging rod
gravity: [0, 0, -9.81]
bodies: {rod: {type: superelement, file: none.superelement.h5}}
joints: {hinge: {type: revolute, a: ground, b: rod/base, axis: [0, 1, 0]}}
integrator: {step: 0.01, end: 0.2}
output: {interval: 0.02, channels: [nodes/position]}
)yaml";

constexpr const char* parts_study = R"yaml(study: elements of a part
series:
  rod:
    scene: swinging.scene.yaml
    axes: {elements: [2, 4], bodies.rod.modes: [0, 2]}
    parts: {rod: {file: rod.part.yaml, as: bodies.rod.file, set: {beams.rod.elements: $elements}}}
quantities: {tip: {channel: nodes/position/rod/tip/z}}
timing: together
)yaml";

TEST_F(Study, WithoutTheOtherProgramPartsCannotVary) {
  write_text(file("rod.part.yaml"), swinging_part);
  write_text(file("swinging.scene.yaml"), swinging);
  write_text(file("parts.study.yaml"), parts_study);
  std::filesystem::create_directories(file("alone"));
  std::filesystem::copy(program("mechanism"), file("alone/mechanism"));
  const auto alone = [&](const std::string& study) {
    return call({"/usr/bin/env", "PATH=/usr/bin:/bin", file("alone/mechanism"), "study", study}, where);
  };
  const Outcome outcome = alone("parts.study.yaml");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("the program reducer is missing"));
  EXPECT_EQ(alone("orders.study.yaml").code, 0);  // nothing to be reduced
}

TEST_F(Study, PartsAreReducedOncePerSetting) {
  if (!std::filesystem::exists(program("reducer"))) GTEST_SKIP() << "built without reducer";
  write_text(file("rod.part.yaml"), swinging_part);
  write_text(file("swinging.scene.yaml"), swinging);
  write_text(file("parts.study.yaml"), parts_study);
  const Outcome outcome = mechanism({"study", "parts.study.yaml"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file("parts.study/parts")))
    files += entry.path().string().ends_with(".superelement.h5") ? 1 : 0;
  EXPECT_EQ(files, 2);  // modes are cut by the scene
  write_text(file("parts.study.yaml"), replaced(parts_study, "[2, 4]", "[2, 4, 8]"));
  // The finest run is the reference, another one now.
  EXPECT_THAT(mechanism({"study", "parts.study.yaml"}).error,
              HasSubstr("results of another scene, or of other quantities or another reference"));
}

}  // namespace
}  // namespace tisserand::cli::study_test
