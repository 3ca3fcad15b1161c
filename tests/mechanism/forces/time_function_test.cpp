// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of time of loads: numbers, tables, expressions, and values that are not numbers.
#include "mechanism/forces/time_function.hpp"

#include <cmath>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/scene/expand/expression.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::time_function_test {
namespace {

using formats::TimeExpression;
using formats::TimeTable;

TEST(TimeFunction, Constant) {
  TimeFunction f(3.5);
  EXPECT_EQ(f(-1.0), 3.5);
  EXPECT_EQ(f(100.0), 3.5);
  EXPECT_TRUE(f.breakpoints().empty());
}

TEST(TimeFunction, WhatLooksLikeAnotherFormulaIsAnError) {
  const auto error = [](const std::string& text) -> std::string {
    try {
      TimeFunction f(TimeExpression{text, {}, "scene.yaml:7:3"}, {});
      return "";
    } catch (const Error& fault) {
      return fault.what();
    }
  };
  for (const std::string text : {"2,5*t", "(2,5)*t", "sin(t),1", "3*(t,2)"})
    EXPECT_THAT(error(text), ::testing::AllOf(::testing::HasSubstr("expression '" + text + "': a comma"),
                                              ::testing::HasSubstr("scene.yaml:7:3")));
  for (const std::string text : {"t=5", "t = 5", "2*(t=1)"})
    EXPECT_THAT(error(text), ::testing::HasSubstr("expression '" + text + "': '='"));
  // The trial: clamp() is of other languages, and the message lists what there is.
  EXPECT_THAT(error("2 * clamp(t, 0, 1)"),
              ::testing::AllOf(::testing::HasSubstr("there is no function 'clamp'; use one of abs, "),
                               ::testing::HasSubstr(" max, min, "), ::testing::HasSubstr(" step_trapezoid, ")));
  for (const std::string text : {"max(1, 2.5)*t", "t <= 1 ? 2 : 3", "t == 1 ? 2 : 3", "min(max(t, 1), 2)",
                                 "t != 0 ? 1 : 0", "t >= 1 ? 2 : sum(1, (2 + t) * 3, 4)"})
    EXPECT_EQ(error(text), "");
}

TEST(TimeFunction, AllFunctionsStandInTheDocumentation) {
  std::ifstream file(TISSERAND_SOURCE_DIR "/formats/SCENE.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& name : formats::formula_functions())
    EXPECT_TRUE(page.find("`" + name + "`") != std::string::npos || page.find("`" + name + "(") != std::string::npos)
        << name << " is missing in formats/SCENE.md";
}

TEST(TimeFunction, TableIsLinearBetweenPointsAndConstantOutside) {
  const TimeTable table{{1.0, 2.0, 4.0}, {10.0, 20.0, -20.0}};
  TimeFunction f(table);
  EXPECT_EQ(f(0.0), 10.0);
  EXPECT_EQ(f(1.0), 10.0);
  EXPECT_DOUBLE_EQ(f(1.25), 12.5);
  EXPECT_EQ(f(2.0), 20.0);
  EXPECT_DOUBLE_EQ(f(3.5), -10.0);
  EXPECT_EQ(f(4.0), -20.0);
  EXPECT_EQ(f(9.0), -20.0);
  EXPECT_EQ(f.breakpoints(), (std::vector<double>{1.0, 2.0, 4.0}));
}

TEST(TimeFunction, ExpressionInT) {
  TimeFunction f(TimeExpression{"10*sin(2*pi*t) + (t > 1 ? 5 : 0)", {1.0}, "scene.yaml:3:4"});
  EXPECT_NEAR(f(0.25), 10.0, 1e-14);
  EXPECT_NEAR(f(1.25), 15.0, 1e-13);
  EXPECT_EQ(TimeFunction(TimeExpression{"t", {0.5, 1.0}, ""}).breakpoints(), (std::vector<double>{0.5, 1.0}));
}

TEST(TimeFunction, BadExpressionIsAnErrorAtItsPlace) {
  for (const std::string text : {"10*sin(", "2*x", "t t", ""}) {
    try {
      TimeFunction f(TimeExpression{text, {}, "scene.yaml:3:4"});
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "scene.yaml:3:4") << text;
      EXPECT_THAT(error.message(), ::testing::HasSubstr("'" + text + "'"));
      EXPECT_FALSE(error.remedy().empty());
    }
  }
}

/// A free body pushed along x by an expression.
formats::Scene pushed_body(const std::string& expression, std::vector<double> breakpoints) {
  formats::Scene scene = test_support::empty_scene(0.01, 2.0);
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 1, 1}));
  formats::LoadSpec load = test_support::constant_load("push", formats::LoadKind::force, "body", {0, 0, 0});
  load.components[0] = TimeExpression{expression, std::move(breakpoints), "scene.yaml:7:9"};
  load.where = "scene.yaml:7:1";
  scene.loads.push_back(load);
  return scene;
}

// The force is a number until t = 1 and none after: the run ends there with a reason and a state of numbers.
TEST(LoadThatIsNotANumber, DuringARunEndsItWithAReason) {
  for (const std::vector<double>& breakpoints : {std::vector<double>{}, std::vector<double>{1.0}}) {
    test_support::Simulation run(pushed_body("sqrt(1-t)", breakpoints), {});
    run.start();
    while (run.state().time() < 2.0 && run.step()) {
    }
    EXPECT_NEAR(run.state().time(), 1.0, 0.01);
    EXPECT_EQ(run.report.outcome, StepOutcome::diverged);
    EXPECT_THAT(run.failure, ::testing::HasSubstr("not finite"));
    EXPECT_THAT(run.failure, ::testing::HasSubstr("body, translation x"));
    EXPECT_TRUE(run.position("body").allFinite());
    EXPECT_TRUE(run.velocity("body").allFinite());
    EXPECT_TRUE(std::isfinite(run.state().work()));
  }
}

}  // namespace
}  // namespace tisserand::mechanism::time_function_test
