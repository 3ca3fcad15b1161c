// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the progress line with a clock that the test turns.
#include "common/progress.hpp"

#include <string>

#include <gtest/gtest.h>

namespace tisserand::progress_test {
namespace {

struct Recorder {
  std::FILE* file = std::tmpfile();
  double now = 100.0;

  ~Recorder() { std::fclose(file); }
  ProgressOutput output(bool terminal) {
    return {file, terminal, [this] { return now; }};
  }
  std::string text() const {
    std::rewind(file);
    std::string content(4096, '\0');
    content.resize(std::fread(content.data(), 1, content.size(), file));
    return content;
  }
};

TEST(Progress, SaysNothingDuringTheFirstSecond) {
  Recorder recorder;
  {
    Progress progress("running", 10.0, recorder.output(true));
    recorder.now += 0.9;
    progress.update(5.0, "t = 5 s");
  }
  EXPECT_EQ(recorder.text(), "");
}

TEST(Progress, RewritesOneLineOnATerminalAndRemovesIt) {
  Recorder recorder;
  Progress progress("running", 10.0, recorder.output(true));
  recorder.now += 1.4;
  progress.update(2.5, "t = 2.5 s");
  recorder.now += 0.05;  // too early for another
  progress.update(2.6, "t = 2.6 s");
  recorder.now += 0.05;
  progress.update(5.0, "");
  progress.finish();
  progress.finish();
  EXPECT_EQ(
      recorder.text(),
      "\rrunning: 25 %, t = 2.5 s, 1 s elapsed, 4 s to go\x1b[K\rrunning: 50 %, 2 s elapsed, 2 s to go\x1b[K\r\x1b[K");
}

TEST(Progress, WritesALineEveryTenSecondsElsewhere) {
  Recorder recorder;
  Progress progress("modes", 0.0, recorder.output(false));
  for (int i = 0; i < 25; ++i) {
    recorder.now += 1.0;
    progress.update(i, "");
  }
  progress.finish();
  EXPECT_EQ(recorder.text(), "modes: 1 s elapsed\nmodes: 11 s elapsed\nmodes: 21 s elapsed\nmodes: done in 25 s\n");
}

TEST(Progress, DoesNotSayDoneOfWhatIsCutShort) {
  Recorder recorder;
  {
    Progress progress("running", 10.0, recorder.output(false));
    recorder.now += 2.0;
    progress.update(1.0, "");
  }
  EXPECT_EQ(recorder.text(), "running: 10 %, 2 s elapsed, 18 s to go\n");
}

}  // namespace
}  // namespace tisserand::progress_test
