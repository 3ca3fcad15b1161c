// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is killed at any moment leaves a results file that opens and whose rows are true.
//
// Heavier: TISSERAND_KILLS=100 formats_tests --gtest_filter='ResultsKill.*'
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/trials.hpp"

namespace {
/// Writes until this process is killed; negative: it is not.
long writes_left = -1;
long writes_done = 0;
}  // namespace

/// In place of the C library's, for HDF5 and all others in this program.
extern "C" __attribute__((visibility("default"))) ssize_t pwrite(int file, const void* bytes, std::size_t size,
                                                                 off_t place) {
  if (writes_left == 0) ::kill(::getpid(), SIGKILL);
  if (writes_left > 0) --writes_left;
  ++writes_done;
  return ::syscall(SYS_pwrite64, file, bytes, size, place);
}

namespace tisserand::formats::results_kill_test {
namespace {

using test_support::example_layout;
using test_support::fill_row;
using test_support::TemporaryFolder;

void write_run(const std::string& path, const ResultsLayout& layout, int rows) {
  ResultsRow row;
  row.resize(layout);
  ResultsWriter writer(path, layout);
  for (int t = 0; t < rows; ++t) {
    fill_row(t, row);
    writer.append(row);
  }
  writer.finish(true, "", R"({"done": true})");
}

/// Writes one run after the other at full speed, so that most moments are in the middle of a write or of an end of a
/// run.
[[noreturn]] void write_forever(const std::string& path, const ResultsLayout& layout) {
  for (int run = 0;; ++run) write_run(path, layout, 3000 + 5000 * (run % 5));
}

/// How long the first of these runs takes here [microseconds].
int duration_of_a_run(const ResultsLayout& layout) {
  const TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  write_run(folder.file("run.results.h5"), layout, 3000);
  return static_cast<int>(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
}

/// Every row that the file shows is the row that was written.
void expect_true_rows(const std::string& path, const ResultsLayout& layout) {
  const ResultsReader reader(path);
  std::vector<std::string> names;
  for (const Channel& channel : reader.channels()) names.push_back(channel.name);
  const Eigen::MatrixXd values = reader.read_rows(names, 0, reader.rows());
  ResultsRow row;
  row.resize(layout);
  const std::vector<double> time = reader.time(), constraint = reader.read("solver/constraint");
  for (std::size_t t = 0; t < reader.rows(); ++t) {
    fill_row(static_cast<int>(t), row);
    ASSERT_EQ(time[t], row.time) << path << " row " << t << " of " << reader.rows();
    ASSERT_EQ(constraint[t], row.constraint) << path << " row " << t;
    // Values ascend by one from column to column in the order of the file, but for time and the joint without
    // coordinate.
    for (Eigen::Index j = 2; j < values.cols(); ++j) {
      const double step = values(static_cast<Eigen::Index>(t), j) - values(static_cast<Eigen::Index>(t), j - 1);
      ASSERT_TRUE(step == 1.0 || std::isnan(step)) << path << " row " << t << " " << names[j];
    }
  }
  if (reader.completed()) {
    EXPECT_EQ(reader.report_json(), R"({"done": true})");
  }
}

// The last writes, when the report comes in: at random moments this is met once in some hundred runs.
TEST(ResultsKill, BeforeEachOfTheLastWritesTheFileOpens) {
  const ResultsLayout layout = example_layout();
  const TemporaryFolder whole;
  writes_done = 0;
  write_run(whole.file("run.results.h5"), layout, 20);
  const long all = writes_done;
  for (long writes = all - test_support::trials(30); writes < all; ++writes) {
    const TemporaryFolder folder;
    const std::string path = folder.file("run.results.h5");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      writes_left = writes;
      write_run(path, layout, 20);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "status " << status << " before write " << writes + 1 << " of " << all;
    ASSERT_TRUE(std::filesystem::exists(path + ".part"));
    try {
      expect_true_rows(path + ".part", layout);
    } catch (const Error& error) {
      ADD_FAILURE() << "killed before write " << writes + 1 << " of " << all << ": " << error.what();
    }
  }
}

TEST(ResultsKill, FilesOfKilledRunsOpenAndHoldTrueRows) {
  const int kills = test_support::trials(5);
  std::mt19937 random(20240607);
  int partial = 0, whole = 0, with_rows = 0;
  const ResultsLayout layout = example_layout();
  std::uniform_int_distribution<int> microseconds(0, 5 * duration_of_a_run(layout));
  for (int k = 0; k < kills; ++k) {
    const TemporaryFolder folder;
    const std::string path = folder.file("run.results.h5");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) write_forever(path, layout);
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself, status " << status;
    for (const std::string& candidate : {path, path + ".part"}) {
      if (!std::filesystem::exists(candidate)) continue;
      try {
        expect_true_rows(candidate, layout);
        const ResultsReader reader(candidate);
        if (reader.completed())
          ++whole;
        else
          ++partial;
        if (!reader.completed() && reader.rows() > 0) ++with_rows;
      } catch (const Error& error) {
        ADD_FAILURE() << "kill " << k << ": " << error.what();
      }
    }
  }
  // If all kills had met the same phase, the test would say little.
  if (kills >= 20) {
    EXPECT_GT(partial, 0);
    EXPECT_GT(whole, 0);
  }
  RecordProperty("partial", partial);
  RecordProperty("partial_with_rows", with_rows);
  RecordProperty("whole", whole);
}

}  // namespace
}  // namespace tisserand::formats::results_kill_test
