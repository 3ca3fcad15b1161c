// SPDX-License-Identifier: GPL-3.0-or-later
// Events that are shorter than the steps that an error or the scene allows.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes/trial.hpp"

namespace tisserand::mechanism::short_events_test {
namespace {

using test_support::Trial;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

double largest_load(const std::vector<std::string>& settings) {
  const std::vector<double> load = Trial("wheel_over_bump", settings).channel("tyres/force/tyre/z");
  return *std::ranges::max_element(load);
}

// A wheel at 60 km/h meets a bump of 1 m after 1.8 s of flat road, on which steps have grown to 0.2 s. With steps of 1
// ms the largest load is 15803 N; it was 4088 N (the bump passed over) with a tolerance of 0.1.
TEST(ShortEvents, ControlledStepsEndOnPiecesOfRoads) {
  const double right = largest_load({});
  EXPECT_NEAR(right, 15803.0, 5.0);
  for (const char* setting :
       {"integrator={step: 1e-3, end: 2.2, error_control: {tolerance: 1e-1}}",
        "integrator={step: 1e-3, end: 2.2, formulation: index3, error_control: {tolerance: 1e-1}}",
        "integrator={method: hht, step: 1e-3, end: 2.2, error_control: {tolerance: 1e-1}}"})
    EXPECT_NEAR(largest_load({setting}), right, 0.02 * right) << setting;
  // Radau at so large a tolerance integrates the bump to a sixth of its load.
  EXPECT_NEAR(largest_load({"integrator={method: radau, step: auto, end: 2.2, error_control: {tolerance: 1e-1}}"}),
              right, 0.16 * right);
}

// 1e4 N push 1 kg for 1e-4 s: it stands at 5e-5 + 0.9999 m one second later, by every method and step. The pulse was
// passed over.
TEST(ShortEvents, PulsesOfFormulasEndSteps) {
  const double right = 0.99995;
  for (const char* value : {"1e4*(t>1 && t<1.0001)", "t <= 1 ? 0 : t - 1 < 1e-4 ? 1e4 : 0", "1e4*(1 < t)*(1.0001 > t)",
                            "1e4*max(0, sign(t - 1)*sign(1.0001 - t))", "5e3*(sign(t-1) - sign(t-1.0001))"})
    for (const char* integrator :
         {"{step: 0.1, end: 2}", "{step: 0.003, end: 2}", "{step: 0.1, end: 2, formulation: index3}",
          "{method: hht, step: 0.1, end: 2}", "{step: 0.001, end: 2, error_control: {tolerance: 1e-1}}",
          "{method: radau, step: auto, end: 2, error_control: {tolerance: 1e-2}}"})
      EXPECT_NEAR(
          Trial("pulse", {fmt::format("loads.push.value.0='{}'", value), fmt::format("integrator={}", integrator)})
              .last("nodes/position/body/x"),
          right, 1e-9)
          << value << " " << integrator;
}

// Impacts of half periods of 1.7 ms: with steps of 1 ms the slider is 0.67 mm off, more than its clearance of 0.5 mm.
TEST(ShortEvents, StopsThatAreTouchedForFewStepsAreDoubted) {
  EXPECT_THAT(Trial("clearance").report().doubts,
              Contains(ContainsRegex("contact with the stop of 'pin' lasts [1-4] steps")));
  EXPECT_THAT(Trial("clearance", {"integrator.step=1e-4"}).report().doubts,
              Not(Contains(HasSubstr("contact with the stop"))));
}

// u = t from the first instant of a file that a drive follows: rate 1 and moment 0, as the same points as a table give.
TEST(ShortEvents, InputThatMovesAtItsFirstInstant) {
  for (const char* analysis : {"analysis=dynamics", "analysis=inverse_dynamics"}) {
    const Trial trial("ramp_input", {analysis});
    for (const double rate : trial.channel("joints/rate/j")) EXPECT_NEAR(rate, 1.0, 1e-9) << analysis;
    for (const double moment : trial.channel("motions/force/m")) EXPECT_NEAR(moment, 0.0, 1e-9) << analysis;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::short_events_test
