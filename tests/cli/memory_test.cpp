// SPDX-License-Identifier: GPL-3.0-or-later
// Programs that run out of memory or disk at one place of a run: an error that says so, no half-written file, whole
// files of before.
#include <cctype>
#include <filesystem>
#include <map>

#include "tests/cli/scenes.hpp"
#include "tests/support/trials.hpp"

namespace tisserand::cli::memory_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// What is short, for whom and for how long (tests/faults/short_of.cpp).
struct Shortage {
  const char* of = "memory";
  const char* by = "new";
  const char* length = "once";
};

void PrintTo(const Shortage& shortage, std::ostream* stream) {
  *stream << shortage.of << ' ' << shortage.by << ' ' << shortage.length;
}

class ShortOf : public ::testing::Test {
 protected:
  void SetUp() override {
#if defined(TISSERAND_SANITIZED)
    GTEST_SKIP() << "the sanitizer has an allocator of its own";
#endif
    where.folder = folder.file("work");
    fs::create_directory(where.folder);
  }
  void take(const std::string& name) const {
    fs::copy_file(fs::path(TISSERAND_SOURCE_DIR "/tests/verification/references/trials") / name,
                  fs::path(where.folder) / name);
  }
  /// The program with one shortage; call `at` and, `good`, all after it fail. No more than a minute of processor time.
  Outcome call_short(const std::vector<std::string>& words, const Shortage& shortage, long at) const {
    std::vector<std::string> all{"/bin/bash", "-c", "ulimit -t 60; exec \"$@\"", "bash", "/usr/bin/env"};
    const auto set = [&](const std::string& name, const std::string& value) { all.push_back(name + "=" + value); };
    set("LD_PRELOAD", TISSERAND_BINARY_DIR "/bin/libshort_of.so");
    set("TISSERAND_SHORT_OF", shortage.of);
    set("TISSERAND_SHORT_BY", shortage.by);
    set("TISSERAND_SHORT_FOR", shortage.length);
    set("TISSERAND_SHORT_AT", std::to_string(at));
    set("TISSERAND_SHORT_COUNT", folder.file("count"));
    all.insert(all.end(), words.begin(), words.end());
    fs::remove(folder.file("count"));
    return call(all, where);
  }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(where.folder))
      if (entry.is_regular_file() && entry.path().filename() != ".out" && entry.path().filename() != ".err")
        files[fs::relative(entry.path(), where.folder)] = read_text(entry.path());
    return files;
  }
  void restore(const std::map<std::string, std::string>& files) const {
    for (const auto& [name, text] : contents())
      if (!files.contains(name)) fs::remove(fs::path(where.folder) / name);
    for (const auto& [name, text] : files) write_text(fs::path(where.folder) / name, text);
  }

  /// Where a library crashed the rows until then stay and can be read, as of a run that was killed.
  bool may_stay(const std::string& name, const Shortage& shortage) const {
    return name.ends_with(".results.h5.part") && std::string(shortage.of) == "memory" &&
           call({program("mechanism"), "channels", name}, where).code == 0;
  }

  /// The kernel and the loader end a program that has no place before `main` (`reducer` becomes `reducer-solver`), and
  /// Open MPI one that it cannot start, in their own words or none. From `main` on a crash without memory has words.
  static bool ended_before_us(const Outcome& outcome, const Shortage& shortage) {
    const auto says = [&](const char* word) { return outcome.error.find(word) != std::string::npos; };
    const bool is_limited = std::string(shortage.of) == "memory" && std::string(shortage.length) == "good";
    return (is_limited && outcome.code == 1000 + SIGSEGV && outcome.error.empty()) ||
           (outcome.code == 127 && says("while loading shared libraries")) ||
           ((outcome.code == 1 || outcome.code == 2) && (says("MPI_INIT") || says("opal_") || says("mca_")));
  }

  /// Runs the program with the shortage at places spread evenly over the run. `whole` judges files that are not those
  /// of before.
  void survey(const std::vector<std::string>& words, const Shortage& shortage, int few,
              const std::function<void()>& expect_whole) const {
    ASSERT_EQ(call(words, where).code, 0) << "the run that makes the files of before";
    const std::map<std::string, std::string> before = contents();
    ASSERT_EQ(call_short(words, shortage, 0).code, 0);
    const long calls = std::atol(read_text(folder.file("count")).c_str());
    ASSERT_GT(calls, 0);
    const int places = test_support::trials(few);
    for (int k = 0; k < places; ++k) {
      restore(before);
      const long at = 1 + calls * (2 * k + 1) / (2 * places);
      SCOPED_TRACE(::testing::Message() << shortage.of << " " << shortage.by << " " << shortage.length << " at " << at
                                        << " of " << calls);
      const Outcome outcome = call_short(words, shortage, at);
      const char* reason = std::string(shortage.of) == "disk" ? "No space left" : "memory";
      if (!ended_before_us(outcome, shortage)) {
        EXPECT_THAT(outcome.code, ::testing::AnyOf(0, 1)) << outcome.error;
      }
      if (outcome.code == 1 && !ended_before_us(outcome, shortage)) {
        EXPECT_THAT(outcome.error, HasSubstr(reason));
      }
      const std::map<std::string, std::string> after = contents();
      for (const auto& [name, text] : after)
        EXPECT_TRUE(before.contains(name) || may_stay(name, shortage)) << name << " is left over";
      for (const auto& [name, text] : before) EXPECT_TRUE(after.contains(name)) << name << " is gone";
      if (after != before) expect_whole();
    }
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

class ShortOfBoth : public ShortOf, public ::testing::WithParamInterface<Shortage> {};

TEST_P(ShortOfBoth, MechanismRun) {
  take("restart_changed.scene.yaml");
  survey({program("mechanism"), "run", "restart_changed.scene.yaml"}, GetParam(), 6, [&] {
    EXPECT_EQ(call({program("mechanism"), "channels", "restart_changed.results.h5"}, where).code, 0);
    EXPECT_EQ(call({program("mechanism"), "run", "restart_changed.scene.yaml", "--restart",
                    "restart_changed.checkpoint.h5", "-o", "rest.results.h5", "--set", "integrator.end=1.1"},
                   where)
                  .code,
              0);
  });
}

TEST_P(ShortOfBoth, MechanismView) {
  take("restart_changed.scene.yaml");
  ASSERT_EQ(call({program("mechanism"), "run", "restart_changed.scene.yaml"}, where).code, 0);
  survey({program("mechanism"), "view", "restart_changed.results.h5"}, GetParam(), 3, [] {});
}

TEST_P(ShortOfBoth, MechanismPlot) {
  take("restart_changed.scene.yaml");
  ASSERT_EQ(call({program("mechanism"), "run", "restart_changed.scene.yaml"}, where).code, 0);
  survey({program("mechanism"), "plot", "restart_changed.results.h5", "-c", "energy/total", "-o", "a.svg"}, GetParam(),
         3, [] {});
}

TEST_P(ShortOfBoth, ReducerRun) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  take("stress_cantilever.part.yaml");
  survey({program("reducer"), "run", "stress_cantilever.part.yaml"}, GetParam(), 4, [&] {
    const Outcome shown = call({program("reducer"), "show", "stress_cantilever.superelement.h5"}, where);
    EXPECT_EQ(shown.code, 0) << shown.error;
  });
}

