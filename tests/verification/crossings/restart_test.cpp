// SPDX-License-Identifier: GPL-3.0-or-later
// Combined capabilities that go on from a checkpoint: bit-equal to the run that wrote it.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mechanism/simulate.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::test_support::crossings::restart_test {
namespace {

Ingredients cell_of(const Choice& c) {
  return {static_cast<Arm>(c[0]), static_cast<Hinge>(c[1]), static_cast<Action>(c[2]), static_cast<Scheme>(c[3])};
}

bool is_choice(const Choice& choice) {
  const Ingredients in = cell_of(choice);
  return is_sensible(in) && refusal_of(in).empty() && in.scheme != Scheme::bdf;
}

/// Rows of `part` are those of `whole` at the same instants, bit for bit; the first is that of the checkpoint.
void expect_tail(const History& whole, const History& part) {
  const auto rows = static_cast<Eigen::Index>(part.time.size()) - 1;
  ASSERT_GT(rows, 0);
  ASSERT_LT(rows, static_cast<Eigen::Index>(whole.time.size()));
  for (const auto& [name, quantity] : whole.quantities) {
    if (name == "energy/potential" || name == "energy/total") continue;  // counted from the first row
    const Eigen::MatrixXd rest = part.quantities.at(name).rows.bottomRows(rows), tail = quantity.rows.bottomRows(rows);
    EXPECT_TRUE((tail.array() == rest.array() || (tail.array().isNaN() && rest.array().isNaN())).all()) << name;
  }
}

void expect_same_continuation(const Ingredients& in) {
  SCOPED_TRACE(name_of(in.arm) + " on " + name_of(in.hinge) + " with " + name_of(in.action) + " by " +
               name_of(in.scheme));
  const TemporaryFolder folder;
  formats::Scene scene = dynamics_scene(in);
  scene.checkpoint.every = in.scheme > Scheme::bdf ? 4 : 25;
  const Similarity same;
  const std::string kept = folder.file("kept.h5");
  mechanism::RunControl control;
  control.progress = [&](double) {
    const std::string written = folder.file("a.checkpoint.h5");
    if (std::filesystem::exists(written) && !std::filesystem::exists(kept)) std::filesystem::copy_file(written, kept);
  };
  HistoryListener whole(scene, same), rest(scene, same);
  mechanism::RunRequest request{scene, arm_files(), std::nullopt, folder.file("a.results.h5"), "", std::nullopt};
  request.listener = &whole;
  const mechanism::RunEnd first = mechanism::simulate(request, control);
  EXPECT_EQ(first.report.outcome, mechanism::RunOutcome::completed) << first.report.reason;
  ASSERT_TRUE(std::filesystem::exists(kept));
  request.path = folder.file("b.results.h5");
  request.restart = kept;
  request.listener = &rest;
  const mechanism::RunEnd second = mechanism::simulate(request, {});
  EXPECT_EQ(second.report.outcome, mechanism::RunOutcome::completed) << second.report.reason;
  expect_tail(whole.history(), rest.history());
}

std::vector<Ingredients> cells() {
  std::vector<Ingredients> result;
  for (const Choice& choice : pairwise({arms, hinges, actions, schemes}, is_choice)) result.push_back(cell_of(choice));
  return result;
}

TEST(CrossingRestart, TenCells) {
  const std::vector<Ingredients> all = cells();
  for (std::size_t i = 0; i < 10; ++i) expect_same_continuation(all[i * all.size() / 10]);
}

TEST(CrossingRestart, AllCells) {
  for (const Ingredients& in : cells()) expect_same_continuation(in);
}

}  // namespace
}  // namespace tisserand::test_support::crossings::restart_test
