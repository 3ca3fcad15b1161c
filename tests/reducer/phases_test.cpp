// SPDX-License-Identifier: GPL-3.0-or-later
// What a reduction tells while it runs: long phases with the time to go, times by phase.
#include "reducer/report/phases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <regex>
#include <string>
#include <thread>

namespace tisserand::reducer::phases_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

// A busy machine may print later than after the first second, and only once the phase has lasted longer.
TEST(Phases, LongOnesSayHowLongTheyWillTake) {
  std::smatch found;
  std::string text;
  for (int milliseconds = 1300; found.empty() && milliseconds < 100'000; milliseconds *= 2) {
    ::testing::internal::CaptureStderr();
    {
      Phases phases;
      phases.begin("mesh");
      phases.begin("factorisation");
      phases.share(0.4);
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      phases.end();
    }
    text = ::testing::internal::GetCapturedStderr();
    std::regex_search(text, found, std::regex("factorisation \\.\\.\\. ([0-9]+) s, 40 %, about ([0-9]+) s to go\n"));
  }
  ASSERT_FALSE(found.empty()) << text;
  const double gone = std::stod(found[1]), left = std::stod(found[2]);  // 60 % are to come, both times are rounded
  EXPECT_NEAR(left, 1.5 * gone, 0.5 + 1.5) << text;
  EXPECT_THAT(text, Not(HasSubstr("mesh")));
}

TEST(Phases, OneThatGoesOnIsOneOfTheList) {
  Phases phases;
  for (const char* name : {"internal modes", "count", "internal modes", "projection"}) phases.begin(name);
  phases.end();
  for (const std::string& text : {phases.text(), phases.processor_text()})
    EXPECT_THAT(text,
                ContainsRegex("^internal modes [0-9.]+ s, count [0-9.]+ s, projection [0-9.]+ s, total [0-9.]+ s$"));
  EXPECT_THAT(phases.memory_text(), ContainsRegex("^internal modes [0-9]+ MB, count [0-9]+ MB, projection [0-9]+ MB$"));
}

}  // namespace
}  // namespace tisserand::reducer::phases_test
