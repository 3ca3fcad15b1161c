// SPDX-License-Identifier: GPL-3.0-or-later
// Steady turns of combined capabilities: the same in another description; dynamics that starts there turns rigidly.
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/crossings/actions.hpp"
#include "tests/support/crossings/changes.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"
#include "tests/support/crossings/small_motions.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support::crossings::turning_test {
namespace {

/// rad/s: linear superelements lose their stability beyond half of the first frequency of the arm, 1.7 rad/s.
constexpr double speed = 0.5;

/// What turns along with the scene.
const std::vector<Action> turning_actions = {Action::nothing, Action::torsion_spring, Action::part_load};
const std::vector<Hinge> turning_hinges = {Hinge::revolute, Hinge::cylindrical};

struct Cell {
  Ingredients in;
  Change change;
  std::string name() const {
    return name_of(in.arm) + " on " + name_of(in.hinge) + " with " + name_of(in.action) + ", " + name_of(change);
  }
};

Cell cell_of(const Choice& c) {
  return {{static_cast<Arm>(c[0]), turning_hinges[c[1]], turning_actions[c[2]], Scheme::index_2},
          static_cast<Change>(c[3])};
}

bool is_choice(const Choice& choice) {
  const Cell cell = cell_of(choice);
  if (cell.change == Change::kept && cell.in.arm != Arm::welded) return false;
  return is_sensible(cell.in) && cell.change != Change::bystander;  // which does not turn
}

formats::Scene turning_scene(const Ingredients& in) {
  formats::Scene scene = held_scene(in);
  scene.gravity.setZero();
  scene.bushings.clear();
  for (formats::PartLoadSpec& load : scene.part_loads) load.value = 2.0;
  const std::string turn = coordinates_of(in.hinge).front();
  scene.motions.push_back(drive(turn, std::to_string(speed) + "*t"));
  if (in.hinge == Hinge::cylindrical) {
    formats::SpringSpec spring;
    spring.name = "along";
    spring.coordinate = formats::CoordinateRef{"hinge/z", ""};
    spring.stiffness = 150.0;
    scene.springs.push_back(spring);
  }
  scene.statics.rotation = formats::RotationSpec{speed * hinge_axis(), root_place()};
  return scene;
}

/// Seen from axes that turn along, nodes stay where they are, but for the error (speed h)² of the steps, of 1 m.
void expect_rigid_turn(formats::Scene scene, const mechanism::State& end) {
  scene.analysis = formats::AnalysisKind::dynamics;
  const History moved = run_history(scene, scene, {}, arm_files(), &end);
  ASSERT_EQ(moved.refusal, "");
  EXPECT_EQ(moved.report.outcome, mechanism::RunOutcome::completed) << moved.report.reason;
  const double allowed = std::pow(speed * scene.integrator.step, 2);
  for (const auto& [name, quantity] : moved.quantities) {
    if (!name.starts_with("nodes/position/")) continue;
    const Eigen::Vector3d first = quantity.rows.row(0).transpose() - root_place();
    for (Eigen::Index k = 0; k < quantity.rows.rows(); ++k) {
      const Eigen::AngleAxisd turn(speed * moved.time[k], hinge_axis());
      const Eigen::Vector3d now = quantity.rows.row(k).transpose() - root_place();
      EXPECT_FALSE((now - turn * first).norm() > allowed) << name << " at " << moved.time[k];  // NaN: no translations
    }
  }
}

void expect_alike(const Cell& cell) {
  SCOPED_TRACE(cell.name());
  const formats::Scene scene = turning_scene(cell.in), other = changed(scene, cell.change);
  const Similarity same, s = similarity_of(cell.change);
  std::optional<mechanism::State> end, other_end;
  const History before = run_history(scene, scene, same, arm_files(), nullptr, &end);
  const History after = run_history(other, scene, s, arm_files(), nullptr, &other_end);
  EXPECT_EQ(before.refusal, "");
  EXPECT_TRUE(before.refusal.empty() && mechanism::is_finished(before.report.outcome)) << before.report.reason;
  EXPECT_EQ(disagreement(before, after, {}), "");
  if (!end || !other_end || !mechanism::is_finished(before.report.outcome)) return;
  const auto modes_of = [](formats::Scene given, const mechanism::State& state) {
    given.modes.rotation = given.statics.rotation->angular_velocity;
    return eigenvalues(given, arm_files(), &state);
  };
  EXPECT_LT(mode_difference(modes_of(scene, *end), modes_of(other, *other_end), s.time), 1e-6);
  expect_rigid_turn(scene, *end);
}

std::vector<Cell> cells() {
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  std::vector<Cell> result;
  for (const Choice& choice : pairwise({arms, count(turning_hinges), count(turning_actions), changes}, is_choice))
    result.push_back(cell_of(choice));
  return result;
}

TEST(CrossingTurning, TenCells) {
  const std::vector<Cell> all = cells();
  for (std::size_t i = 0; i < 10; ++i) expect_alike(all[i * all.size() / 10]);
}

TEST(CrossingTurning, AllCells) {
  for (const Cell& cell : cells()) expect_alike(cell);
}

}  // namespace
}  // namespace tisserand::test_support::crossings::turning_test
