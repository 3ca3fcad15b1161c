// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of combined capabilities: the same mechanism in another description moves alike. Any two of an arm, a hinge,
// an action, a scheme and a change of the description meet in one cell at least.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/crossings/changes.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"

namespace tisserand::test_support::crossings::motion_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Cell {
  Ingredients in;
  Change change;
  std::string name() const {
    return name_of(in.arm) + " on " + name_of(in.hinge) + " with " + name_of(in.action) + " by " + name_of(in.scheme) +
           ", " + name_of(change);
  }
};

Cell cell_of(const Choice& c) {
  return {{static_cast<Arm>(c[0]), static_cast<Hinge>(c[1]), static_cast<Action>(c[2]), static_cast<Scheme>(c[3])},
          static_cast<Change>(c[4])};
}

/// Only the welded arm has a virtual body.
bool is_choice(const Choice& choice) {
  const Cell cell = cell_of(choice);
  return is_sensible(cell.in) && (cell.change != Change::kept || cell.in.arm == Arm::welded);
}

std::vector<Cell> cells() {
  std::vector<Cell> result;
  for (const Choice& choice : pairwise({arms, hinges, actions, schemes, changes}, is_choice))
    result.push_back(cell_of(choice));
  return result;
}

bool chooses_steps(Scheme scheme) { return scheme >= Scheme::bdf; }

/// Newton's iteration ends at 1e-11 of the forces, so that the same steps agree to 1e-6.
Limits limits_of(const Cell& cell) {
  const Scheme scheme = cell.in.scheme;
  Limits limits;
  // Steps that the error chooses feel its last digits.
  if (chooses_steps(scheme)) limits = {1e-6, 1e-4, 1e-3, 1e-3, 1e-5};
  // Rows within a step are interpolated, accelerations with order 2.
  if (scheme == Scheme::controlled_radau) limits = {2e-6, 1e-3, 1e-1, 1e-2, 1e-5};
  // Index 3: positions are rounded to 1e-13 m at 1 km, which is 4e-13/h² = 1e-7 m/s² of a point and more of a turn.
  const bool index_3 = scheme == Scheme::index_3 || scheme == Scheme::controlled_index_3;
  if (cell.change == Change::far && index_3) limits.acceleration = limits.force = 1e-4;
  return limits;
}

/// Generalised alpha with steps of its own allows errors of 1e-3 of the size: where a last digit chooses between two
/// steps, or another body changes the size, motions agree by as much.
Limits other_steps(const Cell& cell, const History& before, const History& after) {
  Limits limits = limits_of(cell);
  const bool bystander = cell.change == Change::bystander;
  const bool differ = before.report.steps != after.report.steps || bystander;
  const bool alpha = cell.in.scheme == Scheme::controlled || cell.in.scheme == Scheme::controlled_index_3;
  if (differ && alpha) limits = {1e-3, 1e-1, never, never, 1e-2};
  if (bystander && chooses_steps(cell.in.scheme)) limits = {1e-3, 1e-1, never, never, never};
  if (bystander) limits.energy = never;  // it has energy too
  return limits;
}

/// Accelerations of virtual bodies that are kept, and with index 3 their velocities, are those of the integrator.
void forget_hub(History& history) {
  std::erase_if(history.quantities, [](const auto& entry) {
    return entry.first.starts_with("nodes/") && entry.first.find("/hub") != std::string::npos &&
           entry.second.family != Family::place;
  });
}

void expect_alike(const Cell& cell) {
  SCOPED_TRACE(cell.name());
  const formats::Scene scene = dynamics_scene(cell.in);
  const Similarity same, s = similarity_of(cell.change);
  History before = run_history(scene, scene, same, arm_files());
  const History after = run_history(changed(scene, cell.change), scene, s, arm_files());
  if (cell.change == Change::kept) forget_hub(before);
  EXPECT_EQ(disagreement(before, after, other_steps(cell, before, after)), "");
  const std::string refusal = refusal_of(cell.in);
  EXPECT_EQ(before.refusal.empty(), refusal.empty()) << before.refusal;
  EXPECT_NE(before.refusal.find(refusal), std::string::npos) << before.refusal;
  EXPECT_EQ(before.report.outcome, mechanism::RunOutcome::completed) << before.report.reason;
}

TEST(CrossingMotion, TenCells) {
  const std::vector<Cell> all = cells();
  for (std::size_t i = 0; i < 10; ++i) expect_alike(all[i * all.size() / 10]);
}

TEST(CrossingMotion, AllCells) {
  const std::vector<Cell> all = cells();
  EXPECT_GE(all.size(), 250u);
  for (const Cell& cell : all) expect_alike(cell);
}

}  // namespace
}  // namespace tisserand::test_support::crossings::motion_test
