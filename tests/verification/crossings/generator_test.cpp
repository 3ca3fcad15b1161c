// SPDX-License-Identifier: GPL-3.0-or-later
// The generator of crossings itself: pairs of values, actions that act, and changes that change.
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/crossings/changes.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"

namespace tisserand::test_support::crossings::generator_test {
namespace {

TEST(CrossingGenerator, AnyTwoValuesMeet) {
  const std::vector<int> sizes = {4, 3, 5, 2};
  const auto not_both = [](const Choice& choice) { return choice[0] != 1 || choice[3] != 1; };
  const std::vector<Choice> choices = pairwise(sizes, not_both);
  EXPECT_LE(choices.size(), 30u);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t j = i + 1; j < sizes.size(); ++j) {
      std::set<std::pair<int, int>> pairs;
      for (const Choice& choice : choices) pairs.insert({choice[i], choice[j]});
      const std::size_t excluded = i == 0 && j == 3 ? 1 : 0;
      EXPECT_EQ(pairs.size(), static_cast<std::size_t>(sizes[i] * sizes[j]) - excluded) << i << ' ' << j;
    }
}

// What acts in a cell moves it by much more than its limits, so that a term that is lost in one description shows.
TEST(CrossingGenerator, EveryActionActs) {
  const Similarity same;
  const auto motion = [&](Action action) {
    const formats::Scene scene = dynamics_scene({Arm::second_order, Hinge::revolute, action, Scheme::index_2});
    return run_history(scene, scene, same, arm_files());
  };
  const History free = motion(Action::nothing);
  for (int k = 1; k < actions; ++k) {
    const Action action = static_cast<Action>(k);
    const double moved = compare_histories(free, motion(action), {Family::place}).largest;
    if (action == Action::second_hinge)
      EXPECT_LT(moved, 1e-9);  // shares the force of the first
    else
      EXPECT_GT(moved, 1e-4) << name_of(action);
  }
}

// Read without its similarity, a changed scene is another one.
TEST(CrossingGenerator, EveryDescriptionDiffers) {
  const Similarity same;
  const formats::Scene scene = dynamics_scene({Arm::rigid, Hinge::universal, Action::following_loads, Scheme::index_2});
  const History before = run_history(scene, scene, same, arm_files());
  for (const Change change : {Change::turned, Change::mirrored, Change::units, Change::far, Change::together})
    EXPECT_GT(compare_histories(before, run_history(changed(scene, change), scene, same, arm_files())).largest, 1e-2)
        << name_of(change);
}

}  // namespace
}  // namespace tisserand::test_support::crossings::generator_test
