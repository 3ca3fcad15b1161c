// SPDX-License-Identifier: GPL-3.0-or-later
// Factors kept by cost: the mean cost of a step against the least possible one, and the pause after a loss.
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism::factor_reuse_test {
namespace {

/// Mean cost of `steps` steps. A step costs `fresh` with new factors and `kept` plus age times `growth` with old ones.
double mean_cost(double fresh, double kept, double growth, int steps) {
  FactorReuse reuse;
  double sum = 0.0;
  int age = -1;  // no factors yet
  for (int i = 0; i < steps; ++i) {
    const bool keeps = age >= 0 && reuse.tries_kept();
    age = keeps ? age + 1 : 0;
    const double cost = keeps ? kept + growth * age : fresh;
    reuse.count(keeps ? Factors::kept : Factors::fresh, true, cost, {});
    sum += cost;
  }
  return sum / steps;
}

/// Least mean cost of all cycles of one step with new factors and any number with kept ones.
double least_mean_cost(double fresh, double kept, double growth, int most) {
  double least = std::numeric_limits<double>::infinity(), sum = fresh;
  for (int age = 0; age < most; ++age) {
    sum += age > 0 ? kept + growth * age : 0.0;
    least = std::min(least, sum / (age + 1));
  }
  return least;
}

// The rule ends a cycle at the first step above the mean, so one step later than the best cycle. Where kept factors
// cost more than new ones, but at most by StepTuning::loss, they are tried in every second step. Beyond that long
// pauses leave one trial in 64 steps.
TEST(FactorReuse, IsNearTheLeastMeanCostWhateverFactorsCost) {
  std::mt19937 random(47);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const double fresh = 1.0 + 9.0 * any(random), kept = 1.0 + 4.0 * any(random), growth = any(random) * any(random);
    const double least = least_mean_cost(fresh, kept, growth, 20000);
    EXPECT_LT(mean_cost(fresh, kept, growth, 20000), 1.02 * StepTuning{}.loss * least)
        << "fresh " << fresh << ", kept " << kept << ", growth " << growth;
  }
}

TEST(FactorReuse, PausesTwiceAsLongAfterEachLoss) {
  FactorReuse reuse;
  const StepTuning tuning;
  for (const int pause : {1, 3, 7, 15, 31, 63, 63}) {
    reuse.count(Factors::fresh, true, 3.0, tuning);
    ASSERT_TRUE(reuse.tries_kept());
    reuse.count(Factors::kept, false, 3.0, tuning);  // abandoned: the same step is taken with new factors
    for (int i = 0; i < pause; ++i) {
      reuse.count(Factors::fresh, true, 3.0, tuning);
      ASSERT_FALSE(reuse.tries_kept()) << pause << " " << i;
    }
  }
}

TEST(FactorReuse, TriesAtOnceAgainAfterAGain) {
  FactorReuse reuse;
  const StepTuning tuning;
  reuse.count(Factors::fresh, true, 6.0, tuning);
  for (int i = 0; i < 5; ++i) reuse.count(Factors::kept, true, 2.0, tuning);
  reuse.count(Factors::kept, false, 3.0, tuning);
  reuse.count(Factors::fresh, true, 6.0, tuning);
  EXPECT_TRUE(reuse.tries_kept());
}

}  // namespace
}  // namespace tisserand::mechanism::factor_reuse_test
