// What a reduction tells while it runs: long phases with the time to go, times by phase.
#include "reducer/report/phases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace tisserand::reducer::phases_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Phases, LongOnesSayHowLongTheyWillTake) {
  ::testing::internal::CaptureStderr();
  {
    Phases phases;
    phases.begin("mesh");
    phases.begin("factorisation");
    phases.share(0.4);  // after a second: one and a half to go
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    phases.end();
  }
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("factorisation ... 1 s, 40 %, about 2 s to go\n"), Not(HasSubstr("mesh"))));
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
