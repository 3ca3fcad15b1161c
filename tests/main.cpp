// SPDX-License-Identifier: GPL-3.0-or-later
// The main function of all test programs. It keeps a journal: a line when a test starts, and one when it ends, with its
// result, its seconds of processor and of wall time, and why it was skipped. scripts/run_tests counts tests by it and
// names the test in which a program crashed; scripts/test_times takes the seconds from it.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

/// Processor seconds of this process and of its children that have ended.
double cpu_seconds() {
  double sum = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Each line is flushed: a crash loses none, and a forked child has nothing to write a second time.
class Journal : public ::testing::EmptyTestEventListener {
 public:
  explicit Journal(const char* path) : file_(std::fopen(path, "we")) {}

 private:
  void OnTestStart(const ::testing::TestInfo& test) override {
    cpu_ = cpu_seconds();
    wall_ = wall_seconds();
    write("start", test, "");
  }
  void OnTestEnd(const ::testing::TestInfo& test) override {
    const ::testing::TestResult& result = *test.result();
    std::string text = fmt::format(" {:.3f} {:.3f}", cpu_seconds() - cpu_, wall_seconds() - wall_);
    if (result.Skipped()) text += fmt::format(" {}", result.GetTestPartResult(result.total_part_count() - 1).message());
    write(result.Skipped() ? "skipped" : result.Passed() ? "passed" : "failed", test, text.substr(0, text.find('\n')));
  }
  void write(const char* what, const ::testing::TestInfo& test, const std::string& text) {
    if (file_ == nullptr) return;
    std::fprintf(file_, "%s %s.%s%s\n", what, test.test_suite_name(), test.name(), text.c_str());
    std::fflush(file_);
  }

  std::FILE* file_;
  double cpu_ = 0.0, wall_ = 0.0;
};

}  // namespace

int main(int count, char** arguments) {
  ::testing::InitGoogleMock(&count, arguments);
  if (const char* path = std::getenv("TISSERAND_TEST_JOURNAL"))
    ::testing::UnitTest::GetInstance()->listeners().Append(new Journal(path));
  return RUN_ALL_TESTS();
}