// The trial: a disk that was full after the superelement left it without its companion, and the next run was linear.
TEST_F(ShortOf, DisksLeaveTheFilesOfOneRun) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  take("stress_cantilever.part.yaml");
  const auto reduce = [&](const char* modes) {
    return std::vector<std::string>{program("reducer"), "run", "stress_cantilever.part.yaml", "--set", modes};
  };
  ASSERT_EQ(call(reduce("modes=8"), where).code, 0);
  const std::map<std::string, std::string> other = contents();
  ASSERT_EQ(call(reduce("modes=4"), where).code, 0);
  const std::map<std::string, std::string> before = contents();
  for (const char* length : {"once", "good"}) {
    const Shortage shortage{"disk", "all", length};
    ASSERT_EQ(call_short(reduce("modes=8"), shortage, 0).code, 0);
    const long calls = std::atol(read_text(folder.file("count")).c_str());
    const int places = test_support::trials(4);
    for (int k = 0; k < places; ++k) {
      restore(before);
      const long at = 1 + calls * (2 * k + 1) / (2 * places);
      const Outcome outcome = call_short(reduce("modes=8"), shortage, at);
      const std::map<std::string, std::string> after = contents();
      EXPECT_TRUE(after == before || after == other) << length << " at " << at << " of " << calls << outcome.error;
      EXPECT_EQ(outcome.code, after == before ? 1 : 0) << outcome.error;
    }
  }
}

TEST_P(ShortOfBoth, ReducerRecover) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  take("stress_cantilever.part.yaml");
  take("stress_cantilever.scene.yaml");
  ASSERT_EQ(call({program("reducer"), "run", "stress_cantilever.part.yaml"}, where).code, 0);
  ASSERT_EQ(call({program("mechanism"), "run", "stress_cantilever.scene.yaml"}, where).code, 0);
  survey({program("reducer"), "recover", "stress_cantilever.recovery.h5", "stress_cantilever.results.h5", "-o", "out"},
         GetParam(), 3, [] {});
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShortOfBoth,
                         ::testing::Values(Shortage{"memory", "new", "once"}, Shortage{"memory", "all", "good"},
                                           Shortage{"disk", "all", "once"}, Shortage{"disk", "all", "good"}),
                         [](const auto& one) { return std::string(one.param.of) + "_" + one.param.length; });

// The trial `unlikely_values` under a limit of address space: OpenBLAS waited for ever for its 128 MB.
TEST_F(ShortOf, AddressesEndsInSeconds) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  take("unlikely_values.part.yaml");
  bool done = false, refused = false;
  for (const int limit : {250'000, 400'000, 700'000}) {
    const std::string command = "ulimit -t 60; ulimit -v " + std::to_string(limit) + "; exec \"$@\"";
    const Outcome outcome =
        call({"/bin/bash", "-c", command, "bash", program("reducer"), "run", "unlikely_values.part.yaml"}, where);
    EXPECT_THAT(outcome.code, ::testing::AnyOf(0, 1)) << limit << outcome.error;
    done = done || outcome.code == 0;
    refused = refused || outcome.code == 1;
    if (outcome.code == 0) continue;
    EXPECT_THAT(outcome.error, HasSubstr("out of memory")) << limit;
    EXPECT_EQ(contents().size(), 1U) << limit;
  }
  EXPECT_TRUE(done && refused);
}

}  // namespace
}  // namespace tisserand::cli::memory_test
