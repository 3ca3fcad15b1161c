// SPDX-License-Identifier: GPL-3.0-or-later
// What writers of results promise to disks, to readers beside them and to runs that go on.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::results_writer_test {
namespace {

using test_support::error_of;
using test_support::example_layout;
using test_support::fill_row;
using test_support::TemporaryFolder;
using test_support::text_of;
using test_support::write_rows;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ResultsWriter, PlaceThatCannotBeWrittenIsAnErrorAtTheStart) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("file")) << "x";
  EXPECT_THAT(error_of([&] { ResultsWriter writer(folder.file("file/a.h5"), example_layout()); }),
              AllOf(HasSubstr("file/a.h5.part"), HasSubstr("folder that exists")));
  EXPECT_THAT(error_of([&] { ResultsWriter writer(folder.file("missing/a.h5"), example_layout()); }),
              HasSubstr("No such file or directory"));
}

/// The child writes under a limit of the file size (in place of a full disk) until that is an Error, which must name
/// the reason; it must end by itself, and its rows until then must be readable.
TEST(ResultsWriter, FileThatCannotGrowIsAnErrorAndKeepsWhatItHas) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{16u << 20, 16u << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::string text = "no error";
    try {
      write_rows(path, example_layout(), 200000);
    } catch (const Error& error) {
      text = error.what();
    }
    std::exit(text.find("the file may not grow beyond 16384 kB") != std::string::npos
                  ? 7
                  : 8);  // exit() runs HDF5's own end as well
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << status;
  EXPECT_EQ(WEXITSTATUS(status), 7);
  const ResultsReader reader(path);
  EXPECT_FALSE(reader.completed());
  EXPECT_GT(reader.rows(), 1000u);
  const std::vector<double> time = reader.time();
  ResultsRow row;
  row.resize(example_layout());
  fill_row(1000, row);
  EXPECT_EQ(time[1000], row.time);
}

/// The 8 bytes of one stored instant.
std::size_t place_of_time(const std::string& bytes, int t) {
  ResultsRow row;
  fill_row(t, row);
  return bytes.find(std::string(reinterpret_cast<const char*>(&row.time), sizeof row.time));
}

// What a reader meets beside a writer that is writing the last chunk, and after one that was killed there: 256 rows are
// a chunk, so that those of 700 end in the third.
TEST(ResultsWriter, HalfWrittenLastChunkOfARunningFileIsReadAndDamageBeforeItIsNot) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  ResultsRow row;
  row.resize(layout);
  ResultsWriter writer(folder.file("a.h5"), layout);
  for (int t = 0; t < 700; ++t) {
    fill_row(t, row);
    writer.append(row);
  }
  writer.flush();
  const std::string bytes = text_of(folder.file("a.h5.part"));
  const auto changed = [&](std::size_t at) {
    std::string other = bytes;
    other.replace(at, 8, "next row");
    std::ofstream(folder.file("b.h5"), std::ios::binary) << other;
    return folder.file("b.h5");
  };
  const std::vector<double> time = ResultsReader(changed(place_of_time(bytes, 699) + 8)).time();
  ASSERT_EQ(time.size(), 700u);
  for (int t = 0; t < 700; ++t) {
    fill_row(t, row);
    EXPECT_EQ(time[t], row.time);
  }
  const std::string damaged = changed(place_of_time(bytes, 10));
  EXPECT_THAT(error_of([&] { static_cast<void>(ResultsReader(damaged).time()); }),
              AllOf(HasSubstr("b.h5: /time"), HasSubstr("damaged")));
  writer.finish(true, "", "{}");
}

TEST(ResultsWriter, FlushedRowsAreThereForOthers) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  ResultsRow row;
  row.resize(layout);
  ResultsWriter writer(folder.file("a.h5"), layout);
  for (int t = 0; t < 5; ++t) writer.append(row);
  EXPECT_EQ(writer.rows(), 5u);
  writer.flush();
  EXPECT_EQ(ResultsReader(folder.file("a.h5")).rows(), 5u);
  EXPECT_EQ(ResultsReader(folder.file("a.h5")).run(), writer.run());
}

TEST(ResultsWriter, NameThatAWriterHoldsIsRefused) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  const std::string path = folder.file("a.h5");
  {
    ResultsWriter writer(path, layout);
    EXPECT_THAT(error_of([&] { ResultsWriter second(path, layout); }),
                AllOf(HasSubstr("a.h5"), HasSubstr("another program is writing these results now")));
    EXPECT_THAT(error_of([&] { require_unheld_results(path); }), HasSubstr("another program is writing"));
    EXPECT_EQ(error_of([&] { ResultsWriter other(folder.file("b.h5"), layout); }), "no error");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);  // nothing is left over
    writer.finish(true, "", "{}");
  }
  std::filesystem::copy_file(path, path + ".part");  // of a run that was killed
  EXPECT_EQ(error_of([&] { require_unheld_results(path); }), "no error");
  EXPECT_EQ(error_of([&] { write_rows(path, layout, 3); }), "no error");
}

TEST(ResultsWriter, BeginsWithTheRowsOfAnOlderFile) {
  const TemporaryFolder folder;
  ResultsLayout layout = example_layout();
  write_rows(folder.file("old.h5"), layout, 6000);  // more than can wait at once
  {
    ResultsWriter writer(folder.file("new.h5"), layout, {folder.file("old.h5"), 5001});
    EXPECT_EQ(writer.rows(), 5001u);
    ResultsRow row;
    row.resize(layout);
    for (int t = 5001; t < 6000; ++t) {
      fill_row(t, row);
      writer.append(row);
    }
    writer.finish(true, "", "{}");
  }
  export_csv(ResultsReader(folder.file("old.h5")), {}, folder.file("old.csv"));
  export_csv(ResultsReader(folder.file("new.h5")), {}, folder.file("new.csv"));
  EXPECT_TRUE(text_of(folder.file("old.csv")) == text_of(folder.file("new.csv")));
  EXPECT_THAT(error_of([&] {
                ResultsWriter writer(folder.file("b.h5"), layout, {folder.file("old.h5"), 6001});
              }),
              HasSubstr("holds 6000 instants, 6001 were expected"));
  ResultsLayout other = layout;
  other.stiffened.back() = 1 - other.stiffened.back();
  EXPECT_THAT(error_of([&] {
                ResultsWriter writer(folder.file("b.h5"), other, {folder.file("old.h5"), 10});
              }),
              AllOf(HasSubstr("old.h5: body " + other.superelements.back()),
                    HasSubstr(layout.stiffened.back() != 0 ? "it has geometric" : "it has no geometric")));
  layout.channels = {"energy"};
  EXPECT_THAT(error_of([&] {
                ResultsWriter writer(folder.file("b.h5"), layout, {folder.file("old.h5"), 10});
              }),
              AllOf(HasSubstr("old.h5"), HasSubstr("has channels or units that differ from those of this run")));
}
}  // namespace
}  // namespace tisserand::formats::results_writer_test
